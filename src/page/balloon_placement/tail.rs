//! [`Tail`]: where the tail of a balloon ends, and what it runs over.

use kurbo::{Point, Vec2};

use super::request::{Room, Wish};
use crate::page::layout::Polygon;

/// From the tip of a tail to what it points at, in gaps.
const SHORT_OF: f64 = 0.6;

/// So much of a tail, in ems, leads on as it is; of what it is longer it leads on by a share.
const LONG: f64 = 4.0;
const OF_LONGER: f64 = 0.4;

/// So far, in ems, a figure may reach before what the tail points at for the tail to end short of it.
const BEFORE: f64 = 4.0;

/// From the tip of a tail to the figure that it ends short of, in ems: the squares of a cover are coarse, and lines have a width.
const SHORT_OF_FIGURE: f64 = 0.45;

/// Steps to the em in which a tail is followed.
const STEPS: f64 = 6.0;

/// How far tails bend aside, in shares of their length.
const BEND: f64 = 0.03;

/// Where a tail begins, at the balloon, and ends, and how much of its way, and of what is left of it up to the part that it points
/// at, is over figures.
pub(crate) struct Tail {
    pub length: f64,
    pub way: Vec2,
    pub over: f64,
    pub short: f64,
    pub tip: Point,
}

/// The tail of a balloon: it ends a little before it reaches what it points at, and before the figure that this is a part of.
pub(crate) fn tail(
    middle: Point,
    hull: &Polygon,
    (target, aim): (&Polygon, Point),
    wish: &Wish,
    room: &Room,
) -> Option<Tail> {
    let way = aim - middle;
    let length = way.hypot();
    if length < 1e-9 {
        return None;
    }
    let way = way / length;
    let enters = enters(target, middle, aim).unwrap_or(length);
    let leaves = leaves(hull, middle, aim);
    // From within a large part the tail leads to the point itself.
    let reach = if target.holds(middle) { length } else { enters } - room.gap * SHORT_OF;
    let least = leaves + wish.tail;
    if reach.is_nan() || reach < least {
        return None;
    }
    let is_figure = |at: f64| room.cover.as_ref().is_some_and(|cover| cover.is_figure(middle + way * at));
    let step = wish.em / STEPS;
    let mut end = reach;
    while end > least && reach - end < BEFORE * wish.em && is_figure(end) {
        end -= step;
    }
    // Where the figure begins no later, the tail leads over it.
    end = if is_figure(end) { reach } else { (end - SHORT_OF_FIGURE * wish.em).max(least) };
    let long = leaves + LONG * wish.em;
    if end > long {
        end = long + OF_LONGER * (end - long);
    }
    let steps = ((end - leaves) / step).ceil().max(1.0) as usize;
    let over = (0..steps).filter(|k| is_figure(leaves + step * (*k as f64 + 0.5))).count();
    Some(Tail {
        length: reach - leaves,
        way,
        over: over as f64 * step,
        short: reach - end,
        tip: middle + way * end,
    })
}

/// Around a tail, from the middle of its balloon to its tip, with room for a bend.
pub(crate) fn around(middle: Point, tip: Point, foot: f64) -> Polygon {
    let way = tip - middle;
    let across = Vec2::new(-way.y, way.x).normalize();
    let (wide, narrow) = (across * (foot + BEND * way.hypot()), across * (0.3 * foot));
    Polygon(vec![middle - wide, tip - narrow, tip + narrow, middle + wide])
}

/// How far it is from a point to where the way to another one enters a polygon.
fn enters(polygon: &Polygon, from: Point, to: Point) -> Option<f64> {
    crossings(polygon, from, to).reduce(f64::min).filter(|at| *at <= from.distance(to))
}

/// How far it is from a point within a polygon to where the way towards another one leaves it.
fn leaves(polygon: &Polygon, from: Point, to: Point) -> f64 {
    crossings(polygon, from, to).fold(0.0, f64::max)
}

/// How far it is to where the way towards a point, and beyond it, crosses the sides of a polygon.
fn crossings(polygon: &Polygon, from: Point, to: Point) -> impl Iterator<Item = f64> + '_ {
    let way = to - from;
    polygon.sides().filter_map(move |(a, b)| {
        let side = b - a;
        let area = way.cross(side);
        let (along, across) = ((a - from).cross(side) / area, (a - from).cross(way) / area);
        let is_there = area != 0.0 && along >= 0.0 && (0.0..=1.0).contains(&across);
        is_there.then(|| along * way.hypot())
    })
}

/// Whether a tail keeps off a polygon.
pub(crate) fn is_clear(tail: Option<&Polygon>, other: &Polygon) -> bool {
    tail.is_none_or(|tail| !tail.meets(other, 0.0))
}
