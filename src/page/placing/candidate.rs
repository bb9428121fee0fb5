//! [`Candidate`]: a place of one balloon that holds whatever becomes of the others.

use kurbo::{Point, Rect, Vec2};

use super::cost::cost;
use super::{Placed, Room, Wish, is_clear};
use crate::page::layout::Polygon;

/// Places tried across and down a panel.
const ACROSS: usize = 26;

/// From the tip of a tail to what it points at, in gaps.
const SHORT_OF: f64 = 0.6;

/// So much of a tail, in ems, leads on as it is; of what it is longer it leads on by a share.
const LONG: f64 = 4.0;
const OF_LONGER: f64 = 0.4;

/// So far, in ems, a figure may reach before what the tail points at for the tail to end short of it.
const BEFORE: f64 = 4.0;

/// Steps to the em in which a tail is followed.
const STEPS: f64 = 6.0;

/// How far tails bend aside, in shares of their length.
const BEND: f64 = 0.03;

/// A place of one balloon that holds whatever becomes of the others.
pub(super) struct Candidate {
    pub place: Placed,
    /// Around its tail, from the middle to the tip, with room for a bend.
    pub tail: Option<Polygon>,
    /// Around the balloon.
    pub bounds: Rect,
    /// Around the balloon and its tail.
    pub reach: Rect,
    pub cost: f64,
}

/// Where a tail begins, at the balloon, and ends, and how much of its way, and of what is left of it up to the part that it points
/// at, is over figures.
pub(super) struct Tail {
    pub length: f64,
    pub way: Vec2,
    pub over: f64,
    pub short: f64,
    tip: Point,
}

/// The places of a balloon by itself, the best first.
pub(super) fn candidates(wish: &Wish, room: &Room) -> Vec<Candidate> {
    let mut found = Vec::new();
    for (shape, hull) in wish.hulls.iter().enumerate() {
        for middle in middles(wish, hull, room) {
            let hull = hull.moved(middle.to_vec2());
            if wish.at.is_none() && !hull.0.iter().all(|p| room.outline.holds(*p)) {
                continue;
            }
            let tail = match &wish.target {
                None => None,
                Some((target, aim)) => match tail(middle, &hull, (target, *aim), wish, room) {
                    Some(tail) => Some(tail),
                    None => continue,
                },
            };
            let around = tail.as_ref().map(|tail| around(middle, tail.tip, wish.foot));
            let place = Placed { shape, middle, tip: tail.as_ref().map(|tail| tail.tip), hull };
            if wish.at.is_some() || is_free(&place, around.as_ref(), wish, room) {
                let bounds = place.hull.bounds();
                let reach = around.as_ref().map_or(bounds, |tail| bounds.union(tail.bounds()));
                let cost = cost(bounds, shape, tail.as_ref(), wish, room);
                found.push(Candidate { place, tail: around, bounds, reach, cost });
            }
        }
    }
    found.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    found
}

/// Where its middle may be.
fn middles(wish: &Wish, hull: &Polygon, room: &Room) -> Vec<Point> {
    if let Some(at) = wish.at {
        return vec![at];
    }
    let (bounds, own) = (room.outline.bounds(), hull.bounds());
    let free = Vec2::new(bounds.width() - own.width(), bounds.height() - own.height());
    if !(free.x >= 0.0 && free.y >= 0.0) {
        return Vec::new();
    }
    let from = Point::new(bounds.x0 - own.x0, bounds.y0 - own.y0);
    let step = free / (ACROSS - 1) as f64;
    let places = (0..ACROSS * ACROSS).map(|k| (k % ACROSS, k / ACROSS));
    places.map(|(x, y)| from + Vec2::new(x as f64 * step.x, y as f64 * step.y)).collect()
}

/// The tail of a balloon: it ends a little before it reaches what it points at, and before the figure that this is a part of.
fn tail(
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
    if !(reach >= least) {
        return None;
    }
    let is_figure = |at: f64| room.cover.as_ref().is_some_and(|cover| cover.is_figure(middle + way * at));
    let step = wish.em / STEPS;
    let mut end = reach;
    while end > least && reach - end < BEFORE * wish.em && is_figure(end) {
        end -= step;
    }
    // Where the figure begins no later, the tail leads over it.
    end = if is_figure(end) { reach } else { (end - step).max(least) };
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
fn around(middle: Point, tip: Point, foot: f64) -> Polygon {
    let way = tip - middle;
    let across = Vec2::new(-way.y, way.x).normalize();
    let (wide, narrow) = (across * (foot + BEND * way.hypot()), across * (0.3 * foot));
    Polygon(vec![middle - wide, tip - narrow, tip + narrow, middle + wide])
}

/// How far it is from a point to where the way to another one enters a polygon.
fn enters(polygon: &Polygon, from: Point, to: Point) -> Option<f64> {
    crossings(polygon, from, to).reduce(f64::min)
}

/// How far it is from a point within a polygon to where the way to another one leaves it.
fn leaves(polygon: &Polygon, from: Point, to: Point) -> f64 {
    crossings(polygon, from, to).fold(0.0, f64::max)
}

fn crossings(polygon: &Polygon, from: Point, to: Point) -> impl Iterator<Item = f64> + '_ {
    let way = to - from;
    polygon.sides().filter_map(move |(a, b)| {
        let side = b - a;
        let area = way.cross(side);
        let (along, across) = ((a - from).cross(side) / area, (a - from).cross(way) / area);
        let is_there = area != 0.0 && (0.0..=1.0).contains(&along) && (0.0..=1.0).contains(&across);
        is_there.then(|| along * way.hypot())
    })
}

/// Whether a balloon covers nothing that is kept, and its tail runs over nothing but what it points at.
fn is_free(own: &Placed, tail: Option<&Polygon>, wish: &Wish, room: &Room) -> bool {
    let free = |other: &Polygon| !own.hull.meets(other, room.gap);
    let is_own = |other: &Polygon| wish.target.as_ref().is_some_and(|(target, _)| target == other);
    room.kept.iter().all(|other| free(other) && (is_own(other) || is_clear(tail, other)))
        && room.obstacles.iter().all(|other| free(other) && is_clear(tail, other))
}
