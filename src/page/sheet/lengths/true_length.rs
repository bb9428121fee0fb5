//! [`true_length`]: the length of the model that a dimension measures between two points.
//!
//! - Side views, sections and their details show lengths in their plane at true size.
//! - A pictorial view foreshortens. A dimension along an axis of the model shows the true distance; others
//!   are refused.
//! - An exploded view moves parts, so it has no dimensions.

use glam::DVec3;

use super::length_precision::{Measured, Precision};
use crate::page::sheet::keys::sheet_keys::Measure;
use crate::page::sheet::view::sheet_view::Sight;

/// How lengths in a view relate to those of the model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Foreshortening {
    /// Lengths in the plane of the view are true.
    None,
    /// Lengths are foreshortened, depending on their direction.
    Pictorial,
    /// The view shows moved parts.
    Moved,
}

/// The reason why a dimension is refused, and what to do.
pub(crate) type Refusal = [&'static str; 2];

pub(crate) const IN_EXPLODED: Refusal =
    ["an exploded view has no dimensions, because its parts are moved", "name another view with `of`"];

const NOT_ALONG_AXIS: Refusal = [
    "a pictorial view shows true lengths only along the axes of the model",
    "name points that differ only in x, y or z and leave out `measure`, or name a side view with `of`",
];

const BEHIND: Refusal =
    ["these two points lie behind each other in this view", "name another point, or another view with `of`"];

/// Maximum distance of two points from a line along an axis, as a share of their distance.
const ALONG: f64 = 1e-9;

/// The length that a dimension measures between two points in a view, in model units, with its precision.
pub(crate) fn true_length(
    ends: [Measured; 2],
    measure: Measure,
    sight: &Sight,
    foreshortening: Foreshortening,
) -> Result<(f64, Precision), Refusal> {
    let [right, up, forward] = sight.axes();
    let between = ends[1].at - ends[0].at;
    let along = match (foreshortening, measure) {
        (Foreshortening::Moved, _) => return Err(IN_EXPLODED),
        (Foreshortening::Pictorial, _) => along_axis(ends, measure, [right, up]).ok_or(NOT_ALONG_AXIS)?,
        (Foreshortening::None, Measure::Horizontal) => right,
        (Foreshortening::None, Measure::Vertical) => up,
        (Foreshortening::None, _) => {
            (between - forward * between.dot(forward)).try_normalize().ok_or(BEHIND)?
        }
    };
    Ok((between.dot(along).abs(), Precision::between(ends, along)))
}

/// The axis of the model along which two points differ, if the dimension runs along it on the page.
fn along_axis(ends: [Measured; 2], measure: Measure, [right, up]: [DVec3; 2]) -> Option<DVec3> {
    let between = ends[1].at - ends[0].at;
    let axis = DVec3::AXES[between.abs().max_position()];
    let aside = between - axis * between.dot(axis);
    let step = ends[0].step.max(ends[1].step);
    let within = |off: f64| off <= (ALONG * between.length()).max(2.0 * step);
    let on_page = match measure {
        Measure::Horizontal => within(between.dot(up).abs()),
        Measure::Vertical => within(between.dot(right).abs()),
        _ => true,
    };
    (between != DVec3::ZERO && within(aside.length()) && on_page).then_some(axis)
}
