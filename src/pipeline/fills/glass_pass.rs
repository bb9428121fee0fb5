//! Transparent materials: left out, or drawn over what is behind them.

use std::borrow::Cow;

use super::surface_fills::SurfaceFills;
use crate::chains::{self, Chain};
use crate::colour::srgb::Colour;
use crate::drawing::{Layer, LayerKind, Mark, Page, Paint, Unit};
use crate::lines::{FeatureLines, HiddenLines, LineOptions, Surface};
use crate::mesh::{MaterialId, Mesh};
use crate::regions::{self, PageBorders};
use crate::scene::textures::cutouts;
use crate::scene::textures::cutouts::CutScene;
use crate::scene::{Camera, GlassDraw, Scene, glass};
use crate::style::Style;
use crate::view::View;
use crate::visibility::{self, ViewMap};

/// A scene without the materials that a style leaves out.
pub(crate) fn without_absent_materials<'a>(scene: &'a Scene, style: &Style) -> Cow<'a, Scene> {
    let absent = style.glass.opacities(scene, GlassDraw::Absent);
    if absent.is_empty() {
        return Cow::Borrowed(scene);
    }
    Cow::Owned(glass::without_materials(scene, |material| absent.get(material).copied().flatten().is_some()))
}

/// A scene without the areas that textures cut out, by [`cutouts::cut`].
pub(crate) fn cut_textures<'a>(scene: &'a Scene, left: &Cow<'a, Scene>) -> CutScene<'a> {
    match left {
        Cow::Borrowed(_) => cutouts::cut_out(scene),
        Cow::Owned(left) => {
            let CutScene { scene, origins, warnings } = cutouts::cut_out(left);
            CutScene { scene: Cow::Owned(scene.into_owned()), origins, warnings }
        }
    }
}

/// Mesh with transparent faces.
pub(crate) struct GlassPanes {
    /// The mesh with transparent faces that hide nothing.
    clear: Mesh,
    /// Opacity of each transparent material; `None` for opaque ones.
    opacities: Vec<Option<f64>>,
}

/// Lines and surfaces visible through panes.
pub(crate) struct BehindGlass<'a> {
    panes: &'a GlassPanes,
    /// View map of the lines that are visible when panes hide nothing.
    map: ViewMap,
    /// Lines that are visible through panes only.
    veiled: ViewMap,
}

impl GlassPanes {
    /// The panes of a surface. `None` if it has none, or the style draws them as opaque.
    pub(crate) fn of(surface: &Surface, scene: &Scene, style: &Style) -> Option<Self> {
        let opacities = style.glass.opacities(scene, GlassDraw::Glass);
        let is_pane = |material: MaterialId| opacities.get(material.index()).copied().flatten().is_some();
        let mesh = &surface.mesh;
        if !mesh.face_material.iter().any(|material| is_pane(*material)) {
            return None;
        }
        let clear = mesh.with_transparent_faces(|face| is_pane(mesh.face_material[face.index()]));
        Some(Self { clear, opacities })
    }

    /// The mesh with panes that hide nothing.
    pub(crate) fn clear(&self) -> &Mesh {
        &self.clear
    }

    /// Decides what is visible through the panes.
    pub(crate) fn decide_behind(
        &self,
        mesh: &Mesh,
        view: &View,
        lines: &FeatureLines,
        options: &LineOptions,
    ) -> BehindGlass<'_> {
        let [map, veiled] = visibility::build_through(mesh, &self.clear, view, lines, options);
        BehindGlass { panes: self, map, veiled }
    }
}

impl BehindGlass<'_> {
    /// The mesh with panes that hide nothing.
    pub(crate) fn clear(&self) -> &Mesh {
        self.panes.clear()
    }

    /// The surfaces visible without panes.
    pub(crate) fn label_page(&self, fills: &SurfaceFills, page: &Page) -> regions::LabelledPage {
        fills.label_page_behind(&self.panes.clear, &self.map, page)
    }

    /// Paints the panes over the layers behind them. Each region has the colour of its tone and the opacity
    /// of its material.
    pub(crate) fn paint(
        &self,
        fills: &SurfaceFills,
        borders: &PageBorders,
        (page, camera, style): (&Page, &Camera, &Style),
        layers: &mut Vec<Layer>,
    ) {
        let opacity = |material: MaterialId| self.panes.opacities.get(material.index()).copied().flatten();
        let seen = fills.label_page(borders, page);
        let panes = fills.outlines(&seen, page, camera, style, |look| opacity(look.material).is_some());
        if layers.is_empty() {
            layers.push(Layer { kind: LayerKind::Fills, pen: None, ordered: false, marks: Vec::new() });
        }
        let Some(over) = layers.last_mut() else { return };
        over.marks.extend(panes.into_iter().map(|(path, colour, look, provenance)| {
            let opacity = opacity(look.material).unwrap_or(1.0);
            let colour = Colour { a: (255.0 * opacity).round() as u8, ..colour };
            Mark { path, paint: Paint::Fill(colour), provenance }
        }));
    }

    /// The chains that are visible through panes only. `prepare` changes their view map first.
    pub(crate) fn chains(
        &mut self,
        style: &Style,
        unit: Unit,
        prepare: impl FnOnce(&mut ViewMap),
    ) -> Vec<Chain> {
        prepare(&mut self.veiled);
        let mut chains = chains::link(&self.veiled, &style.chain, unit, HiddenLines::None);
        chains.iter_mut().for_each(|chain| chain.veiled = true);
        chains
    }
}
