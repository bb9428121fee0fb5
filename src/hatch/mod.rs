//! Hatching: strokes, dots and blacks that shade surfaces by tone.
//!
//! Light falls into bins, each bin asks for a part of the paper to be covered, and layers of strokes, one
//! across the other, cover it. Strokes lie along guides, which have ranks, so that a darker tone keeps
//! the strokes of a lighter one; they are cut where they leave what they shade.
//!
//! Source: Lake, Marshall, Harris, Blackstein, Stylized rendering techniques for scalable real-time 3D
//! animation, 2000, section 3.3, with strokes in place of textures.

pub mod clip;
pub mod cuts;
mod disc;
mod domain;
pub mod dots;
pub mod flow;
pub mod grain;
pub mod guide;
pub mod lay;
pub mod mark;
pub mod options;
mod scan;
pub mod stipple;
pub mod streamlines;
pub mod tone;
mod voronoi;

use std::collections::BTreeMap;
use std::sync::Arc;

use kurbo::{BezPath, Point};
use rayon::prelude::*;
use rustc_hash::FxHashMap;

pub use dots::{CellDots, DotScreen, ToneBorders, dots};
pub use flow::Flow;
pub use grain::{Grain, Tooth, grain, speckle};
pub use guide::{Guide, Scope};
pub use lay::{Hand, HatchStroke};
pub use options::{Direction, HatchLayer, HatchOptions, Kind};
pub use stipple::{Stipple, stipple};
pub use tone::Tone;

use crate::drawing::Join;
use crate::drawing::{Layer, LayerKind, Length, Mark, OutlinePaint, Paint, Provenance, StrokePaint, Unit};
use crate::math::colour::Colour;
use crate::math::function::{pow, tan};
use crate::math::noise::hash;
use crate::region::{Ground, Look, Samples};
use crate::stroke::Ink;
use mark::Nib;
use streamlines::{Spacing, streamlines};

/// What hatching needs beside the ground.
#[derive(Clone, Copy)]
pub struct HatchContext<'a> {
    /// Unit of the page.
    pub unit: Unit,
    /// The hand: [`crate::Style::seed`].
    pub seed: u64,
    /// Names of the parts, by [`crate::mesh::PartId`].
    pub parts: &'a [Arc<str>],
    /// Names and base colours of the materials, by [`crate::mesh::MaterialId`].
    pub materials: &'a [(Arc<str>, Colour)],
    /// The tone of each paint, by [`crate::mesh::PaintId`].
    pub tones: &'a [Tone],
    /// The page asked at the points of a lattice, for layers that need it: see [`HatchLayer::samples`].
    pub samples: Option<&'a Samples>,
    /// For each layer that follows the surface or its light, the flow of its strokes.
    pub flows: &'a [Option<Flow<'a>>],
    /// For each layer that is fixed to the model, its guides.
    pub fixed: &'a [Option<Vec<Guide>>],
}

/// Strokes of one layer of hatching, as they lie on the page.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Hatched {
    /// The strokes, in the order of their guides.
    pub strokes: Vec<HatchStroke>,
}

/// How dense a layer is in each cell of a ground.
struct Shares {
    /// The part of the paper that the layer covers.
    covered: Vec<f64>,
    /// The same as a part of what it covers at most.
    density: Vec<f64>,
}

/// The strokes of each layer that is made of lines; none for the others.
#[must_use]
pub fn strokes(ground: &Ground, context: &HatchContext, options: &HatchOptions) -> Vec<Hatched> {
    let layers = options.layers.iter().enumerate();
    layers
        .map(|(number, layer)| {
            if layer.kind != Kind::Lines {
                return Hatched::default();
            }
            let shares = shares(ground, context, options, number);
            let hand = hand(layer, context, number);
            let guides = guides(ground, layer, number, context, &shares, hand.seed);
            let laid: Vec<Vec<HatchStroke>> = guides
                .par_iter()
                .with_min_len(4)
                .map(|guide| {
                    hand.lay(guide, ground, if layer.swell { &shares.covered } else { &shares.density })
                })
                .collect();
            Hatched { strokes: laid.into_iter().flatten().collect() }
        })
        .collect()
}

/// The layer `hatching` of a drawing; `None` if nothing is hatched. Spot blacks, given by their outlines and
/// what is seen there, come first, in the colour of the first layer.
#[must_use]
pub fn fill(
    ground: &Ground,
    context: &HatchContext,
    options: &HatchOptions,
    blacks: Vec<(BezPath, Look)>,
) -> Option<Layer> {
    let hatched = strokes(ground, context, options);
    let ink = options.layers.first().map_or(Ink::Fixed(Colour::BLACK), |layer| layer.colour);
    let black = |(path, look): (BezPath, Look)| {
        let paint = Paint::Fill(colour(ink, look, context));
        Mark { path, paint, provenance: provenance(look, context) }
    };
    let mut marks: Vec<Mark> = blacks.into_iter().map(black).collect();
    for (number, (layer, hatched)) in options.layers.iter().zip(&hatched).enumerate() {
        marks.extend(lines(ground, context, options, number, layer, hatched));
    }
    (!marks.is_empty()).then_some(Layer { kind: LayerKind::Hatching, pen: None, marks })
}

/// Guides in the direction of a layer.
fn guides(
    ground: &Ground,
    layer: &HatchLayer,
    number: usize,
    context: &HatchContext,
    shares: &Shares,
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
            let doublings = if layer.swell { 0 } else { DOUBLINGS };
            let px = Length::px(1.0).in_unit(context.unit);
            streamlines(ground, flow, wanted, &is_inked, &Spacing { pitch, doublings, px, seed })
        }
        None => guide::straight(ground, wanted, angle, turn, pitch, seed),
    };
    if layer.swell {
        // All lines are there; their width tells the tone.
        guides.iter_mut().for_each(|guide| guide.rank = 0.0);
    }
    guides
}

/// The lightest tones have curved strokes four times as far from each other as the darkest.
const DOUBLINGS: u32 = 2;

/// How a layer's strokes are laid.
fn hand(layer: &HatchLayer, context: &HatchContext, number: usize) -> Hand {
    let long = |length: Length| length.in_unit(context.unit);
    Hand {
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

/// The part of the paper that a layer covers where `density` of its strokes are drawn.
///
/// Strokes that stray from their lines fall on each other, the more the denser they are: what strokes laid
/// down by chance would cover is 1 - exp(-x) for x times the paper of ink (Poisson).
fn covers(layer: &HatchLayer, unit: Unit, density: f64) -> f64 {
    if layer.kind != Kind::Lines || layer.swell {
        return density * MOST_COVERED;
    }
    let [pitch, width, length, gap, bow] =
        [layer.pitch(), layer.width, layer.length, layer.gap, layer.bow].map(|length| length.in_unit(unit));
    let inked = if length > 0.0 { length / (length + gap) } else { 1.0 };
    let ink = density * width * mark::mean_width(layer, unit) / pitch * inked;
    let turn = length * tan(layer.turn.to_radians().min(1.0)) / 4.0;
    let astray = (STRAYS * (layer.stray + (turn + bow / 2.0) / pitch)).min(1.0) * density;
    (ink - astray * (ink - (1.0 - pow(std::f64::consts::E, -ink)))).min(MOST_COVERED)
}

/// Strokes that stray by all of their distance on average lie as by chance.
const STRAYS: f64 = 0.9;

/// The part of the paper that a layer covers at most.
fn fullest(layer: &HatchLayer, unit: Unit) -> f64 {
    covers(layer, unit, 1.0).max(f64::MIN_POSITIVE)
}

/// What all layers of a hatching cover together at most: tables that ask for more do not get it.
#[must_use]
pub fn most_covered(options: &HatchOptions, unit: Unit) -> f64 {
    1.0 - options.layers.iter().map(|layer| 1.0 - fullest(layer, unit)).product::<f64>()
}

/// The part of a layer's strokes that covers a part of the paper.
fn density(layer: &HatchLayer, unit: Unit, share: f64) -> f64 {
    if share <= 0.0 {
        return 0.0;
    }
    if share >= fullest(layer, unit) {
        return 1.0;
    }
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(low, high);
        if covers(layer, unit, middle) < share { low = middle } else { high = middle }
    }
    f64::midpoint(low, high)
}

/// Bisections that find a density.
const HALVINGS: usize = 30;

/// Screens leave at least this little of the paper, so that lines stay lines.
const MOST_COVERED: f64 = 0.98;

/// How dense a layer is in each cell.
fn shares(ground: &Ground, context: &HatchContext, options: &HatchOptions, number: usize) -> Shares {
    let fullest: Vec<f64> = options.layers.iter().map(|layer| fullest(layer, context.unit)).collect();
    let mut known: FxHashMap<u64, f64> = FxHashMap::default();
    let covered: Vec<f64> = ground
        .cells
        .iter()
        .map(|cell| {
            let black = usize::from(cell.look.bin) < options.blacks;
            if cell.facet == 0 || black {
                return 0.0;
            }
            let tone = context.tones.get(cell.look.paint.index()).or(context.tones.last());
            let coverage = tone.map_or(0.0, |tone| tone.of_bin(cell.look.bin));
            tone::shares(coverage, &fullest).get(number).copied().unwrap_or_default()
        })
        .collect();
    // Few cells differ.
    let mut of = |share: f64| {
        *known.entry(share.to_bits()).or_insert_with(|| density(&options.layers[number], context.unit, share))
    };
    let density = covered.iter().map(|share| of(*share)).collect();
    Shares { covered, density }
}

/// The marks of a layer of lines: one for each facet and degree of pressure.
fn lines(
    ground: &Ground,
    context: &HatchContext,
    options: &HatchOptions,
    number: usize,
    layer: &HatchLayer,
    hatched: &Hatched,
) -> Vec<Mark> {
    let mut sets: BTreeMap<(u32, usize), Vec<&HatchStroke>> = BTreeMap::new();
    for stroke in &hatched.strokes {
        let facet = ground.cells[stroke.cell as usize].facet;
        sets.entry((facet, mark::degree(stroke.pressure))).or_default().push(stroke);
    }
    let fullest: Vec<f64> = options.layers.iter().map(|layer| fullest(layer, context.unit)).collect();
    let px = Length::px(1.0).in_unit(context.unit);
    let [pitch, width] = [layer.pitch(), layer.width].map(|length| length.in_unit(context.unit));
    let sets: Vec<((u32, usize), Vec<&HatchStroke>)> = sets.into_iter().collect();
    sets.par_iter()
        .map(|((_, degree), strokes)| {
            let cell = strokes[0].cell;
            let look = ground.cells[cell as usize].look;
            let tone = context.tones.get(look.paint.index()).or(context.tones.last());
            let swollen = |cell: u32, p: Point| {
                let facet = ground.cells[cell as usize].facet;
                let light = context.samples.and_then(|samples| samples.light(facet, p));
                let of = |tone: &Tone| match light {
                    Some(light) => tone.of_light(light),
                    None => tone.of_bin(ground.cells[cell as usize].look.bin),
                };
                let covered = tone.map_or(0.0, of);
                tone::shares(covered, &fullest).get(number).copied().unwrap_or_default() * pitch
            };
            let pressure = if layer.pressure > 0.0 { mark::pressure(*degree) } else { 1.0 };
            let nib = Nib { width: width * pressure, taper: layer.taper, px };
            let mut axis = BezPath::new();
            strokes.iter().for_each(|stroke| mark::add_line(stroke, px, &mut axis));
            let mut colour = colour(layer.colour, look, context);
            colour.a = (f64::from(colour.a) * layer.opacity * f64::midpoint(1.0, pressure)).round() as u8;
            let (path, paint) = if layer.swell || layer.taper > 0.0 {
                let mut path = BezPath::new();
                for stroke in strokes {
                    let own = |p: Point| swollen(stroke.cell, p);
                    mark::add_outline(stroke, &nib, layer.swell.then_some(&own), &mut path);
                }
                let mean =
                    if layer.swell { pitch / 2.0 } else { nib.width * mark::mean_width(layer, context.unit) };
                (path, Paint::Outline(OutlinePaint { colour, axis, width: mean, pen_width: nib.width }))
            } else {
                let stroke = StrokePaint {
                    width: nib.width,
                    colour,
                    cap: layer.cap,
                    join: Join::Round,
                    dash: Vec::new(),
                    dash_offset: 0.0,
                };
                (axis, Paint::Stroke(stroke))
            };
            Mark { path, paint, provenance: provenance(look, context) }
        })
        .collect()
}

/// The colour of an ink on what looks so.
fn colour(ink: Ink, look: Look, context: &HatchContext) -> Colour {
    match ink {
        Ink::Fixed(colour) => colour,
        Ink::Shade(shade) => {
            let base = context.materials.get(look.material.index());
            base.map_or(Colour::BLACK, |(_, base)| base.darker(shade))
        }
    }
}

/// The class and names of a mark on what looks so.
fn provenance(look: Look, context: &HatchContext) -> Provenance {
    let name = |name: &Arc<str>| (!name.is_empty()).then(|| Arc::clone(name));
    Provenance {
        classes: vec!["hatch"],
        tone: None,
        part: context.parts.get(look.part.index()).and_then(name),
        material: context.materials.get(look.material.index()).and_then(|(text, _)| name(text)),
        invisibility: 0,
        note: None,
    }
}
