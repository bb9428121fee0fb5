//! Strokes of one layer as marks: one for each facet, pressure step and colour.

use std::collections::BTreeMap;

use crate::parallel::prelude::*;
use kurbo::{BezPath, Point, Rect};

use super::stroke_path::{self, HatchNib};
use crate::colour::srgb::Colour;
use crate::drawing::{Join, Length, Mark, OutlinePaint, Paint, StrokePaint};
use crate::geometry::numbers::noise::hash;
use crate::hatching::guides::stroke_layout::HatchStroke;
use crate::hatching::layer_shares::fullest;
use crate::hatching::options::{HatchLayer, HatchOptions};
use crate::hatching::{HatchContext, LayerStrokes, Tooth, colour, covered_at, provenance, speckle, tone};
use crate::regions::tolerances::{REGION_GRID_STEPS, REGION_SNAP_STEPS};
use crate::regions::{HatchRegions, SurfaceLabel};

/// The marks of a layer of lines: one for each facet, pressure step and colour.
pub(crate) fn lines(
    ground: &HatchRegions,
    context: &HatchContext,
    options: &HatchOptions,
    number: usize,
    layer: &HatchLayer,
    hatched: &LayerStrokes,
) -> Vec<Mark> {
    let mut sets: BTreeMap<(u32, usize, Colour), Vec<&HatchStroke>> = BTreeMap::new();
    for stroke in &hatched.strokes {
        let own = &ground.cells[stroke.cell as usize];
        let ink = colour(layer.colour, own.look, context);
        sets.entry((own.facet, stroke_path::degree(stroke.pressure), ink)).or_default().push(stroke);
    }
    let fullest: Vec<f64> = options.layers.iter().map(|layer| fullest(layer, context.unit)).collect();
    let px = Length::px(1.0).in_unit(context.unit);
    let [pitch, width] = [layer.pitch(), layer.width].map(|length| length.in_unit(context.unit));
    let sets: Vec<_> = sets.into_iter().collect();
    sets.par_iter()
        .map(|((_, degree, ink), strokes)| {
            let cell = strokes[0].cell;
            let label = ground.cells[cell as usize].look;
            let swollen = |cell: u32, p: Point| {
                let covered = covered_at(ground, context, layer, cell, p);
                tone::coverage_per_layer(covered, &fullest).get(number).copied().unwrap_or_default() * pitch
            };
            let pressure = if layer.pressure > 0.0 { stroke_path::pressure(*degree) } else { 1.0 };
            let nib = HatchNib { width: width * pressure, taper: layer.taper, px };
            let mut axis = BezPath::new();
            strokes.iter().for_each(|stroke| stroke_path::add_line(stroke, px, &mut axis));
            let mut colour = *ink;
            colour.a = (f64::from(colour.a) * layer.opacity * f64::midpoint(1.0, pressure)).round() as u8;
            let (path, paint) = if layer.swell || layer.taper > 0.0 {
                let mut path = BezPath::new();
                for stroke in strokes {
                    let own = |p: Point| swollen(stroke.cell, p);
                    let ends = [stroke.points.first(), stroke.points.last()];
                    let tapers = ends.map(|end| !end.is_some_and(|end| is_on_border(*end, context.frame)));
                    stroke_path::add_outline(stroke, &nib, tapers, layer.swell.then_some(&own), &mut path);
                }
                let mean = if layer.swell {
                    pitch / 2.0
                } else {
                    nib.width * stroke_path::mean_width(layer, context.unit)
                };
                (path, Paint::Outline(OutlinePaint { colour, axis, width: mean, pen_width: nib.width }))
            } else {
                let stroke = StrokePaint::solid(nib.width, colour, layer.cap, Join::Round);
                (axis, Paint::Stroke(stroke))
            };
            let drawn = Mark { path, paint, provenance: provenance(label, context) };
            std::iter::once(drawn)
                .chain(tooth(layer, context, number, strokes, nib.width, label))
                .collect::<Vec<_>>()
        })
        .flatten_iter()
        .collect()
}

/// Whether a point lies on the border of the frame, within the rounding of the grid that clips regions.
fn is_on_border(p: Point, frame: Option<Rect>) -> bool {
    frame.is_some_and(|frame| {
        let step = frame.width().max(frame.height()) / REGION_GRID_STEPS;
        let ways = [p.x - frame.x0, p.x - frame.x1, p.y - frame.y0, p.y - frame.y1];
        ways.iter().any(|way| way.abs() <= REGION_SNAP_STEPS * step)
    })
}

/// Specks of bare paper over some strokes, if the layer has grain.
fn tooth(
    layer: &HatchLayer,
    context: &HatchContext,
    number: usize,
    strokes: &[&HatchStroke],
    width: f64,
    look: SurfaceLabel,
) -> Option<Mark> {
    if layer.grain <= 0.0 {
        return None;
    }
    let px = Length::px(1.0).in_unit(context.unit);
    let lines: Vec<(BezPath, f64)> = strokes
        .iter()
        .map(|stroke| {
            let mut line = BezPath::new();
            stroke_path::add_line(stroke, px, &mut line);
            (line, width)
        })
        .collect();
    let seed = hash(context.seed, &[number as u64, TOOTH_SEED]);
    let path = speckle(&lines, &Tooth { amount: layer.grain / 2.0, seed, px });
    let paint = Paint::Fill(context.paper);
    (!path.elements().is_empty()).then(|| Mark { path, paint, provenance: provenance(look, context) })
}

/// Separates the random seed of paper tooth from those of strokes.
const TOOTH_SEED: u64 = 0x746f_6f74;
