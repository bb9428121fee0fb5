//! Placement of speech balloons: they cover no faces, are read in order, and their tails do not cross.
//!
//! 1. For each balloon the candidate places on a grid are listed; hard constraints are checked and the rest
//!    get a cost.
//! 2. Branch and bound (this file) chooses one candidate for each balloon. The sum of the costs is the lowest that a
//!    bounded search finds.
//! 3. Two chosen candidates must not overlap, their tails must not cross, and the later one must be read
//!    later.
//!
//! Hard constraints are never weighed against costs.
//!
//! Files, in reading order: [`request`], the input and the result; `candidate`; `tail`, where a tail ends;
//! `cost`.

mod candidate;
mod cost;
pub(crate) mod request;
mod tail;

use kurbo::Rect;

use super::layout::Reading;
use candidate::{BalloonCandidate, candidates};
use tail::is_clear;

pub(crate) use request::{PlacedBalloon, PlacementArea, PlacementRequest};

/// Maximum number of candidate pairs that the search compares.
const MAX_CHECKED_PAIRS: usize = 400_000;

/// Places all balloons, in reading order.
///
/// # Errors
/// Returns the index of a balloon that does not fit.
pub(crate) fn place_balloons(
    requests: &[PlacementRequest],
    area: &PlacementArea,
) -> Result<Vec<PlacedBalloon>, usize> {
    let all: Vec<Vec<BalloonCandidate>> = requests.iter().map(|wish| candidates(wish, area)).collect();
    if let Some(unplaceable) = all.iter().position(Vec::is_empty) {
        return Err(unplaceable);
    }
    // Lower bound of the cost of all balloons from each index on.
    let mut min_cost_from = vec![0.0; all.len() + 1];
    for (number, balloon_candidates) in all.iter().enumerate().rev() {
        min_cost_from[number] =
            min_cost_from[number + 1] + balloon_candidates.first().map_or(0.0, |candidate| candidate.cost);
    }
    let is_placed_by_author = requests.iter().map(|wish| wish.at.is_some()).collect();
    let mut search = PlacementSearch {
        all: &all,
        has_given_place: is_placed_by_author,
        least_cost_from: min_cost_from,
        room: area,
        best: None,
        checked_pairs: 0,
        farthest: 0,
    };
    search.try_next(&mut Vec::new(), 0.0);
    match search.best {
        Some((_, best)) => Ok(best.into_iter().map(|candidate| candidate.place.clone()).collect()),
        None => Err(search.farthest),
    }
}

/// A branch-and-bound search for the cheapest compatible candidates.
struct PlacementSearch<'a> {
    all: &'a [Vec<BalloonCandidate>],
    has_given_place: Vec<bool>,
    least_cost_from: Vec<f64>,
    room: &'a PlacementArea,
    best: Option<(f64, Vec<&'a BalloonCandidate>)>,
    checked_pairs: usize,
    farthest: usize,
}

impl<'a> PlacementSearch<'a> {
    /// Tries the candidates of the next balloon. `placed` are those of the balloons before it, and `cost` is
    /// their total.
    fn try_next(&mut self, placed: &mut Vec<&'a BalloonCandidate>, cost: f64) {
        let number = placed.len();
        let all = self.all;
        let Some(candidates) = all.get(number) else {
            self.best = Some((cost, placed.clone()));
            return;
        };
        self.farthest = number.max(self.farthest);
        for candidate in candidates {
            let cost = cost + candidate.cost;
            let cannot_be_better = |(best, _): &(f64, _)| cost + self.least_cost_from[number + 1] >= *best;
            if self.checked_pairs > MAX_CHECKED_PAIRS || self.best.as_ref().is_some_and(cannot_be_better) {
                return;
            }
            self.checked_pairs += placed.len().max(1);
            let is_compatible_with = |earlier: &&BalloonCandidate| {
                is_compatible(candidate, earlier, self.has_given_place[number], self.room)
            };
            if placed.iter().all(is_compatible_with) {
                placed.push(candidate);
                self.try_next(placed, cost);
                placed.pop();
            }
        }
    }
}

/// Whether a candidate is compatible with one of an earlier balloon.
fn is_compatible(
    later: &BalloonCandidate,
    earlier: &BalloonCandidate,
    has_given_place: bool,
    area: &PlacementArea,
) -> bool {
    let is_read = has_given_place || is_read_after(later.bounds, earlier.bounds, area.reading);
    let are_apart = later.reach.inset(area.gap).intersect(earlier.reach).is_zero_area();
    let are_disjoint = || {
        let (hull, other) = (&later.place.hull, &earlier.place.hull);
        !hull.meets(other, area.gap)
            && is_clear(later.tail.as_ref(), other)
            && is_clear(earlier.tail.as_ref(), hull)
            && earlier.tail.as_ref().is_none_or(|other| is_clear(later.tail.as_ref(), other))
    };
    is_read && (are_apart || are_disjoint())
}

/// Whether one box is read after another: it is below the other's centre, or it starts past that centre in
/// reading direction and is not clearly higher.
fn is_read_after(later: Rect, earlier: Rect, reading: Reading) -> bool {
    let is_beside = match reading {
        Reading::Ltr => later.x0 >= earlier.center().x,
        Reading::Rtl => later.x1 <= earlier.center().x,
    };
    // A box on the side where reading starts must be completely below the other.
    let is_forward = match reading {
        Reading::Ltr => later.center().x >= earlier.x0,
        Reading::Rtl => later.center().x <= earlier.x1,
    };
    let is_under = later.y0 >= earlier.center().y + if is_forward { 0.0 } else { 0.5 * earlier.height() };
    is_under || (is_beside && later.center().y >= earlier.center().y - 0.15 * earlier.height())
}
