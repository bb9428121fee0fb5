//! What a drawing with regions needs beside its lines: light, tone borders, paint.

use std::sync::Arc;

use glam::DVec3;
use kurbo::Vec2;

use crate::drawing::{Layer, Page};
use crate::field::{ShadedNormals, Shading};
use crate::lines::{FeatureLines, LineKind, LineOptions, Lit, Surface, isophotes, tone_edges};
use crate::region::{self, Regions, paint::PaintContext};
use crate::scene::{Camera, Scene};
use crate::style::Style;
use crate::view::View;
use crate::viewmap::ViewMap;

/// Lines that part regions, whether they are drawn or not.
const PARTING: [LineKind; 4] =
    [LineKind::Contour, LineKind::Border, LineKind::Material, LineKind::Intersection];

/// The lines to be sought for a style: those it draws, and where it paints regions, those that may
/// part them.
pub(super) fn sought(style: &Style) -> LineOptions {
    let mut options = style.lines.clone();
    if !style.region.enabled {
        return options;
    }
    if !options.enabled {
        options.enabled = true;
        options.kinds = Vec::new();
    }
    let missing =
        PARTING.into_iter().filter(|kind| !style.lines.kinds.contains(kind) || !style.lines.enabled);
    options.kinds.extend(missing);
    options
}

/// Leaves only lines that are drawn.
pub(super) fn keep_inked(map: &mut ViewMap, style: &Style) {
    map.edges.retain(|edge| style.lines.enabled && style.lines.kinds.contains(&edge.kind));
}

/// A lit surface on its way to regions.
pub(super) struct Fills<'a> {
    surface: &'a Surface,
    view: &'a View,
    normals: ShadedNormals,
    shading: Shading,
    parts: Vec<Arc<str>>,
    materials: Vec<Arc<str>>,
}

impl<'a> Fills<'a> {
    pub fn new(surface: &'a Surface, view: &'a View, scene: &Scene, _style: &Style) -> Self {
        let frame = &view.frame;
        let towards = frame.right * -0.4 + frame.up * 0.6 - frame.forward * 0.7;
        Self {
            surface,
            view,
            normals: ShadedNormals::new(&surface.mesh, &surface.hard, &surface.smooth),
            shading: Shading::from_direction(towards, vec![0.5]),
            parts: scene.parts.iter().map(|part| Arc::from(part.name.as_str())).collect(),
            materials: scene.materials.iter().map(|material| Arc::from(material.name.as_str())).collect(),
        }
    }

    fn lit(&self) -> Lit<'_> {
        Lit {
            mesh: &self.surface.mesh,
            view: self.view,
            normals: &self.normals,
            shading: &self.shading,
            openness: &[],
        }
    }

    /// Adds where the tone changes to the lines whose visibility is decided.
    pub fn add_tone_borders(&self, lines: &mut FeatureLines) {
        let lit = self.lit();
        tone_edges::find(&lit, &[0], lines);
        isophotes::find(&lit, &[0], lines);
    }

    /// The painted regions.
    pub fn paint(&self, map: &ViewMap, page: &Page, camera: &Camera, style: &Style) -> (Vec<Layer>, Regions) {
        let shadowed = |points: &[(u32, DVec3)]| vec![0; points.len()];
        let regions = region::gather(&self.lit(), map, shadowed, &style.region, &style.chain, page.unit);
        let context = PaintContext {
            unit: page.unit,
            offset: Vec2::new(page.width - camera.width, page.height - camera.height) / 2.0,
            parts: &self.parts,
            materials: &self.materials,
            shading: &self.shading,
        };
        (region::paint(&regions, &context, &style.region), regions)
    }
}
