//! Hatching: lines, dots and solid blacks that shade surfaces by tone; also patterns and paper.
//!
//! Source: Lake, Marshall, Harris and Blackstein, Stylized rendering techniques for scalable real-time 3D
//! animation, 2000, section 3.3, with strokes in place of textures.
//!
//! 1. Each bin of light needs a share of the paper ([`tone`]), which crossing layers divide
//!    ([`layer_shares`]).
//! 2. A layer of lines lays strokes along ranked guides, so darker tones keep the strokes of lighter ones
//!    ([`guides`]). A layer of dots places half-tone or stipple dots ([`dots`](mod@dots)).
//! 3. Both are cut at the borders of the cells that they shade ([`clip`]), and become marks ([`lines`]).
//!
//! Files, in reading order: [`options`]; [`context`] names and colours; [`tone`]; [`layer_shares`];
//! [`guides`]; [`clip`]; [`lines`]; [`dots`](mod@dots); [`patterns`] over tones; [`paper`](mod@paper) sheet and grain.

pub(crate) mod clip;
mod context;
pub(crate) mod dots;
pub(crate) mod guides;
mod layer_shares;
pub(crate) mod lines;
pub(crate) mod options;
pub(crate) mod paper;
pub(crate) mod patterns;
mod tolerances;
pub(crate) mod tone;

use crate::parallel::prelude::*;
use kurbo::{BezPath, Point};

pub(crate) use clip::polygon_clip::WindingRule;
pub(crate) use context::HatchContext;
pub(crate) use dots::halftone::{CellDots, DotScreen, ToneBorders, dots};
pub(crate) use dots::stipple::{Stipple, stipple};
pub(crate) use guides::guide::Guide;
pub(crate) use guides::guide_directions::GuideDirections;
pub(crate) use guides::stroke_layout::{HatchStroke, StrokeLayout};
pub(crate) use layer_shares::max_coverage;
pub(crate) use options::{Direction, HatchKind, HatchLayer, HatchOptions};
pub(crate) use paper::grain::{Tooth, speckle};
pub(crate) use paper::sheet::{Paper, paper, tooth};
pub(crate) use patterns::pattern_marks::{SurfacePattern, pattern};
pub(crate) use patterns::pattern_options::{Pattern, PatternFixed, PatternKind};
pub(crate) use patterns::tile::Tile;
pub(crate) use tone::ToneCoverage;

use crate::colour::srgb::Colour;
use crate::drawing::{Layer, LayerKind, Length, Mark, Paint, Provenance};
use crate::geometry::names::name_ids::stable_ids;
use crate::geometry::numbers::noise::hash;
use crate::regions::{HatchRegions, SurfaceLabel};
use crate::strokes::Ink;
use guides::streamlines::{Spacing, streamlines};
use layer_shares::{LayerShares, coverage_and_density};

/// Strokes of one layer of hatching on the page.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct LayerStrokes {
    /// The strokes, in the order of their guides.
    pub strokes: Vec<HatchStroke>,
}

/// The strokes of each layer of lines. Layers of dots have none.
#[must_use]
pub(crate) fn strokes(
    ground: &HatchRegions,
    context: &HatchContext,
    options: &HatchOptions,
) -> Vec<LayerStrokes> {
    let layers = options.layers.iter().enumerate();
    layers
        .map(|(number, layer)| {
            if layer.kind != HatchKind::Lines {
                return LayerStrokes::default();
            }
            let shares = coverage_and_density(ground, context, options, number);
            let hand = hand(layer, context, number);
            let guides = guides(ground, layer, number, context, &shares, hand.seed);
            let laid: Vec<Vec<HatchStroke>> = guides
                .par_iter()
                .with_min_len(4)
                .map(|guide| {
                    hand.lay(guide, ground, if layer.swell { &shares.covered } else { &shares.density })
                })
                .collect();
            LayerStrokes { strokes: laid.into_iter().flatten().collect() }
        })
        .collect()
}

/// The layer `hatching` of a drawing, or `None` if nothing is hatched.
///
/// Spot blacks come first, in the colour of the first layer. They are given by their outlines and the look of
/// their regions.
#[must_use]
pub(crate) fn fill(
    ground: &HatchRegions,
    context: &HatchContext,
    options: &HatchOptions,
    blacks: Vec<(BezPath, SurfaceLabel)>,
) -> Option<Layer> {
    let hatched = strokes(ground, context, options);
    let ink = options.layers.first().map_or(Ink::Fixed(Colour::BLACK), |layer| layer.colour);
    let black = |(path, look): (BezPath, SurfaceLabel)| {
        let paint = Paint::Fill(colour(ink, look, context));
        Mark { path, paint, provenance: provenance(look, context) }
    };
    let mut marks: Vec<Mark> = blacks.into_iter().map(black).collect();
    for (number, (layer, hatched)) in options.layers.iter().zip(&hatched).enumerate() {
        match layer.kind {
            HatchKind::Lines => {
                marks.extend(lines::line_layer::lines(ground, context, options, number, layer, hatched))
            }
            HatchKind::Dots | HatchKind::Stipple => {
                marks.extend(spots(ground, context, options, number, layer))
            }
        }
    }
    (!marks.is_empty()).then_some(Layer { kind: LayerKind::Hatching, pen: None, ordered: false, marks })
}

/// Share of the paper that a layer covers at a point of a cell. It follows the light there if the layer is
/// graded, else the bin.
fn covered_at(ground: &HatchRegions, context: &HatchContext, layer: &HatchLayer, cell: u32, p: Point) -> f64 {
    let own = &ground.cells[cell as usize];
    let Some(tone) = context.tones.get(own.look.paint.index()).or(context.tones.last()) else { return 0.0 };
    let samples = context.samples.filter(|_| layer.graded);
    match samples.and_then(|samples| samples.light(own.facet, p)) {
        Some(light) => tone.of_light(light),
        None => tone.of_bin(own.look.bin),
    }
}

/// The marks of a layer of dots, one for each cell.
fn spots(
    ground: &HatchRegions,
    context: &HatchContext,
    options: &HatchOptions,
    number: usize,
    layer: &HatchLayer,
) -> Vec<Mark> {
    let long = |length: Length| length.in_unit(context.unit);
    let fullest: Vec<f64> =
        options.layers.iter().map(|layer| layer_shares::fullest(layer, context.unit)).collect();
    let inked = coverage_and_density(ground, context, options, number);
    let coverage = |cell: u32, p: Point| {
        if inked.covered[cell as usize] <= 0.0 {
            return 0.0;
        }
        let covered = covered_at(ground, context, layer, cell, p);
        tone::coverage_per_layer(covered, &fullest).get(number).copied().unwrap_or_default()
    };
    let px = long(Length::px(1.0));
    let seed = hash(context.seed, &[number as u64]);
    let cells = if layer.kind == HatchKind::Dots {
        let tone_borders = if layer.graded { ToneBorders::Whole } else { ToneBorders::Cut };
        // The page's y points down, so the angle changes its sign.
        let angle = -layer.angle.to_radians();
        let screen = DotScreen { pitch: long(layer.pitch()), angle, origin: Point::ZERO, tone_borders, px };
        dots(ground, &screen, &coverage)
    } else {
        let (radius, uneven) = (long(layer.width) / 2.0, layer.uneven);
        stipple(ground, &Stipple { radius, uneven, rounds: STIPPLE_ROUNDS, seed, px }, &coverage)
    };
    let mark = |dots: CellDots| {
        let look = ground.cells[dots.cell as usize].look;
        let mut colour = colour(layer.colour, look, context);
        colour.a = (f64::from(colour.a) * layer.opacity).round() as u8;
        Mark { path: dots.path, paint: Paint::Fill(colour), provenance: provenance(look, context) }
    };
    cells.into_iter().map(mark).collect()
}

/// Relaxation rounds of stippling. Fewer leave it uneven; many more produce a visible lattice.
const STIPPLE_ROUNDS: u32 = 8;

/// Guides in the direction of a layer.
fn guides(
    ground: &HatchRegions,
    layer: &HatchLayer,
    number: usize,
    context: &HatchContext,
    shares: &LayerShares,
    seed: u64,
) -> Vec<Guide> {
    let wanted = |cell: u32| shares.covered[cell as usize] > 0.0;
    let pitch = layer.pitch().in_unit(context.unit);
    let [angle, turn] = [layer.angle, layer.turn_parts].map(f64::to_radians);
    if let Some(fixed) = context.fixed.get(number).and_then(Option::as_ref) {
        return fixed.clone();
    }
    let mut guides = match context.flows.get(number).and_then(Option::as_ref) {
        Some(flow) => {
            let samples = flow.samples();
            let is_inked = |facet: u32, p: Point| {
                samples
                    .around(p)
                    .iter()
                    .any(|(k, _)| samples.facets[*k] == facet && wanted(samples.cells[*k]))
            };
            let doublings = if layer.swell { 0 } else { SPACING_DOUBLINGS };
            let px = Length::px(1.0).in_unit(context.unit);
            streamlines(ground, flow, wanted, &is_inked, &Spacing { pitch, doublings, px, seed })
        }
        None => {
            let names = stable_ids(context.parts.iter().map(|name| &**name));
            guides::guide::straight(ground, wanted, &names, angle, turn, pitch, seed)
        }
    };
    if layer.swell {
        // All lines are drawn; their width carries the tone.
        guides.iter_mut().for_each(|guide| guide.rank = 0.0);
    }
    guides
}

/// Doublings of the spacing. The lightest tones have curved strokes four times as far apart as the darkest.
const SPACING_DOUBLINGS: u32 = 2;

/// Stroke parameters of a layer in page units.
fn hand(layer: &HatchLayer, context: &HatchContext, number: usize) -> StrokeLayout {
    let long = |length: Length| length.in_unit(context.unit);
    StrokeLayout {
        length: long(layer.length),
        gap: long(layer.gap),
        uneven: layer.uneven,
        stray: layer.stray * long(layer.pitch()),
        turn: layer.turn.to_radians(),
        bow: long(layer.bow),
        tremor: long(layer.tremor),
        pressure: layer.pressure,
        overrun: long(layer.overrun),
        short: long(layer.short),
        ragged: long(layer.ragged),
        least: long(layer.least),
        px: long(Length::px(1.0)),
        seed: hash(context.seed, &[number as u64]),
    }
}

/// The colour of an ink on a surface with a given look.
fn colour(ink: Ink, look: SurfaceLabel, context: &HatchContext) -> Colour {
    match ink {
        Ink::Fixed(colour) => colour,
        Ink::Shade(shade) => {
            let material = context.materials.get(look.material.index()).map(|(_, base)| *base);
            let base = context.paints.get(look.paint.index()).copied().or(material);
            base.map_or(Colour::BLACK, |base| base.darker(shade))
        }
    }
}

/// Classes and names of a mark on a surface with a given look.
fn provenance(look: SurfaceLabel, context: &HatchContext) -> Provenance {
    let material = context.materials.get(look.material.index()).map(|(name, _)| name);
    let names = Provenance::of_names(context.parts.get(look.part.index()), material);
    Provenance { classes: vec!["hatch"], ..names }
}
