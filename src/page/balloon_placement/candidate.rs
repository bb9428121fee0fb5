//! [`BalloonCandidate`]: a place for one balloon that meets all constraints except those with other balloons.

use kurbo::{Point, Rect, Vec2};

use super::cost::cost;
use super::request::{PlacedBalloon, PlacementArea, PlacementRequest};
use super::tail::{fit_tail, is_clear, tail_polygon};
use crate::page::layout::ConvexPolygon;

/// Grid positions across and down a panel.
const GRID_STEPS: usize = 26;

/// A place for one balloon that meets all constraints except those with other balloons.
pub(crate) struct BalloonCandidate {
    pub place: PlacedBalloon,
    /// A polygon around its tail, from the centre to the tip, with space for a bend.
    pub tail: Option<ConvexPolygon>,
    /// Bounding box of the balloon.
    pub bounds: Rect,
    /// Bounding box of the balloon and its tail.
    pub reach: Rect,
    pub cost: f64,
}

/// The candidates of one balloon, cheapest first.
pub(crate) fn candidates(wish: &PlacementRequest, room: &PlacementArea) -> Vec<BalloonCandidate> {
    let mut found = Vec::new();
    for (shape, hull) in wish.hulls.iter().enumerate() {
        for middle in candidate_centres(wish, hull, room) {
            let hull = hull.moved(middle.to_vec2());
            if wish.at.is_none() && !hull.0.iter().all(|p| room.outline.holds(*p)) {
                continue;
            }
            let tail = match &wish.target {
                None => None,
                Some((target, aim)) => match fit_tail(middle, &hull, (target, *aim), wish, room) {
                    Some(tail) => Some(tail),
                    None => continue,
                },
            };
            let around = tail.as_ref().map(|tail| tail_polygon(middle, tail.tip, wish.tail_half_width));
            let place = PlacedBalloon { shape, middle, tip: tail.as_ref().map(|tail| tail.tip), hull };
            if wish.at.is_some() || meets_constraints(&place, around.as_ref(), wish, room) {
                let bounds = place.hull.bounds();
                let reach = around.as_ref().map_or(bounds, |tail| bounds.union(tail.bounds()));
                let cost = cost(bounds, shape, tail.as_ref(), wish, room);
                found.push(BalloonCandidate { place, tail: around, bounds, reach, cost });
            }
        }
    }
    found.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    found
}

/// The possible centres of a balloon: the given one, or a grid over the panel.
fn candidate_centres(wish: &PlacementRequest, hull: &ConvexPolygon, room: &PlacementArea) -> Vec<Point> {
    if let Some(at) = wish.at {
        return vec![at];
    }
    let (bounds, own) = (room.outline.bounds(), hull.bounds());
    let free = Vec2::new(bounds.width() - own.width(), bounds.height() - own.height());
    if free.x < 0.0 || free.y < 0.0 || !free.is_finite() {
        return Vec::new();
    }
    let from = Point::new(bounds.x0 - own.x0, bounds.y0 - own.y0);
    let step = free / (GRID_STEPS - 1) as f64;
    let places = (0..GRID_STEPS * GRID_STEPS).map(|k| (k % GRID_STEPS, k / GRID_STEPS));
    places.map(|(x, y)| from + Vec2::new(x as f64 * step.x, y as f64 * step.y)).collect()
}

/// Whether a balloon covers no protected area, and its tail crosses none except its own target.
fn meets_constraints(
    own: &PlacedBalloon,
    tail: Option<&ConvexPolygon>,
    wish: &PlacementRequest,
    room: &PlacementArea,
) -> bool {
    let free = |other: &ConvexPolygon| !own.hull.meets(other, room.gap);
    let is_own = |other: &ConvexPolygon| wish.target.as_ref().is_some_and(|(target, _)| target == other);
    room.protected.iter().all(|other| free(other) && (is_own(other) || is_clear(tail, other)))
        && room.obstacles.iter().all(|other| free(other) && is_clear(tail, other))
}
