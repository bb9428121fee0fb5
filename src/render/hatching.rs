//! Hatching of a view: its ground, its tones, and the names that marks carry.

use std::sync::Arc;

use kurbo::Vec2;

use super::fills::Fills;
use crate::drawing::{Layer, Page};
use crate::hatch::{self, HatchContext, Tone};
use crate::math::colour::Colour;
use crate::mesh::PaintId;
use crate::region::{Ground, Seen};
use crate::scene::{Camera, Scene};
use crate::style::Style;

/// The layer `hatching`, if anything is hatched.
pub(super) fn hatch(
    fills: &Fills,
    seen: &Seen,
    scene: &Scene,
    page: &Page,
    camera: &Camera,
    style: &Style,
) -> Option<Layer> {
    let offset = Vec2::new(page.width - camera.width, page.height - camera.height) / 2.0;
    let ground = Ground::new(seen, style.hatch.crumb, page.unit, offset);
    let parts: Vec<Arc<str>> = scene.parts.iter().map(|part| Arc::from(part.name.as_str())).collect();
    let materials: Vec<(Arc<str>, Colour)> =
        scene.materials.iter().map(|material| (Arc::from(material.name.as_str()), material.colour)).collect();
    let tones = tones(fills, scene, style);
    let context = HatchContext {
        unit: page.unit,
        seed: style.seed,
        parts: &parts,
        materials: &materials,
        tones: &tones,
        light: None,
    };
    hatch::fill(&ground, &context, &style.hatch)
}

/// The tone of each paint.
fn tones(fills: &Fills, scene: &Scene, style: &Style) -> Vec<Tone> {
    let lit = fills.lit();
    let Some(bins) = lit.shading.bins() else { return Vec::new() };
    let paints = fills.paints();
    let of = |number: usize| {
        let name = paints
            .get(number)
            .and_then(|paint| scene.materials.get(paint.material.index()))
            .map_or("", |material| material.name.as_str());
        let own = style.hatch.materials.iter().rev().find(|(pattern, _)| pattern.matches(name));
        let table = own.map_or(&style.hatch.coverage, |(_, table)| table);
        Tone::new(lit.shading.levels(PaintId(number as u32), bins), table)
    };
    // The last one stands in for paints that are unknown.
    (0..=paints.len()).map(of).collect()
}
