//! Hand-drawn gaps in a line.

use crate::geometry::numbers::noise::{hash, unit_interval};
use crate::strokes::axes::axis_pieces::{AxisPart, split_axis};

/// Greatest number of gaps in a line.
const MAX_GAPS: f64 = 10_000.0;

/// Margin at either end of a step where no gap has its middle, as a share of the step.
const GAP_MARGIN_OF_STEP: f64 = 0.2;

/// Greatest half length of a gap as a share of the step.
const MAX_HALF_GAP_OF_STEP: f64 = 0.15;

/// Random gaps in a line. Lengths are in user units.
#[derive(Debug, Clone, Copy)]
pub(crate) struct HandGaps {
    pub mean: f64,
    pub gap: f64,
    pub seed: u64,
}

/// Origin of gaps that are fixed to the model. `arc` is an arc length, possibly outside the chain;
/// `backwards` reverses the count.
#[derive(Debug, Clone, Copy)]
pub(crate) struct GapOrigin {
    pub arc: f64,
    pub backwards: bool,
}

impl HandGaps {
    /// Splits piece `number` of an axis at its gaps. The number of gaps does not depend on the seed, unless
    /// they are fixed to the model.
    pub(crate) fn split_at_gaps(
        &self,
        piece: AxisPart,
        number: usize,
        moored: Option<GapOrigin>,
        px: f64,
    ) -> Vec<AxisPart> {
        let (Some(first), true) = (piece.axis.arcs.first(), self.mean > 0.0 && self.gap > 0.0) else {
            return vec![piece];
        };
        let range = [*first, first + piece.axis.length()];
        let gaps = match moored {
            Some(moored) => self.on_model(range, moored),
            None => self.along(range, hash(self.seed, &[0, number as u64])),
        };
        split_axis(&piece.axis, &gaps, false, piece.ends, px)
    }

    /// Gaps spread over all of a piece.
    fn along(&self, [from, to]: [f64; 2], seed: u64) -> Vec<[f64; 2]> {
        let count = ((to - from) / self.mean).round().min(MAX_GAPS) as usize;
        let step = (to - from) / count as f64;
        let gap = |k: usize| {
            let chance = |word: u64| unit_interval(hash(seed, &[k as u64, word]));
            self.around(from + (k as f64 + place(chance(0))) * step, step, chance(1))
        };
        (0..count).map(gap).collect()
    }

    /// Gaps at fixed positions, independent of where the piece begins and ends. Gaps at its ends are dropped.
    fn on_model(&self, [from, to]: [f64; 2], GapOrigin { arc, backwards }: GapOrigin) -> Vec<[f64; 2]> {
        let step = self.mean.max((to - from) / MAX_GAPS);
        let cells = [from, to].map(|end| ((end - arc) / step).floor());
        let count = (cells[1] - cells[0]).clamp(0.0, MAX_GAPS) as usize;
        let gaps = (0..=count).map(|k| {
            let cell = cells[0] + k as f64;
            let own = if backwards { -1.0 - cell } else { cell };
            let chance = |word: u64| unit_interval(hash(self.seed, &[0, (own as i64).cast_unsigned(), word]));
            let within = if backwards { 1.0 - place(chance(0)) } else { place(chance(0)) };
            self.around(arc + (cell + within) * step, step, chance(1))
        });
        gaps.filter(|gap| from < gap[0] && gap[1] < to).collect()
    }

    /// A gap around a position. `step` is the mean distance to the next one.
    fn around(&self, middle: f64, step: f64, chance: f64) -> [f64; 2] {
        let half = (self.gap * (0.6 + 0.8 * chance) / 2.0).min(MAX_HALF_GAP_OF_STEP * step);
        [middle - half, middle + half]
    }
}

/// Position of a gap within its step, 0 to 1.
fn place(chance: f64) -> f64 {
    GAP_MARGIN_OF_STEP + (1.0 - 2.0 * GAP_MARGIN_OF_STEP) * chance
}

#[cfg(test)]
mod tests {
    use super::*;

    const SAMPLE_GAPS: HandGaps = HandGaps { mean: 20.0, gap: 3.0, seed: 7 };

    fn gaps_are_near(a: &[[f64; 2]], b: &[[f64; 2]]) -> bool {
        a.len() == b.len() && a.iter().flatten().zip(b.iter().flatten()).all(|(a, b)| (a - b).abs() < 1e-9)
    }

    #[test]
    fn hand_gaps_stay_fixed_on_the_model() {
        let moored = |arc: f64| GapOrigin { arc, backwards: false };
        let all = SAMPLE_GAPS.on_model([0.0, 200.0], moored(-30.0));
        assert!((9..=10).contains(&all.len()), "{all:?}");
        // The same line without its first 70 units, which are hidden.
        let rest = SAMPLE_GAPS.on_model([0.0, 130.0], moored(-100.0));
        let moved: Vec<_> = rest.iter().map(|gap| gap.map(|arc| arc + 70.0)).collect();
        assert!(gaps_are_near(&all[all.len() - rest.len()..], &moved), "{all:?} {moved:?}");
        // The same line in the opposite direction.
        let turned = SAMPLE_GAPS.on_model([0.0, 200.0], GapOrigin { arc: 230.0, backwards: true });
        let turned: Vec<_> = turned.iter().rev().map(|[from, to]| [200.0 - to, 200.0 - from]).collect();
        assert!(gaps_are_near(&all, &turned), "{all:?} {turned:?}");
    }
}
