//! Colours next to lines: of the surface that a line belongs to, and of spot blacks.
//!
//! They are sampled only where a pen takes the material's colour, or where lines between blacks are left
//! white.

use glam::DVec2;

use super::chain_samples::{
    ChainSampler, MIN_DEPTH_GAP_OF_FRAME, SAMPLE_STEP_PX, SIDE_OFFSET_PX, across, densify,
};
use crate::chains::Chain;
use crate::colour::srgb::Colour;
use crate::drawing::Length;
use crate::lines::FeatureLines;
use crate::mesh::FaceId;
use crate::pipeline::fills::surface_fills::{SurfaceColours, paint_colours};
use crate::regions::HatchRegions;
use crate::strokes::{Ink, Pen};
use crate::style::Style;
use crate::visibility::{FrontFace, front_faces};

/// Greatest distance between samples of blacks along a line, px.
const BLACK_STEP_PX: f64 = 1.0;

/// Greatest distance that blacks are followed to either side, px.
const MAX_BLACK_REACH_PX: f64 = 12.0;

/// Whether any line takes the colour of its material.
pub(crate) fn needs_material_colours(style: &Style) -> bool {
    let shades = |colour: Ink| matches!(colour, Ink::Shade(_));
    let options = &style.stroke;
    shades(options.pen.colour) || options.rules.iter().any(|rule| rule.pen.colour.is_some_and(shades))
}

/// Samples the colours and blacks next to the chains.
pub(crate) fn sample_colours(
    chains: &mut [Chain],
    sampler: &ChainSampler,
    lines: &FeatureLines,
    colours: Option<SurfaceColours>,
    blacks: Option<&HatchRegions>,
) {
    let px = Length::px(1.0).in_unit(sampler.unit);
    let colours = colours.filter(|_| needs_material_colours(sampler.style));
    let asks = colours.is_some();
    if asks || blacks.is_some() {
        let step = if blacks.is_some() { BLACK_STEP_PX } else { SAMPLE_STEP_PX };
        for chain in chains.iter_mut() {
            densify(chain, step * px, sampler.view.frame.perspective);
        }
    }
    if let Some(colours) = colours {
        sample_surface_colours(chains, sampler, lines, colours, px);
    }
    if let Some(blacks) = blacks {
        let most = widest(sampler) * sampler.style.hatch.parting;
        let rings = (most.min(MAX_BLACK_REACH_PX * px) / px).ceil().max(1.0) as u32 + 1;
        sample_blacks(chains, blacks, rings, px);
    }
}

/// The width of the widest pen.
fn widest(sampler: &ChainSampler) -> f64 {
    let options = &sampler.style.stroke;
    let width = |pen: &Pen| pen.width.in_unit(sampler.unit);
    let rules = options.rules.iter().filter_map(|rule| rule.pen.width);
    rules.map(|width| width.in_unit(sampler.unit)).fold(width(&options.pen), f64::max)
}

/// Samples how far blacks extend on both sides of visible chains, point by point.
fn sample_blacks(chains: &mut [Chain], blacks: &HatchRegions, rings: u32, px: f64) {
    use crate::parallel::prelude::*;
    let is_black = |p| {
        let cell = blacks.cells.get(blacks.cell_at(p) as usize);
        cell.is_some_and(|cell| cell.facet != 0 && cell.look.bin == 0)
    };
    chains.par_iter_mut().filter(|chain| chain.invisibility == 0).for_each(|chain| {
        for i in 0..chain.points.len() {
            let (p, across) = (chain.points[i], across(chain, i) * px);
            let both = |ring: &u32| {
                let away = across * f64::from(*ring);
                is_black(p + away) && is_black(p - away)
            };
            let reach = (1..=rings).take_while(both).count();
            chain.samples[i].backdrop.black = reach as f64 * px;
        }
    });
}

/// Samples the colour of the surface that each chain belongs to, point by point.
fn sample_surface_colours(
    chains: &mut [Chain],
    sampler: &ChainSampler,
    lines: &FeatureLines,
    painted: SurfaceColours,
    px: f64,
) {
    let mesh = &sampler.surface.mesh;
    let colours = paint_colours(&painted.paints.list, sampler.scene, sampler.style);
    let colour_of = |face: u32| colours.get(mesh.paint(FaceId(face)).index()).copied();
    let colour_at = |(front, p): (FrontFace, DVec2)| {
        let at = sampler.view.frame.local_from_image(p.extend(front.nearness));
        colours.get(painted.textures.paint(mesh, front.face, at).index()).copied()
    };
    let mut side_points: Vec<DVec2> = Vec::new();
    for chain in chains.iter().filter(|chain| chain.invisibility == 0) {
        for i in 0..chain.points.len() {
            let across = across(chain, i) * (SIDE_OFFSET_PX * px);
            for p in [chain.points[i] + across, chain.points[i] - across] {
                let p = p - sampler.margin;
                side_points.push(DVec2::new(p.x, p.y));
            }
        }
    }
    let fronts = front_faces(mesh, sampler.view, &side_points);
    let mut pairs = fronts.chunks_exact(2).zip(side_points.chunks_exact(2));
    for chain in chains.iter_mut() {
        // Hidden chains, and chains whose surface is not visible next to them, take the colour of an adjacent
        // face of their material.
        let hosts = lines.segments.get(chain.segment as usize).map_or([u32::MAX; 2], |s| s.hosts);
        let is_own = |face: &u32| mesh.face_material.get(*face as usize) == Some(&chain.material);
        let host_colour = hosts.into_iter().find(is_own).and_then(colour_of);
        for sample in &mut chain.samples {
            let front_pair = if chain.invisibility == 0 { pairs.next() } else { None };
            let side = |k: usize| front_pair.and_then(|(fronts, places)| Some((fronts[k]?, places[k])));
            let sides = [0, 1].map(|k| side(k).filter(|(front, _)| is_own(&front.face)));
            let nearer = nearer(sides, |(front, _)| {
                let depth = sampler.view.frame.depth_of(front.nearness);
                depth
                    / (sampler.view.frame.side_at(sampler.view.frame.focus) * MIN_DEPTH_GAP_OF_FRAME)
                        .max(f64::MIN_POSITIVE)
            });
            let faces = nearer.into_iter().flatten();
            let darkest = faces.filter_map(colour_at).min_by_key(|c| (weight(*c), *c));
            sample.backdrop.colour = darkest.or(host_colour);
        }
    }
}

/// The side that is clearly nearer, or both sides.
fn nearer<T: Copy>(sides: [Option<T>; 2], depth: impl Fn(T) -> f64) -> [Option<T>; 2] {
    let [Some(left), Some(right)] = sides else { return sides };
    let apart = depth(right) - depth(left);
    if apart > 1.0 {
        [Some(left), None]
    } else if apart < -1.0 {
        [None, Some(right)]
    } else {
        sides
    }
}

/// Luminance of a colour, scaled by 1000 (Rec. 601 weights).
fn weight(colour: Colour) -> u32 {
    299 * u32::from(colour.r) + 587 * u32::from(colour.g) + 114 * u32::from(colour.b)
}
