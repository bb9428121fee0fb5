//! Placement of speech balloons: they cover no faces, are read in order, and their tails do not cross.
//!
//! 1. For each balloon the candidate places on a grid are listed; hard constraints are checked and the rest
//!    get a cost.
//! 2. Branch and bound chooses one candidate for each balloon. The sum of the costs is the lowest that a
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
pub mod request;
mod tail;

use kurbo::Rect;

use super::layout::Reading;
use candidate::{BalloonCandidate, candidates};
use tail::is_clear;

pub use request::{PlacedBalloon, PlacementArea, PlacementRequest};

/// Maximum number of candidate pairs that the search compares.
const MAX_CHECKED_PAIRS: usize = 400_000;

/// Places all balloons, in reading order.
///
/// # Errors
/// Returns the index of a balloon that does not fit.
pub fn place_balloons(
    wishes: &[PlacementRequest],
    room: &PlacementArea,
) -> Result<Vec<PlacedBalloon>, usize> {
    let all: Vec<Vec<BalloonCandidate>> = wishes.iter().map(|wish| candidates(wish, room)).collect();
    if let Some(none) = all.iter().position(Vec::is_empty) {
        return Err(none);
    }
    // Lower bound of the cost of all balloons from each index on.
    let mut least = vec![0.0; all.len() + 1];
    for (number, own) in all.iter().enumerate().rev() {
        least[number] = least[number + 1] + own.first().map_or(0.0, |candidate| candidate.cost);
    }
    let told = wishes.iter().map(|wish| wish.at.is_some()).collect();
    let mut search = PlacementSearch {
        all: &all,
        has_given_place: told,
        least_cost_from: least,
        room,
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
        for own in candidates {
            let cost = cost + own.cost;
            let cannot_be_better = |(best, _): &(f64, _)| cost + self.least_cost_from[number + 1] >= *best;
            if self.checked_pairs > MAX_CHECKED_PAIRS || self.best.as_ref().is_some_and(cannot_be_better) {
                return;
            }
            self.checked_pairs += placed.len().max(1);
            let goes = |before: &&BalloonCandidate| {
                is_compatible(own, before, self.has_given_place[number], self.room)
            };
            if placed.iter().all(goes) {
                placed.push(own);
                self.try_next(placed, cost);
                placed.pop();
            }
        }
    }
}

/// Whether a candidate is compatible with one of an earlier balloon.
fn is_compatible(
    own: &BalloonCandidate,
    before: &BalloonCandidate,
    told: bool,
    room: &PlacementArea,
) -> bool {
    let is_read = told || is_read_after(own.bounds, before.bounds, room.reading);
    let apart = own.reach.inset(room.gap).intersect(before.reach).is_zero_area();
    let keeps_off = || {
        let (hull, other) = (&own.place.hull, &before.place.hull);
        !hull.meets(other, room.gap)
            && is_clear(own.tail.as_ref(), other)
            && is_clear(before.tail.as_ref(), hull)
            && before.tail.as_ref().is_none_or(|other| is_clear(own.tail.as_ref(), other))
    };
    is_read && (apart || keeps_off())
}

/// Whether one box is read after another: it is below the other's centre, or it starts past that centre in
/// reading direction and is not clearly higher.
fn is_read_after(own: Rect, before: Rect, reading: Reading) -> bool {
    let beside = match reading {
        Reading::Ltr => own.x0 >= before.center().x,
        Reading::Rtl => own.x1 <= before.center().x,
    };
    // A box on the side where reading starts must be completely below the other.
    let below = match reading {
        Reading::Ltr => own.center().x >= before.x0,
        Reading::Rtl => own.center().x <= before.x1,
    };
    let under = own.y0 >= before.center().y + if below { 0.0 } else { 0.5 * before.height() };
    under || (beside && own.center().y >= before.center().y - 0.15 * before.height())
}
