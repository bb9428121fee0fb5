//! Strokes: chains with their ink, as the line layers of a drawing.
//!
//! 1. Rules choose the pen of each chain ([`pens`]).
//! 2. The path of a chain becomes an axis of closely spaced points ([`axes`]). Halos and hand-drawn gaps
//!    interrupt it ([`gaps`]).
//! 3. Each piece gets a width at every point ([`widths`]) and an ink ([`inking`]). It becomes a stroked path,
//!    an outline of varying width ([`outlines`]) or a brushed shape ([`brushes`]).
//!
//! Files, in reading order: [`pens`]; [`axes`]; [`gaps`]; [`widths`]; [`outlines`]; [`brushes`]; [`inking`];
//! [`travel_order`] short pen-up ways for plotters; [`tolerances`] all thresholds for rounding.

mod axes;
pub(crate) mod brushes;
pub(crate) mod gaps;
mod inking;
mod outlines;
pub(crate) mod pens;
mod tolerances;
pub(crate) mod travel_order;
pub(crate) mod widths;

use std::sync::Arc;

use crate::parallel::prelude::*;
use kurbo::BezPath;

pub(crate) use brushes::brush::BrushShape;
pub(crate) use brushes::brush_source::{BrushChange, ShapeSource};

pub(crate) use pens::hand::HandChange;
pub(crate) use pens::ink_context::{InkContext, Parting};
pub(crate) use pens::ink_widths::InkWidths;
pub(crate) use pens::pen::PenChange;
pub use pens::pen::{Ink, Pen};
pub use pens::pen_choice::LineInfo;
pub(crate) use pens::pen_choice::PenChoice;
pub(crate) use pens::pen_rules::{Condition, LayerOptions, LayersBy, MarkOrder, Rule, StrokeOptions};
pub(crate) use widths::swell::SwellChange;

use crate::chains::{Chain, LineBackdrop};
use crate::colour::srgb::Colour;
use crate::drawing::{
    ImagePaint, Layer, LayerKind, Mark, OutlinePaint, Paint, Provenance, StrokePaint, Unit,
};
use crate::geometry::names::name_ids::stable_ids;
use crate::lines::{HiddenLines, LineKind};
use axes::stroke_axis::StrokeAxis;
use brushes::brush_image::StripPictures;
use inking::chain_ink::ChainInk;
use inking::ink_spans::SpanInk;
use inking::stroke_shape::StrokeShape;
use outlines::stroke_outline::Nib;

/// Turns chains into the layers `hidden-lines` and `lines`, back to front. Empty layers are omitted.
///
/// Weaker kinds come first, so that outlines paint over the lines that end at them. Lines of one kind keep
/// their order.
#[must_use]
pub(crate) fn ink(chains: &[Chain], context: &InkContext, options: &StrokeOptions) -> Vec<Layer> {
    let selection = options.selection(context);
    let mut hidden: Vec<&Chain> = Vec::new();
    let mut visible: Vec<&Chain> = Vec::new();
    for chain in chains {
        match (chain.invisibility > 0, context.hidden) {
            (false, _) => visible.push(chain),
            (true, HiddenLines::Dashed | HiddenLines::Solid) => hidden.push(chain),
            (true, HiddenLines::None) => {}
        }
    }
    let rank = |chain: &&Chain| (std::cmp::Reverse(chain.kind), chain.silhouette);
    hidden.par_sort_by_key(rank);
    visible.par_sort_by_key(rank);
    let behind = hidden.len();
    let all = if hidden.is_empty() { visible } else { [hidden, visible].concat() };
    let pen = |chain: &Chain| selection.pen(chain, options.pen.clone());
    let layers =
        [LayerKind::HiddenLines, LayerKind::Lines].into_iter().zip(marks(&all, behind, pen, context));
    layers.flat_map(|(kind, marks)| layers_of(kind, marks, options.layers, context.unit)).collect()
}

/// Turns chains of motion lines into the layer `motion`. `pen` gives the pen of each chain. Only rules that
/// name this kind of line change it.
#[must_use]
pub(crate) fn ink_motion(
    chains: &[Chain],
    context: &InkContext,
    options: &StrokeOptions,
    pen: impl Fn(&Chain) -> Pen + Sync,
) -> Vec<Layer> {
    let names_it = |rule: &&Rule| rule.when.kinds.contains(&LineKind::Motion);
    let rules = options.rules.iter().filter(names_it).cloned().collect();
    let options = StrokeOptions { rules, ..options.clone() };
    let selection = options.selection(context);
    let all: Vec<&Chain> = chains.iter().collect();
    let pen = |chain: &Chain| selection.pen(chain, pen(chain));
    let [marks, _] = marks(&all, all.len(), pen, context);
    layers_of(LayerKind::Motion, marks, options.layers, context.unit)
}

/// The marks of the first `behind` chains, and those of the others.
fn marks(
    chains: &[&Chain],
    behind: usize,
    pen: impl Fn(&Chain) -> Pen + Sync,
    context: &InkContext,
) -> [Vec<Mark>; 2] {
    let is_tinted = |chain: &Chain| chain.samples.iter().any(|s| s.backdrop != LineBackdrop::default());
    if chains.par_iter().any(|chain| is_tinted(chain) || pen(chain).has_hand()) {
        let pens: Vec<Pen> = chains.par_iter().map(|chain| pen(chain)).collect();
        let mut hidden = varying_marks(chains, &pens, context);
        let visible = hidden.split_off(behind);
        return [hidden, visible].map(|marks| marks.into_iter().flatten().collect());
    }
    // Each plain chain gives at most one mark, so marks are collected in place.
    let (hidden, visible) = chains.split_at(behind);
    [hidden, visible].map(|chains| {
        let marks: Vec<Option<Mark>> =
            chains.par_iter().with_max_len(16).map(|chain| mark(chain, context, &pen(chain))).collect();
        marks.into_iter().flatten().collect()
    })
}

/// The layers of a kind made from marks. No layer is empty.
fn layers_of(kind: LayerKind, marks: Vec<Mark>, options: LayerOptions, unit: Unit) -> Vec<Layer> {
    let mut layers = match options.by {
        LayersBy::Visibility => vec![Layer { kind, pen: None, ordered: false, marks }],
        LayersBy::Pen => by_pen(kind, marks, unit),
    };
    layers.retain(|layer| !layer.marks.is_empty());
    if options.order == MarkOrder::Travel {
        for layer in &mut layers {
            layer.marks = travel_order::shorten_travel(std::mem::take(&mut layer.marks));
            layer.ordered = true;
        }
    }
    layers
}

/// The marks of chains if some have hand-drawn effects or are interrupted by halos.
fn varying_marks(chains: &[&Chain], pens: &[Pen], context: &InkContext) -> Vec<Vec<Mark>> {
    let px = context.px();
    let axes: Vec<StrokeAxis> = chains.par_iter().map(|chain| StrokeAxis::of(chain, px).evened(px)).collect();
    let identities = stable_ids(context.parts.iter().map(|name| &**name));
    let depths = context.depths;
    let reach = |pen: &Pen| {
        let halo = pen.halo.in_unit(context.unit);
        if halo > 0.0 { halo + pen.width.in_unit(context.unit) / 2.0 } else { 0.0 }
    };
    let haloed: Vec<gaps::halo::HaloLine> =
        axes.iter().zip(pens).map(|(axis, pen)| gaps::halo::HaloLine { axis, reach: reach(pen) }).collect();
    let gaps = gaps::halo::gaps(&haloed, depths, px);
    let joined = axes::joined_ends::joined_ends(chains, &axes);
    let thick_of: Vec<Vec<f64>> = (0..chains.len())
        .into_par_iter()
        .map(|i| {
            widths::width_profile::widths(
                &axes[i],
                &inking::chain_ink::setting(chains[i], &pens[i], depths, &identities, context),
            )
        })
        .collect();
    let pictures = StripPictures::default();
    let of_chain = |i: usize| -> Vec<Mark> {
        let (chain, pen) = (chains[i], &pens[i]);
        let width = pen.width.in_unit(context.unit);
        if chain.path.elements().len() < 2 || width <= 0.0 {
            return Vec::new();
        }
        let inks = inking::ink_spans::ink_spans(&axes[i], chain, pen, context);
        let is_plain =
            inks.len() == 1 && inks[0].tint == SpanInk { colour: colour(chain, context, pen), width: 1.0 };
        if is_plain && !pen.has_hand() && gaps[i].is_empty() {
            return mark(chain, context, pen).into_iter().collect();
        }
        let solid = is_solid(chain, context, pen);
        let (axis, thick, gaps) = (&axes[i], &thick_of[i], &gaps[i]);
        let there = |(other, side): (usize, usize)| {
            let widths = &thick_of[other];
            if side == 0 { widths.first() } else { widths.last() }.copied()
        };
        let joined = joined[i].map(|end| end.and_then(there));
        let shapes = ChainInk {
            chain,
            axis,
            pen,
            thick,
            joined,
            gaps,
            identities: &identities,
            depths,
            solid,
            inks: &inks,
        }
        .shapes(context);
        let painted = shapes.into_iter().map(|(shape, colour)| match shape {
            StrokeShape::Path(path, closed) => stroked(path, closed, colour, chain, context, pen),
            StrokeShape::Outline { path, axis, width: mean } => {
                let paint = Paint::Outline(OutlinePaint { colour, axis, width: mean, pen_width: width });
                Mark { path, paint, provenance: provenance(chain, context) }
            }
            StrokeShape::Image { path, strip, pixels, pieces } => {
                let picture = pictures.of(&strip, pixels, colour);
                let paint = Paint::Image(ImagePaint { picture, pieces });
                Mark { path, paint, provenance: provenance(chain, context) }
            }
        });
        painted.collect()
    };
    (0..chains.len()).into_par_iter().map(of_chain).collect()
}

/// Whether a chain is drawn without dashes.
fn is_solid(chain: &Chain, context: &InkContext, pen: &Pen) -> bool {
    pen.dash.is_empty() || (chain.invisibility > 0 && context.hidden == HiddenLines::Solid)
}

/// The ink colour of a chain when the surface next to it is unknown.
fn colour(chain: &Chain, context: &InkContext, pen: &Pen) -> Colour {
    inking::ink_spans::pen_colour(chain, pen, None, context)
}

/// One chain with its pen. `None` if it has no path or its pen no width.
fn mark(chain: &Chain, context: &InkContext, pen: &Pen) -> Option<Mark> {
    let width = pen.width.in_unit(context.unit);
    if chain.path.elements().len() < 2 || width <= 0.0 {
        return None;
    }
    let fades = pen.fade > 0.0 && chain.samples.iter().any(|sample| sample.strength < 1.0);
    if is_solid(chain, context, pen) && fades {
        let px = context.px();
        let mut axis = StrokeAxis::of(chain, px);
        let leaving = inking::frame_cut::leaving(chain, &axis, context.frame, px);
        for (side, past) in
            inking::frame_cut::past(leaving, axis.length(), pen, context.unit).into_iter().enumerate()
        {
            axis.extend(side, past, px);
        }
        let widths = widths::width_profile::faded(&axis, width, pen.fade);
        let nib = Nib { caps: [pen.cap; 2], join: pen.join, px };
        if let Some(path) = outlines::stroke_outline::soft_outline(&axis, &widths, &nib) {
            let (colour, mean) = (colour(chain, context, pen), widths::width_profile::mean(&axis, &widths));
            let whole = if leaving == [None; 2] { chain.path.clone() } else { axis.path(px) };
            let mut shape = StrokeShape::Outline { path, axis: whole, width: mean };
            if let Some(frame) = context.frame.filter(|_| leaving != [None; 2]) {
                shape = inking::frame_cut::cut(shape, frame, px)?;
            }
            if let StrokeShape::Outline { path, axis, width: mean } = shape {
                let paint = Paint::Outline(OutlinePaint { colour, axis, width: mean, pen_width: width });
                return Some(Mark { path, paint, provenance: provenance(chain, context) });
            }
        }
    }
    Some(stroked(chain.path.clone(), chain.closed, colour(chain, context, pen), chain, context, pen))
}

/// A path stroked with a chain's pen.
fn stroked(
    path: BezPath,
    closed: bool,
    colour: Colour,
    chain: &Chain,
    context: &InkContext,
    pen: &Pen,
) -> Mark {
    let (dash, dash_offset) = if is_solid(chain, context, pen) {
        (Vec::new(), 0.0)
    } else {
        let period: Vec<f64> = pen.dash.iter().map(|length| length.in_unit(context.unit)).collect();
        match gaps::gap_origin::end_anchors(chain).filter(|_| !closed) {
            Some(ends) => gaps::dash::fixed(&path, ends, &period),
            None if closed => {
                gaps::dash::fit_round(&path, gaps::gap_origin::closed_origin_share(chain), &period)
            }
            None => gaps::dash::fit(&path, closed, &period),
        }
    };
    let width = pen.width.in_unit(context.unit);
    let paint = Paint::Stroke(StrokePaint { width, colour, cap: pen.cap, join: pen.join, dash, dash_offset });
    Mark { path, paint, provenance: provenance(chain, context) }
}

/// Classes and names of a chain.
fn provenance(chain: &Chain, context: &InkContext) -> Provenance {
    let mut classes = vec![chain.kind.name()];
    if chain.silhouette {
        classes.push("silhouette");
    }
    if chain.veiled {
        classes.push("veiled");
    }
    let material = context.materials.get(chain.material.index()).map(|(name, _)| name);
    Provenance {
        classes,
        invisibility: chain.invisibility,
        identity: chain.identity,
        places: Arc::clone(&chain.rest_cells),
        ..Provenance::of_names(context.parts.get(chain.part.index()), material)
    }
}

/// Splits marks into one layer per pen (width and colour), in order of first use. Labels start with a number,
/// which plotter programs use to select the pen.
fn by_pen(kind: LayerKind, marks: Vec<Mark>, unit: Unit) -> Vec<Layer> {
    let mut layers: Vec<Layer> = Vec::new();
    let mut pens: Vec<(f64, Colour)> = Vec::new();
    for mark in marks {
        let pen = match &mark.paint {
            Paint::Stroke(stroke) => (stroke.width, stroke.colour),
            Paint::Outline(outline) => (outline.pen_width, outline.colour),
            Paint::Fill(colour) => (0.0, *colour),
            Paint::Image(_) => (0.0, Colour::BLACK),
            Paint::Gradient(gradient) => (0.0, gradient.middle()),
        };
        let index = pens.iter().position(|known| *known == pen).unwrap_or_else(|| {
            pens.push(pen);
            let colour = String::from(pen.1);
            let width = (pen.0 * 1000.0).round() / 1000.0;
            let label = format!("{} {width} {} {colour}", pens.len(), unit.name());
            layers.push(Layer { kind, pen: Some(label), ordered: false, marks: Vec::new() });
            pens.len() - 1
        });
        if let Some(layer) = layers.get_mut(index) {
            layer.marks.push(mark);
        }
    }
    layers
}

#[cfg(test)]
mod tests;
