//! Identities of chains: numbers that strokes keep while the model moves, made from what of it lies under them.
//!
//! Space round the model at rest is cut into cells. Each cell a chain runs through draws a lot, the better the longer the
//! chain is in it, and the best lot names the chain: two chains have the same name as often as they have the same cells, so
//! that one which loses or gains a little keeps its name mostly. Where several chains run through a cell, the one whose lot is best has
//! it, and the others have the next best of theirs that is free; what finds none is named by finer cells. Nothing is asked but
//! the chains themselves: a frame's names depend on no other frame.
//!
//! Source: lots are weighted minwise hashing (Ioffe, Improved Consistent Sampling, Weighted Minhash and L1 Sketching, ICDM
//! 2010), with exponential lots.

use kurbo::Point;
use rustc_hash::FxHashSet;

use super::{Anchor, Chain};
use crate::lines::LineKind;
use crate::math::function::ln;
use crate::math::noise::{hash, unit};

/// Cells along the diagonal of a model, from coarse to fine, for contours, which creep over these while
/// the eye moves, and for all others, which stay.
const SLIDING: [f64; 5] = [6.0, 18.0, 54.0, 160.0, 500.0];
const STAYING: [f64; 5] = [24.0, 72.0, 216.0, 650.0, 4000.0];

/// Most of a straight piece that is taken to lie in one cell, user units, and the most pieces of a line between two points.
const STEP: f64 = 4.0;
const MOST_STEPS: f64 = 512.0;

/// Shifts the cells, so that no plane of symmetry is between two of them.
const SHIFT: f64 = 0.372_915;

/// Names the chains that know where on the model they are; `parts` tell parts apart.
pub(crate) fn name(chains: &mut [Chain], parts: &[u64]) {
    let mut open: Vec<usize> =
        (0..chains.len()).filter(|number| chains.get(*number).is_some_and(is_anchored)).collect();
    for level in 0..SLIDING.len() {
        let mut wishes: Vec<(f64, u64, usize)> = Vec::new();
        for number in &open {
            let lots = chains.get(*number).map(|chain| lots(chain, parts, level)).unwrap_or_default();
            wishes.extend(lots.into_iter().map(|(lot, name)| (lot, name, *number)));
        }
        wishes.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)).then(a.2.cmp(&b.2)));
        let mut given: FxHashSet<u64> = FxHashSet::default();
        for (_, name, number) in wishes {
            if let Some(chain) = chains.get_mut(number).filter(|chain| chain.identity == 0)
                && given.insert(name)
            {
                chain.identity = name;
            }
        }
        open.retain(|number| chains.get(*number).is_some_and(|chain| chain.identity == 0));
    }
    // What even the finest cells do not tell apart lies one upon the other.
    for (order, number) in open.into_iter().enumerate() {
        if let Some(chain) = chains.get_mut(number) {
            let name = lots(chain, parts, SLIDING.len() - 1).first().map_or(1, |(_, name)| *name);
            chain.identity = hash(name, &[order as u64]).max(1);
        }
    }
}

fn is_anchored(chain: &Chain) -> bool {
    chain.samples.iter().any(|sample| sample.anchor.is_known())
}

/// The lots of the cells of a chain, and what they would name it.
fn lots(chain: &Chain, parts: &[u64], level: usize) -> Vec<(f64, u64)> {
    let slides = chain.kind == LineKind::Contour;
    let cells = if slides { SLIDING[level] } else { STAYING[level] };
    let part = parts.get(chain.part.index()).copied().unwrap_or_default();
    let mut weights: Vec<([i64; 3], f64)> = Vec::new();
    for (anchor, length) in pieces(chain).filter(|(anchor, _)| anchor.is_known()) {
        let cell = anchor.place.map(|x| ((f64::from(x) + SHIFT) * cells).floor() as i64);
        match weights.last_mut() {
            Some((last, weight)) if *last == cell => *weight += length,
            _ => weights.push((cell, length)),
        }
    }
    weights.sort_by_key(|(cell, _)| *cell);
    weights.dedup_by(|next, kept| {
        let same = next.0 == kept.0;
        if same {
            kept.1 += next.1;
        }
        same
    });
    let lot = |(cell, weight): &([i64; 3], f64)| {
        let words = cell.map(i64::cast_unsigned);
        let own = hash(part, &[u64::from(slides), level as u64, words[0], words[1], words[2]]);
        (-ln(unit(hash(own, &[0])).max(f64::MIN_POSITIVE)) / weight.max(f64::MIN_POSITIVE), own)
    };
    weights.iter().map(lot).map(|(lot, own)| (lot, own.max(1))).collect()
}

/// A chain as short straight pieces: where on the model the middle of each is, and its length.
fn pieces(chain: &Chain) -> impl Iterator<Item = (Anchor, f64)> + '_ {
    let count = chain.points.len();
    let sides = if chain.closed { count } else { count.saturating_sub(1) };
    (0..sides).flat_map(move |side| {
        let next = (side + 1) % count;
        let point = |at: usize| chain.points.get(at).copied().unwrap_or(Point::ZERO);
        let length = (point(next) - point(side)).hypot2().sqrt();
        let steps = (length / STEP).ceil().clamp(1.0, MOST_STEPS);
        let ends =
            [side, next].map(|at| chain.samples.get(at).map(|sample| sample.anchor).unwrap_or_default());
        (0..steps as usize)
            .map(move |step| (ends[0].lerp(ends[1], (step as f64 + 0.5) / steps), length / steps))
    })
}
