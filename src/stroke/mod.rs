//! Strokes: chains with their ink, as the line layers of a drawing.

pub mod dash;
pub mod options;
mod outline;
pub mod pen;
pub mod travel;

use std::sync::Arc;

use kurbo::BezPath;
use rayon::prelude::*;

pub use crate::math::glob::Glob;
pub use options::{Condition, LayerOptions, LayersBy, Order, Rule, StrokeOptions};
pub use pen::{Ink, Pen, PenChange};

use crate::chain::Chain;
use crate::drawing::{Layer, LayerKind, Length, Mark, OutlinePaint, Paint, Provenance, StrokePaint, Unit};
use crate::lines::HiddenLines;
use crate::math::colour::Colour;
use outline::Swell;

/// What strokes need of the scene and the page: names, colours and the unit.
#[derive(Debug, Clone, Copy)]
pub struct InkContext<'a> {
    /// Unit of the chains' points and of the drawing.
    pub unit: Unit,
    /// Names of the parts, by [`crate::mesh::PartId`].
    pub parts: &'a [Arc<str>],
    /// Names and base colours of the materials, by [`crate::mesh::MaterialId`].
    pub materials: &'a [(Arc<str>, Colour)],
    /// What becomes of hidden chains.
    pub hidden: HiddenLines,
}

/// Turns chains into the layers `hidden-lines` and `lines`, back to front; empty ones are absent.
///
/// Weaker kinds come first, so that outlines paint over the lines that end at them; lines of one
/// kind keep their order.
#[must_use]
pub fn ink(chains: &[Chain], context: &InkContext, options: &StrokeOptions) -> Vec<Layer> {
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
    let mut layers = Vec::new();
    for (kind, mut chains) in [(LayerKind::HiddenLines, hidden), (LayerKind::Lines, visible)] {
        chains.sort_by_key(|chain| (std::cmp::Reverse(chain.kind), chain.silhouette));
        let marks: Vec<Mark> =
            chains.par_iter().filter_map(|chain| mark(chain, context, &selection.pen(chain))).collect();
        let parted = match options.layers.by {
            LayersBy::Visibility => vec![Layer { kind, pen: None, marks }],
            LayersBy::Pen => by_pen(kind, marks, context.unit),
        };
        layers.extend(parted.into_iter().filter(|layer| !layer.marks.is_empty()));
    }
    if options.layers.order == Order::Travel {
        for layer in &mut layers {
            layer.marks = travel::shorten(std::mem::take(&mut layer.marks));
        }
    }
    layers
}

/// One chain with its pen; `None` if it has no path or its pen no width.
fn mark(chain: &Chain, context: &InkContext, pen: &Pen) -> Option<Mark> {
    let width = pen.width.in_unit(context.unit);
    if chain.path.elements().len() < 2 || width <= 0.0 {
        return None;
    }
    let material = context.materials.get(chain.material.index());
    let mut colour = match pen.colour {
        Ink::Fixed(colour) => colour,
        Ink::Shade(shade) => material.map_or(Colour::BLACK, |(_, base)| base.darker(shade)),
    };
    colour.a = (f64::from(colour.a) * pen.opacity).round() as u8;
    let solid = pen.dash.is_empty() || (chain.invisibility > 0 && context.hidden == HiddenLines::Solid);
    if solid
        && pen.fade > 0.0
        && outline::varies(chain)
        && let Some(outline) = outline::outline(
            chain,
            &Swell { width, fade: pen.fade, cap: pen.cap, px: Length::px(1.0).in_unit(context.unit) },
        )
    {
        let axis = chain.path.clone();
        return Some(Mark {
            path: outline.path,
            paint: Paint::Outline(OutlinePaint { colour, axis, width: outline.width, pen_width: width }),
            provenance: provenance(chain, context),
        });
    }
    let (dash, dash_offset) = if solid {
        (Vec::new(), 0.0)
    } else {
        let period: Vec<f64> = pen.dash.iter().map(|length| length.in_unit(context.unit)).collect();
        dash::fit(&chain.path, chain.closed, &period)
    };
    Some(Mark {
        path: chain.path.clone(),
        paint: Paint::Stroke(StrokePaint { width, colour, cap: pen.cap, join: pen.join, dash, dash_offset }),
        provenance: provenance(chain, context),
    })
}

/// The chain's classes and names.
fn provenance(chain: &Chain, context: &InkContext) -> Provenance {
    let mut classes = vec![chain.kind.name()];
    if chain.silhouette {
        classes.push("silhouette");
    }
    let name = |name: &Arc<str>| (!name.is_empty()).then(|| Arc::clone(name));
    Provenance {
        classes,
        tone: None,
        part: context.parts.get(chain.part.index()).and_then(name),
        material: context.materials.get(chain.material.index()).and_then(|(text, _)| name(text)),
        invisibility: chain.invisibility,
        note: None,
    }
}

/// One layer a pen (width and colour), in order of first use. The labels begin with a number, as
/// plotter programs want them to pick the pen.
fn by_pen(kind: LayerKind, marks: Vec<Mark>, unit: Unit) -> Vec<Layer> {
    let mut layers: Vec<Layer> = Vec::new();
    let mut pens: Vec<(f64, Colour)> = Vec::new();
    for mark in marks {
        let pen = match &mark.paint {
            Paint::Stroke(stroke) => (stroke.width, stroke.colour),
            Paint::Outline(outline) => (outline.pen_width, outline.colour),
            Paint::Fill(colour) => (0.0, *colour),
        };
        let index = pens.iter().position(|known| *known == pen).unwrap_or_else(|| {
            pens.push(pen);
            let colour = String::from(pen.1);
            let width = (pen.0 * 1000.0).round() / 1000.0;
            let label = format!("{} {width} {} {colour}", pens.len(), unit.name());
            layers.push(Layer { kind, pen: Some(label), marks: Vec::new() });
            pens.len() - 1
        });
        if let Some(layer) = layers.get_mut(index) {
            layer.marks.push(mark);
        }
    }
    layers
}

/// Whether every piece of a path is straight.
fn is_straight(path: &BezPath) -> bool {
    use kurbo::PathEl::{CurveTo, QuadTo};
    !path.elements().iter().any(|element| matches!(element, CurveTo(..) | QuadTo(..)))
}

#[cfg(test)]
mod tests;
