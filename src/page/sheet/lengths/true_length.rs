//! [`true_length`]: the length of the model that a dimension measures between two points.
//!
//! - Side views, sections and their details show lengths in their plane at true size.
//! - A pictorial view foreshortens. A dimension along an axis of the model shows the true distance; others
//!   are refused.
//! - An exploded view moves parts, so it has no dimensions.

use glam::DVec3;

use super::length_precision::{LengthPrecision, MeasuredPoint};
use crate::page::sheet::keys::sheet_keys::DimensionKind;
use crate::page::sheet::view::sheet_view::SheetView;
use crate::page::tolerances::MAX_OFF_AXIS_SHARE;

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

pub(crate) const REFUSED_IN_EXPLODED_VIEW: Refusal =
    ["an exploded view has no dimensions, because its parts are moved", "name another view with `of`"];

const REFUSED_OFF_AXIS: Refusal = [
    "a pictorial view shows true lengths only along the axes of the model",
    "name points that differ only in x, y or z and leave out `measure`, or name a side view with `of`",
];

const REFUSED_BEHIND_EACH_OTHER: Refusal =
    ["these two points lie behind each other in this view", "name another point, or another view with `of`"];

/// The length that a dimension measures between two points in a view, in model units, with its precision.
pub(crate) fn true_length(
    ends: [MeasuredPoint; 2],
    measure: DimensionKind,
    sight: &SheetView,
    foreshortening: Foreshortening,
) -> Result<(f64, LengthPrecision), Refusal> {
    let [right, up, forward] = sight.axes();
    let between = ends[1].at - ends[0].at;
    let along = match (foreshortening, measure) {
        (Foreshortening::Moved, _) => return Err(REFUSED_IN_EXPLODED_VIEW),
        (Foreshortening::Pictorial, _) => along_axis(ends, measure, [right, up]).ok_or(REFUSED_OFF_AXIS)?,
        (Foreshortening::None, DimensionKind::Horizontal) => right,
        (Foreshortening::None, DimensionKind::Vertical) => up,
        (Foreshortening::None, _) => {
            (between - forward * between.dot(forward)).try_normalize().ok_or(REFUSED_BEHIND_EACH_OTHER)?
        }
    };
    Ok((between.dot(along).abs(), LengthPrecision::between(ends, along)))
}

/// The axis of the model along which two points differ, if the dimension runs along it on the page.
fn along_axis(ends: [MeasuredPoint; 2], measure: DimensionKind, [right, up]: [DVec3; 2]) -> Option<DVec3> {
    let between = ends[1].at - ends[0].at;
    let axis = DVec3::AXES[between.abs().max_position()];
    let aside = between - axis * between.dot(axis);
    let step = ends[0].step.max(ends[1].step);
    let within = |off: f64| off <= (MAX_OFF_AXIS_SHARE * between.length()).max(2.0 * step);
    let on_page = match measure {
        DimensionKind::Horizontal => within(between.dot(up).abs()),
        DimensionKind::Vertical => within(between.dot(right).abs()),
        _ => true,
    };
    (between != DVec3::ZERO && within(aside.length()) && on_page).then_some(axis)
}
