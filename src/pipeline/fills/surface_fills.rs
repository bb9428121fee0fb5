//! Fills: light on the surface, tone borders and paint of a view.

use std::sync::Arc;

use glam::{DVec3, Vec3};
use kurbo::{BezPath, Vec2};

use super::surface_requirements::{darkened, tones};
use crate::colour::srgb::Colour;
use crate::drawing::{Layer, Page, Provenance};
use crate::light::ambient_visibility;
use crate::light::{Shading, ShadingNormals};
use crate::lines::isophotes::isophote_lines;
use crate::lines::isophotes::tone_changes::{self, ShadowEffects, ToneBorderRanges};
use crate::lines::paint_borders::{paint_lines, tone_edges};
use crate::lines::{FeatureLines, LineKind, Lit, Source, Surface, Textures, visible_faces_of};
use crate::mesh::bvh::ToneTree;
use crate::mesh::{EdgeSet, FaceId, Mesh, PaintId, PartId};
use crate::pipeline::cache::shadow_cache::ShadowCache;
use crate::pipeline::rest::chain_anchors::Anchors;
use crate::pipeline::rest::rest_pose::RestPose;
use crate::regions::paint::region_paint::PaintContext;
use crate::regions::{
    self, LabelledPage, PageBorders, Region, RegionOptions, Regions, ShadowDarkening, StepsAs, SurfaceLabel,
};
use crate::scene::Paints;
use crate::scene::{Camera, MaterialPaint, Scene};
use crate::shadows::Shadows;
use crate::style::Style;
use crate::view::View;
use crate::visibility::ViewMap;

/// The unlit colours of paints: those of their materials, or the fill colours that replace them.
pub(crate) fn paint_colours(paints: &[MaterialPaint], scene: &Scene, style: &Style) -> Vec<Colour> {
    let instead = |paint: &MaterialPaint| {
        let material = scene.materials.get(paint.material.index()).filter(|_| style.region.enabled)?;
        style.tones.for_material(&material.name).1
    };
    paints.iter().map(|paint| instead(paint).unwrap_or(paint.colour)).collect()
}

/// Removes lines that are not drawn. Tone borders among the segments of `unchanged` (ascending) are removed
/// too.
pub(crate) fn keep_inked(map: &mut ViewMap, style: &Style, unchanged: &[u32]) {
    let lines = &style.lines;
    let on_surface = lines.enabled && lines.source != Source::Image;
    let is_unchanged = |segment: u32| unchanged.binary_search(&segment).is_ok();
    map.edges.retain(|edge| {
        on_surface
            && lines.kinds.contains(&edge.kind)
            && !(edge.kind == LineKind::Isophote && is_unchanged(edge.segment))
    });
}

/// Data of a surface for painting that all views share.
#[derive(Debug)]
pub(crate) struct ToneInputs {
    normals: ShadingNormals,
    /// Edges where the tone may change.
    edges: EdgeSet,
    /// Whether each part is closed, so that its inside is invisible.
    solid: Vec<bool>,
}

impl ToneInputs {
    /// Collects the data. `solid` says whether each part of the mesh is closed.
    pub(crate) fn new(surface: &Surface, paints: &Paints, solid: Vec<bool>) -> Self {
        let normals = ShadingNormals::new(&surface.mesh, &surface.hard, &surface.smooth);
        let edges = tone_edges::candidates(&surface.mesh, &normals, paints);
        Self { normals, edges, solid }
    }

    /// The shading normals.
    pub(crate) fn normals(&self) -> &ShadingNormals {
        &self.normals
    }

    /// The data of a refined surface. Its parts are as closed as before.
    pub(crate) fn finer(&self, surface: &Surface, paints: &Paints) -> Self {
        Self::new(surface, paints, self.solid.clone())
    }
}

/// Paints and textures of a surface.
#[derive(Clone, Copy)]
pub(crate) struct SurfaceColours<'a> {
    pub paints: &'a Paints,
    pub textures: &'a Textures,
}

/// Lit surface of a view, ready to be divided into regions.
pub(crate) struct SurfaceFills<'a> {
    surface: &'a Surface,
    /// Mesh that casts shadows.
    casting: &'a Mesh,
    paintable: &'a ToneInputs,
    view: &'a View,
    shading: Shading,
    tone_tree: Option<&'a ToneTree>,
    shadows: Arc<Shadows>,
    ambient_visibility: Vec<f64>,
    /// Every set of lights that may be in shadow together, as bit masks.
    masks: Vec<u32>,
    parts: Vec<Arc<str>>,
    materials: Vec<Arc<str>>,
    paints: &'a [MaterialPaint],
    textures: &'a Textures,
    darkened: ShadowDarkening,
    /// Rest positions of the mesh, if it is posed.
    rest_pose: Option<RestPose<'a>>,
}

impl<'a> SurfaceFills<'a> {
    /// Lights the surface of a view.
    ///
    /// `casting` is the mesh that casts shadows: that of the surface, where some faces may hide nothing. If
    /// all views share it, `late` caches its shadows.
    #[expect(clippy::too_many_arguments, reason = "it is called once, and each is another thing")]
    pub(crate) fn new(
        surface: &'a Surface,
        (casting, late): (&'a Mesh, Option<&ShadowCache>),
        paintable: &'a ToneInputs,
        view: &'a View,
        scene: &Scene,
        SurfaceColours { paints, textures }: SurfaceColours<'a>,
        style: &Style,
        warnings: &mut Vec<String>,
    ) -> Self {
        let (mesh, frame) = (&surface.mesh, &view.frame);
        let mut shading =
            Shading::new(scene, &paints.list, mesh, frame, &style.light, &tones(style), warnings);
        if style.hatch.enabled {
            shading = shading.with_bins(scene, &paints.list, &style.shade);
        }
        let shadows = match late {
            Some(late) => late.of(casting, shading.casters()),
            None => Arc::new(Shadows::new(casting, shading.casters())),
        };
        let dims = style.light.occlusion > 0.0;
        let nook = |at: DVec3| frame.side_at(frame.depth(at)) * OCCLUSION_RADIUS_OF_FRAME;
        // Through glass more is visible than the front faces.
        let asked = || if std::ptr::eq(casting, mesh) { visible_faces_of(mesh, view) } else { Vec::new() };
        let openness = if dims { ambient_visibility(mesh, &asked(), nook) } else { Vec::new() };
        Self {
            surface,
            casting,
            paintable,
            tone_tree: None,
            view,
            masks: masks(shading.casters().len() as u32),
            shading,
            shadows,
            ambient_visibility: openness,
            paints: &paints.list,
            textures,
            darkened: darkened(style),
            parts: scene.parts.iter().map(|part| Arc::from(part.name.as_str())).collect(),
            materials: scene.materials.iter().map(|material| Arc::from(material.name.as_str())).collect(),
            rest_pose: None,
        }
    }

    /// Finds tone borders with a tree over the shading normals.
    pub(crate) fn with_tone_tree(self, tone_tree: Option<&'a ToneTree>) -> Self {
        Self { tone_tree, ..self }
    }

    /// Fixes patterns and strokes through the model to its rest pose.
    pub(crate) fn laid_at(self, anchors: &'a Anchors) -> Self {
        Self { rest_pose: RestPose::new(anchors, &self.surface.mesh), ..self }
    }

    /// The rest positions of a face's corners, world.
    pub(crate) fn rest_corners(&self, face: u32) -> [DVec3; 3] {
        let mesh = &self.surface.mesh;
        let rest = self.rest_pose.as_ref().zip(mesh.triangles.get(face as usize));
        let rest = rest.and_then(|(rest, triangle)| rest.corners(*triangle));
        rest.unwrap_or_else(|| mesh.corners(FaceId(face)).map(|p| p + mesh.origin))
    }

    /// Rough rest position of a surface point in its part, in units of `share` times the part's size. `at` is
    /// relative to the mesh's origin.
    pub(crate) fn rough_rest_position(&self, part: PartId, at: DVec3, share: f64) -> DVec3 {
        let mesh = &self.surface.mesh;
        let world = at + mesh.origin;
        match self.rest_pose.as_ref().and_then(|rest| rest.anchor(part, world)) {
            Some(anchor) => Vec3::from_array(anchor.rest_position).as_dvec3() / share,
            None => world / (mesh.extents.part(part).scale * share),
        }
    }

    /// Number of tones of a paint.
    pub(crate) fn tone_count(&self, paint: PaintId) -> u16 {
        self.shading.tone_count(paint)
    }

    /// The paints of the scene.
    pub(crate) fn paints(&self) -> &[MaterialPaint] {
        self.paints
    }

    /// Unlit colours of the paints.
    pub(crate) fn paint_colours(&self, scene: &Scene, style: &Style) -> Vec<Colour> {
        paint_colours(self.paints, scene, style)
    }

    /// Whether a face approximates a rounded surface.
    pub(crate) fn is_round(&self, face: u32) -> bool {
        self.surface.smooth.corners_of(face).is_some()
    }

    /// The surface with its light.
    pub(crate) fn lit(&self) -> Lit<'_> {
        // Where the near plane cuts a part open, its inside is visible.
        let is_cut = !self.view.clipped.is_empty() || self.view.points.iter().any(|p| p.z.is_nan());
        Lit {
            mesh: &self.surface.mesh,
            view: self.view,
            normals: &self.paintable.normals,
            shading: &self.shading,
            ambient_visibility: &self.ambient_visibility,
            textures: self.textures,
            solid: if is_cut { &[] } else { &self.paintable.solid },
        }
    }

    /// Adds the lines where the tone may change. If they are `inked`, returns the numbers of those where it
    /// does not change, ascending.
    pub(crate) fn add_tone_borders(&self, lines: &mut FeatureLines, inked: bool) -> Vec<u32> {
        let lit = self.lit();
        let first = lines.segments.len();
        let seams = tone_edges::find(&lit, &self.paintable.edges, &self.masks, lines);
        // Transparent faces cast no shadow and hide nothing behind them.
        let sees_through = !std::ptr::eq(self.casting, lit.mesh);
        let edges = first..lines.segments.len();
        let traced = isophote_lines::find(&lit, &self.masks, sees_through, self.tone_tree, lines);
        let isophotes = edges.end..lines.segments.len();
        paint_lines::find(&lit, seams, lines);
        let first = lines.segments.len();
        self.shadows.lines.append_to(lit.mesh, lines);
        if !inked {
            return Vec::new();
        }
        let casters = self.shadows.lines.segments.iter().map(|segment| segment.caster).collect();
        let shadows = first..lines.segments.len();
        let borders = ToneBorderRanges { edges, isophotes, traced, shadows, casters };
        let ShadowDarkening { tones, bins } = self.darkened;
        tone_changes::unchanged(
            &lit,
            &borders,
            ShadowEffects { tones, bins },
            |points| self.shadowed(points),
            lines,
        )
    }

    /// The visible surface, divided by the given borders.
    pub(crate) fn label_page(&self, borders: &PageBorders, page: &Page) -> LabelledPage {
        self.label_lit_page(&self.lit(), borders, page)
    }

    /// The visible surface with another mesh in front, which has the same faces but hides less.
    pub(crate) fn label_page_behind(&self, clear: &Mesh, map: &ViewMap, page: &Page) -> LabelledPage {
        let borders = PageBorders::of(map, &self.view.frame);
        self.label_lit_page(&Lit { mesh: clear, ..self.lit() }, &borders, page)
    }

    fn label_lit_page(&self, lit: &Lit, borders: &PageBorders, page: &Page) -> LabelledPage {
        let has_shadows = !self.shadows.casters().is_empty();
        let shadowed = has_shadows.then_some(|points: &[_]| self.shadowed(points));
        regions::label_page(lit, borders, shadowed, self.darkened, page.unit)
    }

    /// Outlines of the regions whose look `pick` accepts, with colour, look and provenance.
    pub(crate) fn outlines(
        &self,
        labelled_page: &LabelledPage,
        page: &Page,
        camera: &Camera,
        style: &Style,
        pick: impl Fn(&SurfaceLabel) -> bool,
    ) -> Vec<(BezPath, Colour, SurfaceLabel, Provenance)> {
        // Each outline has one colour.
        let options = RegionOptions { steps_as: StepsAs::Bands, ..style.region.clone() };
        let regions = regions::gather(labelled_page, &options, &style.chain, page.unit);
        let context = self.paint_context(page, camera);
        regions::paint::region_paint::outlines(&regions, context.offset, 0.0, |region| pick(&region.label))
            .into_iter()
            .map(|(path, Region { label: look, .. })| {
                let provenance = regions::paint::region_paint::provenance(look, &context);
                (path, self.shading.colour(look.paint, look.tone), look, provenance)
            })
            .collect()
    }

    /// Names, colours and position on the page.
    pub(crate) fn paint_context(&self, page: &Page, camera: &Camera) -> PaintContext<'_> {
        PaintContext {
            unit: page.unit,
            offset: Vec2::new(page.width - camera.width, page.height - camera.height) / 2.0,
            parts: &self.parts,
            materials: &self.materials,
            shading: &self.shading,
        }
    }

    /// Which lights do not reach points of faces, as bit masks.
    fn shadowed(&self, points: &[(u32, DVec3)]) -> Vec<u32> {
        self.shadows.shadowed(self.casting, points)
    }

    /// Which lights do not reach points, for hatching bins. None if the bins have no cast shadows.
    pub(crate) fn shadowed_bins(&self, points: &[(u32, DVec3)]) -> Vec<u32> {
        if self.darkened.bins { self.shadowed(points) } else { vec![0; points.len()] }
    }

    /// The painted layers and their regions.
    pub(crate) fn paint(
        &self,
        labelled_page: &LabelledPage,
        page: &Page,
        camera: &Camera,
        style: &Style,
    ) -> (Vec<Layer>, Regions) {
        let regions = regions::gather(labelled_page, &style.region, &style.chain, page.unit);
        (regions::paint(&regions, &self.paint_context(page, camera), &style.region), regions)
    }
}

/// Occlusion radius as a share of the frame's longer side at a point's depth.
const OCCLUSION_RADIUS_OF_FRAME: f64 = 0.15;

/// Greatest number of lights for which every shadow combination is searched. With more lights, only none,
/// each and all are searched.
const MAX_COMBINED_LIGHTS: u32 = 3;

fn masks(lights: u32) -> Vec<u32> {
    let all = (1 << lights) - 1;
    if lights <= MAX_COMBINED_LIGHTS {
        return (0..=all).collect();
    }
    [0].into_iter().chain((0..lights).map(|k| 1 << k)).chain([all]).collect()
}
