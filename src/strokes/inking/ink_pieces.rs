//! [`Drawn`]: a piece of a line ready to be drawn, and its division where the ink changes.

use super::ink_spans::{Stretch, Tint};
use crate::drawing::Cap;
use crate::strokes::axes::stroke_axis::Axis;

/// Piece of a line ready to be drawn.
#[derive(Debug, Clone)]
pub(crate) struct Drawn {
    pub axis: Axis,
    /// Width at each point.
    pub thick: Vec<f64>,
    /// Least extent of a brush to either side at each point.
    pub reach: Vec<f64>,
    /// Caps at the start and at the end.
    pub caps: [Cap; 2],
}

impl Drawn {
    /// This piece with its width multiplied by a factor.
    pub fn times(mut self, factor: f64) -> Self {
        self.thick.iter_mut().for_each(|width| *width *= factor);
        self
    }
}

/// Splits a piece where its ink changes. `round` is the length of a closed chain. Cut ends get butt caps.
pub(crate) fn parts(drawn: &Drawn, inks: &[Stretch], round: Option<f64>) -> Vec<(Drawn, Tint)> {
    let Drawn { axis, thick, reach, caps } = drawn;
    let (Some(first), Some(last)) = (axis.arcs.first().copied(), axis.arcs.last().copied()) else {
        return Vec::new();
    };
    // The samples carry widths and reaches from here on; their own values have been used.
    let mut carrier = axis.clone();
    for ((sample, width), reach) in carrier.samples.iter_mut().zip(thick).zip(reach) {
        (sample.strength, sample.gap) = (*width, *reach);
    }
    let part = |stretch: Stretch| {
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
            (Drawn { axis: part, thick, reach, caps }.times(stretch.tint.width), stretch.tint)
        })
    };
    laid(inks, round, axis.closed).into_iter().filter_map(part).collect()
}

/// The spans over all arc lengths that pieces can have.
///
/// Pieces of a closed chain continue past its seam, and open chains are extended at their ends. A whole
/// closed chain starts where its ink first changes.
fn laid(inks: &[Stretch], round: Option<f64>, whole: bool) -> Vec<Stretch> {
    let mut all = inks.to_vec();
    match round {
        Some(round) => {
            all.extend(inks.iter().map(|s| Stretch { from: s.from + round, to: s.to + round, ..*s }));
            if whole {
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
    all.into_iter().fold(Vec::new(), |mut kept: Vec<Stretch>, next| {
        match kept.last_mut() {
            Some(last) if last.tint == next.tint => last.to = next.to,
            _ => kept.push(next),
        }
        kept
    })
}

#[cfg(test)]
mod tests {
    use kurbo::Point;

    use super::*;
    use crate::chains::Sample;
    use crate::colour::srgb::Colour;

    fn stretch(from: f64, to: f64, grey: u8) -> Stretch {
        Stretch { from, to, tint: Tint { colour: Colour::rgb(grey, grey, grey), width: 1.0 } }
    }

    /// Start, end and grey of each part.
    fn found(closed: bool, inks: &[Stretch]) -> Vec<(f64, f64, u8)> {
        let corners = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0), (0.0, 0.0)].map(Point::from);
        let axis = Axis {
            points: corners.to_vec(),
            arcs: (0..5).map(|k| f64::from(k) * 10.0).collect(),
            samples: vec![Sample::new(1.0, 1.0); 5],
            corners: Vec::new(),
            closed,
        };
        let drawn = Drawn { axis, thick: vec![2.0; 5], reach: vec![0.0; 5], caps: [Cap::Round; 2] };
        let of = |(part, tint): &(Drawn, Tint)| {
            let arcs = &part.axis.arcs;
            (arcs[0], arcs[arcs.len() - 1], tint.colour.r)
        };
        parts(&drawn, inks, closed.then_some(40.0)).iter().map(of).collect()
    }

    #[test]
    fn lines_change_their_ink_where_they_should() {
        let inks = [stretch(0.0, 15.0, 1), stretch(15.0, 25.0, 2), stretch(25.0, 40.0, 1)];
        assert_eq!(found(false, &inks), [(0.0, 15.0, 1), (15.0, 25.0, 2), (25.0, 40.0, 1)]);
        // On a closed line, equal inks at both ends of the list form one span.
        assert_eq!(found(true, &inks), [(15.0, 25.0, 2), (25.0, 55.0, 1)]);
        assert_eq!(found(true, &inks[..2]).len(), 2);
    }
}
