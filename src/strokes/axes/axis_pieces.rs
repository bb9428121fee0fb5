//! Splits an axis at gaps such as halos, and at corners where the pen is lifted.

use super::stroke_axis::StrokeAxis;

/// Cosine of the least corner turn that lifts the pen, 35 degrees.
const LIFT_COSINE: f64 = 0.819;

/// Part of an axis with its ends.
#[derive(Debug, Clone)]
pub(crate) struct AxisPart {
    pub axis: StrokeAxis,
    pub ends: [PieceEnd; 2],
}

/// Treatment of an end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PieceEnd {
    pub tapers: bool,
    pub runs_on: bool,
    /// Distance that the line continues past the frame's border, which cuts it; 0 inside the frame.
    pub past: f64,
}

impl PieceEnd {
    /// End at a gap.
    const GAP: Self = Self { tapers: true, runs_on: false, past: 0.0 };
    /// End at a corner where the pen is lifted.
    const LIFTED: Self = Self { tapers: true, runs_on: true, past: 0.0 };
}

/// Least length of a piece between gaps, px. Shorter ones are dropped.
const MIN_PIECE_PX: f64 = 0.75;

/// The parts of an axis outside of gaps.
///
/// Gaps are ascending arc lengths. Those of an open axis lie between its ends; those of a closed axis may
/// cross its seam. With `lifts`, sharp corners split the axis as well. `ends` describes the ends of an open
/// axis.
pub(crate) fn split_axis(
    axis: &StrokeAxis,
    gaps: &[[f64; 2]],
    lifts: bool,
    ends: [PieceEnd; 2],
    px: f64,
) -> Vec<AxisPart> {
    let total = axis.length();
    let mut cuts: Vec<([f64; 2], PieceEnd)> = gaps.iter().map(|gap| (*gap, PieceEnd::GAP)).collect();
    if lifts {
        let sharp = axis.corners.iter().filter(|c| {
            let [comes, leaves] = axis.at_corner(**c);
            comes.dot(leaves) < LIFT_COSINE
        });
        let inside = |arc: f64| gaps.iter().any(|[from, to]| *from <= arc && arc <= *to);
        let at = sharp.map(|c| axis.arcs[*c]).filter(|arc| !inside(*arc));
        cuts.extend(at.map(|arc| ([arc; 2], PieceEnd::LIFTED)));
        cuts.sort_by(|a, b| a.0[0].total_cmp(&b.0[0]));
    }
    if cuts.is_empty() {
        return vec![AxisPart { axis: axis.clone(), ends }];
    }
    let mut pieces = Vec::new();
    let mut add = |from: f64, to: f64, ends: [PieceEnd; 2]| {
        if to - from >= MIN_PIECE_PX * px {
            pieces.push(AxisPart { axis: axis.cut(from, to), ends });
        }
    };
    let (Some(first), Some(last)) = (axis.arcs.first(), axis.arcs.last()) else { return pieces };
    if !axis.closed {
        let (gap, end) = &cuts[0];
        add(*first, gap[0], [ends[0], *end]);
    }
    for (i, (gap, end)) in cuts.iter().enumerate() {
        match cuts.get(i + 1) {
            Some((next, then)) => add(gap[1], next[0], [*end, *then]),
            None if axis.closed => {
                let (next, then) = &cuts[0];
                add(gap[1], next[0] + total, [*end, *then]);
            }
            None => add(gap[1], *last, [*end, ends[1]]),
        }
    }
    pieces
}
