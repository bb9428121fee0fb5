//! Inks along a line. The ink changes where the adjacent material changes, or where the line separates two
//! blacks.
//!
//! Ink on black is invisible. As in comics, a line between two spot blacks is left white.

use crate::chains::Chain;
use crate::colour::srgb::Colour;
use crate::lines::LineKind;
use crate::strokes::axes::stroke_axis::StrokeAxis;
use crate::strokes::pens::ink_context::InkContext;
use crate::strokes::pens::pen::{Ink, Pen};

/// Least length of a span, px. Shorter ones take the ink of their longer neighbour.
const MIN_SPAN_PX: f64 = 5.0;

/// Least visible width of the black on either side of a white line, px.
const MIN_BLACK_MARGIN_PX: f64 = 1.0;

/// Ink of a span.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SpanInk {
    pub colour: Colour,
    /// Width as a share of the pen's width.
    pub width: f64,
}

/// Span of an axis in arc lengths, with its ink.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct InkSpan {
    pub from: f64,
    pub to: f64,
    pub tint: SpanInk,
}

/// The spans of a chain from start to end; neighbours differ. A chain without points has one.
pub(crate) fn ink_spans(axis: &StrokeAxis, chain: &Chain, pen: &Pen, context: &InkContext) -> Vec<InkSpan> {
    let tint = |i: usize| tint(axis, i, chain, pen, context);
    let mut stretches: Vec<InkSpan> = Vec::new();
    for i in 0..axis.len() {
        let tint = tint(i);
        // Each point stands for the stretch closer to it than to its neighbours.
        let border = |k: usize| f64::midpoint(axis.arcs[k], axis.arcs[k.saturating_sub(1)]);
        match stretches.last_mut() {
            Some(last) if last.tint == tint => {}
            Some(last) => {
                last.to = border(i);
                stretches.push(InkSpan { from: border(i), to: border(i), tint });
            }
            None => stretches.push(InkSpan { from: axis.arcs[0], to: axis.arcs[0], tint }),
        }
    }
    match (stretches.last_mut(), axis.arcs.last()) {
        (Some(last), Some(end)) => last.to = *end,
        _ => {
            let tint = SpanInk { colour: pen_colour(chain, pen, None, context), width: 1.0 };
            return vec![InkSpan { from: 0.0, to: 0.0, tint }];
        }
    }
    merge_short_spans(stretches, MIN_SPAN_PX * context.px())
}

/// Merges spans that are too short to be noticed.
fn merge_short_spans(mut stretches: Vec<InkSpan>, least: f64) -> Vec<InkSpan> {
    let long = |stretch: &InkSpan| stretch.to - stretch.from;
    while stretches.len() > 1 {
        let by_length = |a: &usize, b: &usize| long(&stretches[*a]).total_cmp(&long(&stretches[*b]));
        let Some(short) = (0..stretches.len()).min_by(by_length).filter(|k| long(&stretches[*k]) < least)
        else {
            break;
        };
        let before = short.checked_sub(1);
        let after = (short + 1 < stretches.len()).then_some(short + 1);
        let neighbour = [before, after].into_iter().flatten().max_by(by_length);
        stretches[short].tint = neighbour.map_or(stretches[short].tint, |k| stretches[k].tint);
        merge_equal_inks(&mut stretches);
    }
    stretches
}

/// Merges neighbours of equal ink.
pub(crate) fn merge_equal_inks(spans: &mut Vec<InkSpan>) {
    spans.dedup_by(|next, last| {
        let is_equal = last.tint == next.tint;
        if is_equal {
            last.to = next.to;
        }
        is_equal
    });
}

/// The ink at a point of an axis.
fn tint(axis: &StrokeAxis, i: usize, chain: &Chain, pen: &Pen, context: &InkContext) -> SpanInk {
    let under = axis.samples[i].backdrop;
    if let Some(parting) = context.parting.filter(|_| chain.invisibility == 0 && parts(chain.kind)) {
        let half = parting.width * pen.width.in_unit(context.unit) / 2.0;
        if half > 0.0 && under.black >= half + half.max(MIN_BLACK_MARGIN_PX * context.px()) {
            let mut colour = parting.colour;
            colour.a = (f64::from(colour.a) * pen.opacity).round() as u8;
            return SpanInk { colour, width: parting.width };
        }
    }
    SpanInk { colour: pen_colour(chain, pen, under.colour, context), width: 1.0 }
}

/// The colour of a pen on a line next to a material of colour `beside`.
pub(crate) fn pen_colour(chain: &Chain, pen: &Pen, beside: Option<Colour>, context: &InkContext) -> Colour {
    let mut colour = match pen.colour {
        Ink::Fixed(colour) => colour,
        Ink::Shade(shade) => {
            let base = beside.or_else(|| material_colour(chain, context));
            base.map_or(Colour::BLACK, |base| base.darker(shade))
        }
    };
    colour.a = (f64::from(colour.a) * pen.opacity).round() as u8;
    colour
}

/// The colour of a chain's material.
fn material_colour(chain: &Chain, context: &InkContext) -> Option<Colour> {
    context.materials.get(chain.material.index()).map(|(_, base)| *base)
}

/// Whether lines of a kind separate surfaces, rather than lie on one.
fn parts(kind: LineKind) -> bool {
    use LineKind::{Border, Contour, Crease, Intersection, Material};
    matches!(kind, Contour | Border | Crease | Material | Intersection)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn consecutive_spans(of: &[(f64, u8)]) -> Vec<InkSpan> {
        let mut from = 0.0;
        let stretch = |(to, grey): &(f64, u8)| {
            let tint = SpanInk { colour: Colour::rgb(*grey, *grey, *grey), width: 1.0 };
            let stretch = InkSpan { from, to: *to, tint };
            from = *to;
            stretch
        };
        of.iter().map(stretch).collect()
    }

    #[test]
    fn merge_short_spans_joins_short_spans_to_the_longer_neighbour() {
        assert_eq!(
            merge_short_spans(consecutive_spans(&[(10.0, 1), (12.0, 2), (40.0, 3)]), 5.0),
            consecutive_spans(&[(10.0, 1), (40.0, 3)])
        );
        assert_eq!(
            merge_short_spans(consecutive_spans(&[(10.0, 1), (12.0, 2), (40.0, 1)]), 5.0),
            consecutive_spans(&[(40.0, 1)])
        );
        assert_eq!(
            merge_short_spans(consecutive_spans(&[(2.0, 1), (3.0, 2)]), 5.0),
            consecutive_spans(&[(3.0, 1)])
        );
        assert_eq!(
            merge_short_spans(consecutive_spans(&[(6.0, 1), (12.0, 2)]), 5.0),
            consecutive_spans(&[(6.0, 1), (12.0, 2)])
        );
    }
}
