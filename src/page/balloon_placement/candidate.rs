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
pub(crate) fn candidates(request: &PlacementRequest, area: &PlacementArea) -> Vec<BalloonCandidate> {
    let mut balloons = Vec::new();
    for (shape, hull) in request.hulls.iter().enumerate() {
        for middle in candidate_centres(request, hull, area) {
            let hull = hull.moved(middle.to_vec2());
            if request.at.is_none() && !hull.0.iter().all(|p| area.outline.holds(*p)) {
                continue;
            }
            let tail = match &request.target {
                None => None,
                Some((target, aim)) => match fit_tail(middle, &hull, (target, *aim), request, area) {
                    Some(tail) => Some(tail),
                    None => continue,
                },
            };
            let tail_outline =
                tail.as_ref().map(|tail| tail_polygon(middle, tail.tip, request.tail_half_width));
            let placed_balloon =
                PlacedBalloon { shape, middle, tip: tail.as_ref().map(|tail| tail.tip), hull };
            if request.at.is_some()
                || meets_constraints(&placed_balloon, tail_outline.as_ref(), request, area)
            {
                let bounds = placed_balloon.hull.bounds();
                let reach = tail_outline.as_ref().map_or(bounds, |tail| bounds.union(tail.bounds()));
                let cost = cost(bounds, shape, tail.as_ref(), request, area);
                balloons.push(BalloonCandidate {
                    place: placed_balloon,
                    tail: tail_outline,
                    bounds,
                    reach,
                    cost,
                });
            }
        }
    }
    balloons.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    balloons
}

/// The possible centres of a balloon: the given one, or a grid over the panel.
fn candidate_centres(request: &PlacementRequest, hull: &ConvexPolygon, area: &PlacementArea) -> Vec<Point> {
    if let Some(at) = request.at {
        return vec![at];
    }
    let (bounds, hull_bounds) = (area.outline.bounds(), hull.bounds());
    let free_space = Vec2::new(bounds.width() - hull_bounds.width(), bounds.height() - hull_bounds.height());
    if free_space.x < 0.0 || free_space.y < 0.0 || !free_space.is_finite() {
        return Vec::new();
    }
    let first_centre = Point::new(bounds.x0 - hull_bounds.x0, bounds.y0 - hull_bounds.y0);
    let step = free_space / (GRID_STEPS - 1) as f64;
    let grid_cells = (0..GRID_STEPS * GRID_STEPS).map(|k| (k % GRID_STEPS, k / GRID_STEPS));
    grid_cells.map(|(x, y)| first_centre + Vec2::new(x as f64 * step.x, y as f64 * step.y)).collect()
}

/// Whether a balloon covers no protected area, and its tail crosses none except its own target.
fn meets_constraints(
    balloon: &PlacedBalloon,
    tail: Option<&ConvexPolygon>,
    request: &PlacementRequest,
    area: &PlacementArea,
) -> bool {
    let is_outside = |other: &ConvexPolygon| !balloon.hull.meets(other, area.gap);
    let is_target =
        |other: &ConvexPolygon| request.target.as_ref().is_some_and(|(target, _)| target == other);
    area.protected.iter().all(|other| is_outside(other) && (is_target(other) || is_clear(tail, other)))
        && area.obstacles.iter().all(|other| is_outside(other) && is_clear(tail, other))
}
