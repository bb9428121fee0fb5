//! [`InkedPiece`]: a piece of a line ready to be drawn, and its division where the ink changes.

use super::ink_spans::{InkSpan, SpanInk, merge_equal_inks};
use crate::drawing::Cap;
use crate::strokes::axes::stroke_axis::StrokeAxis;

/// Piece of a line ready to be drawn.
#[derive(Debug, Clone)]
pub(crate) struct InkedPiece {
    pub axis: StrokeAxis,
    /// Width at each point.
    pub thick: Vec<f64>,
    /// Least extent of a brush to either side at each point.
    pub reach: Vec<f64>,
    /// Caps at the start and at the end.
    pub caps: [Cap; 2],
}

impl InkedPiece {
    /// This piece with its width multiplied by a factor.
    pub(crate) fn times(mut self, factor: f64) -> Self {
        self.thick.iter_mut().for_each(|width| *width *= factor);
        self
    }
}

/// Splits a piece where its ink changes. `round` is the length of a closed chain. Cut ends get butt caps.
pub(crate) fn split_by_ink(
    drawn: &InkedPiece,
    inks: &[InkSpan],
    round: Option<f64>,
) -> Vec<(InkedPiece, SpanInk)> {
    let InkedPiece { axis, thick, reach, caps } = drawn;
    let (Some(first), Some(last)) = (axis.arcs.first().copied(), axis.arcs.last().copied()) else {
        return Vec::new();
    };
    // The samples carry widths and reaches from here on; their own values have been used.
    let mut carrier = axis.clone();
    for ((sample, width), reach) in carrier.samples.iter_mut().zip(thick).zip(reach) {
        (sample.strength, sample.gap) = (*width, *reach);
    }
    let part = |stretch: InkSpan| {
        let (from, to) = if axis.closed {
            (stretch.from, stretch.to)
        } else {
            (stretch.from.max(first), stretch.to.min(last))
        };
        (to > from).then(|| {
            let part = carrier.cut(from, to).subdivided();
            let is_cut = [axis.closed || from > first, axis.closed || to < last];
            let caps = [0, 1].map(|side| if is_cut[side] { Cap::Butt } else { caps[side] });
            let thick = part.samples.iter().map(|sample| sample.strength).collect();
            let reach = part.samples.iter().map(|sample| sample.gap).collect();
            (InkedPiece { axis: part, thick, reach, caps }.times(stretch.tint.width), stretch.tint)
        })
    };
    cyclic_spans(inks, round, axis.closed).into_iter().filter_map(part).collect()
}

/// The spans over all arc lengths that pieces can have.
///
/// Pieces of a closed chain continue past its seam, and open chains are extended at their ends. A whole
/// closed chain starts where its ink first changes.
fn cyclic_spans(inks: &[InkSpan], round: Option<f64>, is_whole: bool) -> Vec<InkSpan> {
    let mut all = inks.to_vec();
    match round {
        Some(round) => {
            all.extend(inks.iter().map(|s| InkSpan { from: s.from + round, to: s.to + round, ..*s }));
            if is_whole {
                // Of two rounds, keep one round from the first change.
                all = all.into_iter().skip(1).take(inks.len()).collect();
            }
        }
        None => {
            if let Some(stretch) = all.first_mut() {
                stretch.from = f64::NEG_INFINITY;
            }
            if let Some(stretch) = all.last_mut() {
                stretch.to = f64::INFINITY;
            }
        }
    }
    merge_equal_inks(&mut all);
    all
}

#[cfg(test)]
mod tests {
    use kurbo::Point;

    use super::*;
    use crate::chains::Sample;
    use crate::colour::srgb::Colour;

    fn ink_span(from: f64, to: f64, grey: u8) -> InkSpan {
        InkSpan { from, to, tint: SpanInk { colour: Colour::rgb(grey, grey, grey), width: 1.0 } }
    }

    /// Start, end and grey of each part.
    fn split_pieces(closed: bool, inks: &[InkSpan]) -> Vec<(f64, f64, u8)> {
        let corners = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0), (0.0, 0.0)].map(Point::from);
        let axis = StrokeAxis {
            points: corners.to_vec(),
            arcs: (0..5).map(|k| f64::from(k) * 10.0).collect(),
            samples: vec![Sample::new(1.0, 1.0); 5],
            corners: Vec::new(),
            closed,
        };
        let drawn = InkedPiece { axis, thick: vec![2.0; 5], reach: vec![0.0; 5], caps: [Cap::Round; 2] };
        let of = |(part, tint): &(InkedPiece, SpanInk)| {
            let arcs = &part.axis.arcs;
            (arcs[0], arcs[arcs.len() - 1], tint.colour.r)
        };
        split_by_ink(&drawn, inks, closed.then_some(40.0)).iter().map(of).collect()
    }

    #[test]
    fn split_by_ink_cuts_lines_at_ink_span_ends() {
        let inks = [ink_span(0.0, 15.0, 1), ink_span(15.0, 25.0, 2), ink_span(25.0, 40.0, 1)];
        assert_eq!(split_pieces(false, &inks), [(0.0, 15.0, 1), (15.0, 25.0, 2), (25.0, 40.0, 1)]);
        // On a closed line, equal inks at both ends of the list form one span.
        assert_eq!(split_pieces(true, &inks), [(15.0, 25.0, 2), (25.0, 55.0, 1)]);
        assert_eq!(split_pieces(true, &inks[..2]).len(), 2);
    }
}
