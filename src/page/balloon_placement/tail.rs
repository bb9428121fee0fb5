//! [`BalloonTail`]: the end of a balloon's tail, and its length over figures.
//!
//! 1. The tail runs from the centre of the balloon towards the aim, and starts where it leaves the hull.
//! 2. It ends just before the hull of its target.
//! 3. If a figure is close in front of the target, the tail ends before that figure.
//! 4. Long tails are shortened.

use kurbo::{Point, Vec2};

use super::request::{PlacementArea, PlacementRequest};
use crate::page::layout::ConvexPolygon;
use crate::page::tolerances;

/// Distance from the tip of a tail to its target, as a multiple of the gap.
const TIP_GAP_FACTOR: f64 = 0.6;

/// A tail is drawn in full up to this length, ems; of the excess only the share `EXCESS_TAIL_SHARE` is drawn.
const FULL_TAIL_LENGTH_EM: f64 = 4.0;
const EXCESS_TAIL_SHARE: f64 = 0.4;

/// Maximum length of a figure in front of the target for the tail to end before the figure, ems.
const MAX_FIGURE_REACH_EM: f64 = 4.0;

/// Distance from the tip of a tail to the figure in front of its target, ems. It allows for coarse grid
/// squares and line widths.
const FIGURE_GAP_EM: f64 = 0.45;

/// Sampling steps per em along a tail.
const STEPS_PER_EM: f64 = 6.0;

/// Sideways bend of a tail, as a share of its length.
const BEND_SHARE: f64 = 0.03;

/// The tail of a balloon: its length up to the target, unit direction, length over figures, distance between
/// tip and target, and its tip.
pub(crate) struct BalloonTail {
    pub length: f64,
    pub way: Vec2,
    pub over: f64,
    pub short: f64,
    pub tip: Point,
}

/// Fits the tail of a balloon. It ends just before its target, and before the figure that the target belongs
/// to if that is near. `None` if the tail is too short.
pub(crate) fn fit_tail(
    middle: Point,
    hull: &ConvexPolygon,
    (target, aim): (&ConvexPolygon, Point),
    request: &PlacementRequest,
    area: &PlacementArea,
) -> Option<BalloonTail> {
    let to_aim = aim - middle;
    let length = to_aim.hypot();
    if length < tolerances::MIN_AIM_DISTANCE_MM {
        return None;
    }
    let direction = to_aim / length;
    let entry_at = entry_distance(target, middle, aim).unwrap_or(length);
    let exit_at = exit_distance(hull, middle, aim);
    // If the balloon is inside a large part, the tail points to the aim itself.
    let max_end = if target.holds(middle) { length } else { entry_at } - area.gap * TIP_GAP_FACTOR;
    let min_end = exit_at + request.min_tail_length;
    if max_end.is_nan() || max_end < min_end {
        return None;
    }
    let is_figure =
        |at: f64| area.cover.as_ref().is_some_and(|cover| cover.is_figure(middle + direction * at));
    let step = request.em / STEPS_PER_EM;
    let mut end = max_end;
    while end > min_end && max_end - end < MAX_FIGURE_REACH_EM * request.em && is_figure(end) {
        end -= step;
    }
    // If the figure covers the whole search length, the tail runs over it.
    end = if is_figure(end) { max_end } else { (end - FIGURE_GAP_EM * request.em).max(min_end) };
    let full_length_end = exit_at + FULL_TAIL_LENGTH_EM * request.em;
    if end > full_length_end {
        end = full_length_end + EXCESS_TAIL_SHARE * (end - full_length_end);
    }
    let steps = ((end - exit_at) / step).ceil().max(1.0) as usize;
    let steps_over_figure = (0..steps).filter(|k| is_figure(exit_at + step * (*k as f64 + 0.5))).count();
    Some(BalloonTail {
        length: max_end - exit_at,
        way: direction,
        over: steps_over_figure as f64 * step,
        short: max_end - end,
        tip: middle + direction * end,
    })
}

/// A polygon around a tail, from the centre of its balloon to the tip, with space for a bend.
pub(crate) fn tail_polygon(middle: Point, tip: Point, foot: f64) -> ConvexPolygon {
    let direction = tip - middle;
    let normal = Vec2::new(-direction.y, direction.x).normalize();
    let (wide_offset, narrow_offset) =
        (normal * (foot + BEND_SHARE * direction.hypot()), normal * (0.3 * foot));
    ConvexPolygon(vec![middle - wide_offset, tip - narrow_offset, tip + narrow_offset, middle + wide_offset])
}

/// Distance from a point to where the segment to another point enters a polygon.
fn entry_distance(polygon: &ConvexPolygon, from: Point, to: Point) -> Option<f64> {
    crossings(polygon, from, to).reduce(f64::min).filter(|at| *at <= from.distance(to))
}

/// Distance from a point inside a polygon to where the ray towards another point leaves it.
fn exit_distance(polygon: &ConvexPolygon, from: Point, to: Point) -> f64 {
    crossings(polygon, from, to).fold(0.0, f64::max)
}

/// Distances to the crossings of a ray with the sides of a polygon.
fn crossings(polygon: &ConvexPolygon, from: Point, to: Point) -> impl Iterator<Item = f64> + '_ {
    let direction = to - from;
    polygon.sides().filter_map(move |(a, b)| {
        let side = b - a;
        let area = direction.cross(side);
        let (line_share, side_share) = ((a - from).cross(side) / area, (a - from).cross(direction) / area);
        let is_crossing = area != 0.0 && line_share >= 0.0 && (0.0..=1.0).contains(&side_share);
        is_crossing.then(|| line_share * direction.hypot())
    })
}

/// Whether a tail does not touch a polygon.
pub(crate) fn is_clear(tail: Option<&ConvexPolygon>, other: &ConvexPolygon) -> bool {
    tail.is_none_or(|tail| !tail.meets(other, 0.0))
}
