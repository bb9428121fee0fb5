//! What a drawing with regions needs beside its lines: light, tone borders, paint.

use std::sync::Arc;

use glam::{DVec3, Vec3};
use kurbo::{BezPath, Vec2};

use crate::colour::srgb::Colour;
use crate::drawing::{Layer, Page, Provenance};
use crate::hatching::{Direction, HatchLayer, PatternFixed};
use crate::light::ambient_occlusion::openness;
use crate::light::tones::tone_options::Scale;
use crate::light::{ShadedNormals, Shading, ToneOptions};
use crate::lines::isophotes::isophote_lines;
use crate::lines::isophotes::tone_changes::{self, Darkens, ToneBorders};
use crate::lines::paint_borders::{paint_lines, tone_edges};
use crate::lines::{FeatureLines, LineKind, LineOptions, Lit, Source, Surface, Textures, in_sight};
use crate::mesh::{EdgeSet, FaceId, Mesh, PaintId, PartId};
use crate::pipeline::cache::shadow_cache::LateShadows;
use crate::pipeline::rest::chain_anchors::Anchors;
use crate::pipeline::rest::rest_pose::AtRest;
use crate::regions::paint::region_paint::PaintContext;
use crate::regions::{self, Darkened, Look, PageBorders, Region, RegionOptions, Regions, Seen, StepsAs};
use crate::scene::paints::triangle_paints::Paints;
use crate::scene::{Camera, Paint, Scene};
use crate::shadows::Shadows;
use crate::style::Style;
use crate::view::View;
use crate::visibility::ViewMap;

/// Whether a style asks for light on the surface: for colours, or for hatching.
pub(crate) fn is_lit(style: &Style) -> bool {
    style.region.enabled || style.hatch.enabled
}

/// Whether a style draws lines where tones change, whether it paints them or not.
pub(crate) fn asks_isophotes(style: &Style) -> bool {
    let lines = &style.lines;
    lines.enabled && lines.source != Source::Image && lines.kinds.contains(&LineKind::Isophote)
}

/// Whether a style asks what is painted on the surface: for that, for lines between painted colours, or between tones.
pub(crate) fn asks_surface(style: &Style) -> bool {
    is_lit(style) || asks_artist(style) || asks_isophotes(style)
}

/// Whether a style draws lines between painted colours.
pub(crate) fn asks_artist(style: &Style) -> bool {
    style.lines.enabled && style.lines.kinds.contains(&LineKind::Artist)
}

/// Whether a style lays strokes along cuts through the model.
pub(crate) fn lays_through(style: &Style) -> bool {
    let fixed = |layer: &HatchLayer| matches!(layer.direction, Direction::Object | Direction::Uv);
    let hatches = style.hatch.enabled && style.hatch.layers.iter().any(fixed);
    hatches || style.patterns.iter().any(|own| own.fixed == PatternFixed::Surface)
}

/// What shadows that things cast are to darken.
fn darkened(style: &Style) -> Darkened {
    Darkened {
        tones: has_tones(style) && style.tones.cast_shadows,
        bins: style.hatch.enabled && style.hatch.cast_shadows,
    }
}

/// Whether light falls into tones: where these are painted, or lines between them are drawn.
fn has_tones(style: &Style) -> bool {
    style.region.enabled || asks_isophotes(style)
}

/// The tones of a style; one for all where none are asked for.
fn tones(style: &Style) -> ToneOptions {
    let Darkened { tones, bins } = darkened(style);
    let cast_shadows = tones || bins;
    if has_tones(style) {
        return ToneOptions { cast_shadows, ..style.tones.clone() };
    }
    ToneOptions { scale: Scale::Thresholds(Vec::new()), cast_shadows, ..ToneOptions::default() }
}

/// Lines that part regions, whether they are drawn or not.
const PARTING: [LineKind; 4] =
    [LineKind::Contour, LineKind::Border, LineKind::Material, LineKind::Intersection];

/// The lines to be sought for a style: those it draws, and where it paints regions, those that may
/// part them.
pub(crate) fn sought(style: &Style) -> LineOptions {
    let mut options = style.lines.clone();
    if options.source == Source::Image {
        options.kinds.clear();
    }
    if !is_lit(style) {
        return options;
    }
    if !options.enabled {
        options.enabled = true;
        options.kinds = Vec::new();
    }
    // Strokes of a hatching end at creases too.
    let creases = style.hatch.enabled.then_some(LineKind::Crease);
    let missing =
        PARTING.into_iter().chain(creases).filter(|kind| !options.kinds.contains(kind)).collect::<Vec<_>>();
    options.kinds.extend(missing);
    options
}

/// The colours of paints without light: those of their materials, or what stands in for these in fills.
pub(crate) fn paint_colours(paints: &[Paint], scene: &Scene, style: &Style) -> Vec<Colour> {
    let instead = |paint: &Paint| {
        let material = scene.materials.get(paint.material.index()).filter(|_| style.region.enabled)?;
        style.tones.for_material(&material.name).1
    };
    paints.iter().map(|paint| instead(paint).unwrap_or(paint.colour)).collect()
}

/// Leaves only lines that are drawn; tone borders among the segments of `unchanged`, ascending, are not.
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

/// What regions need of a surface beside its lines; the same for all views.
#[derive(Debug)]
pub(crate) struct Paintable {
    normals: ShadedNormals,
    /// Edges across which it may look different.
    edges: EdgeSet,
    /// Parts whose inside nobody sees.
    solid: Vec<bool>,
}

impl Paintable {
    /// `solid` says which parts of the mesh nobody sees the inside of.
    pub fn new(surface: &Surface, paints: &Paints, solid: Vec<bool>) -> Self {
        let normals = ShadedNormals::new(&surface.mesh, &surface.hard, &surface.smooth);
        let edges = tone_edges::candidates(&surface.mesh, &normals, paints);
        Self { normals, edges, solid }
    }

    /// That of a surface some of whose faces are cut: its parts are as closed as they were.
    pub fn finer(&self, surface: &Surface, paints: &Paints) -> Self {
        Self::new(surface, paints, self.solid.clone())
    }
}

/// What is painted on a surface.
#[derive(Clone, Copy)]
pub(crate) struct Colours<'a> {
    pub paints: &'a Paints,
    pub textures: &'a Textures,
}

/// A lit surface on its way to regions.
pub(crate) struct Fills<'a> {
    surface: &'a Surface,
    /// What casts shadows.
    casting: &'a Mesh,
    paintable: &'a Paintable,
    view: &'a View,
    shading: Shading,
    shadows: Arc<Shadows>,
    openness: Vec<f64>,
    /// Every set of lights that may be in shadow together.
    masks: Vec<u32>,
    parts: Vec<Arc<str>>,
    materials: Vec<Arc<str>>,
    paints: &'a [Paint],
    textures: &'a Textures,
    darkened: Darkened,
    /// Where the mesh rests, if it does not stand so.
    rest: Option<AtRest<'a>>,
}

impl<'a> Fills<'a> {
    /// `casting` is the mesh that casts shadows: that of the surface, but that some faces may hide nothing. Where it is that of all
    /// views, `late` keeps its shadows.
    #[expect(clippy::too_many_arguments, reason = "it is called once, and each is another thing")]
    pub fn new(
        surface: &'a Surface,
        (casting, late): (&'a Mesh, Option<&LateShadows>),
        paintable: &'a Paintable,
        view: &'a View,
        scene: &Scene,
        Colours { paints, textures }: Colours<'a>,
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
        let nook = |at: DVec3| frame.side_at(frame.depth(at)) * NOOK_OF_FRAME;
        // Behind glass there is more in sight than what is in front.
        let asked = || if std::ptr::eq(casting, mesh) { in_sight(mesh, view) } else { Vec::new() };
        let openness = if dims { openness(mesh, &asked(), nook) } else { Vec::new() };
        Self {
            surface,
            casting,
            paintable,
            view,
            masks: masks(shading.casters().len() as u32),
            shading,
            shadows,
            openness,
            paints: &paints.list,
            textures,
            darkened: darkened(style),
            parts: scene.parts.iter().map(|part| Arc::from(part.name.as_str())).collect(),
            materials: scene.materials.iter().map(|material| Arc::from(material.name.as_str())).collect(),
            rest: None,
        }
    }

    /// With what is laid through the model laid through it as it rests.
    pub fn laid_at(self, anchors: &'a Anchors) -> Self {
        Self { rest: AtRest::new(anchors, &self.surface.mesh), ..self }
    }

    /// Where the corners of a face are at rest, world.
    pub fn resting_corners(&self, face: u32) -> [DVec3; 3] {
        let mesh = &self.surface.mesh;
        let rest = self.rest.as_ref().zip(mesh.triangles.get(face as usize));
        let rest = rest.and_then(|(rest, triangle)| rest.corners(*triangle));
        rest.unwrap_or_else(|| mesh.corners(FaceId(face)).map(|p| p + mesh.origin))
    }

    /// About where in its part a point of the surface (relative to the mesh's origin) is at rest, in shares of the part's size:
    /// `share` to a unit.
    pub fn rough_place(&self, part: PartId, at: DVec3, share: f64) -> DVec3 {
        let mesh = &self.surface.mesh;
        let world = at + mesh.origin;
        match self.rest.as_ref().and_then(|rest| rest.anchor(part, world)) {
            Some(anchor) => Vec3::from_array(anchor.place).as_dvec3() / share,
            None => world / (mesh.extents.of(part).scale * share),
        }
    }

    /// How many tones a paint has.
    pub fn tone_count(&self, paint: PaintId) -> u16 {
        self.shading.tone_count(paint)
    }

    /// The paints of the scene.
    pub fn paints(&self) -> &[Paint] {
        self.paints
    }

    /// Their colours without light.
    pub fn paint_colours(&self, scene: &Scene, style: &Style) -> Vec<Colour> {
        paint_colours(self.paints, scene, style)
    }

    /// Whether a face stands for a rounded surface.
    pub fn is_round(&self, face: u32) -> bool {
        self.surface.smooth.corners_of(face).is_some()
    }

    /// The surface under its light.
    pub fn lit(&self) -> Lit<'_> {
        // Where the near plane cuts a part open, its inside is seen.
        let is_cut = !self.view.clipped.is_empty() || self.view.points.iter().any(|p| p.z.is_nan());
        Lit {
            mesh: &self.surface.mesh,
            view: self.view,
            normals: &self.paintable.normals,
            shading: &self.shading,
            openness: &self.openness,
            textures: self.textures,
            solid: if is_cut { &[] } else { &self.paintable.solid },
        }
    }

    /// Adds where the tone may change to the lines whose visibility is decided. Where these are to be `inked`, returns the numbers of
    /// the segments at which it does not change, ascending.
    pub fn add_tone_borders(&self, lines: &mut FeatureLines, inked: bool) -> Vec<u32> {
        let lit = self.lit();
        let first = lines.segments.len();
        let seams = tone_edges::find(&lit, &self.paintable.edges, &self.masks, lines);
        // What one sees through casts no shadow, and hides nothing from the second look.
        let sees_through = !std::ptr::eq(self.casting, lit.mesh);
        let edges = first..lines.segments.len();
        let traced = isophote_lines::find(&lit, &self.masks, sees_through, lines);
        let isophotes = edges.end..lines.segments.len();
        paint_lines::find(&lit, seams, lines);
        let first = lines.segments.len();
        self.shadows.lines.append_to(lit.mesh, lines);
        if !inked {
            return Vec::new();
        }
        let casters = self.shadows.lines.segments.iter().map(|segment| segment.caster).collect();
        let shadows = first..lines.segments.len();
        let borders = ToneBorders { edges, isophotes, traced, shadows, casters };
        let Darkened { tones, bins } = self.darkened;
        tone_changes::unchanged(
            &lit,
            &borders,
            Darkens { tones, bins },
            |points| self.shadowed(points),
            lines,
        )
    }

    /// What the eye sees, cut by these borders.
    pub fn see(&self, borders: &PageBorders, page: &Page) -> Seen {
        self.see_lit(&self.lit(), borders, page)
    }

    /// What the eye sees with another mesh before it, which has the same faces but hides less.
    pub fn see_behind(&self, clear: &Mesh, map: &ViewMap, page: &Page) -> Seen {
        let borders = PageBorders::of(map, &self.view.frame);
        self.see_lit(&Lit { mesh: clear, ..self.lit() }, &borders, page)
    }

    fn see_lit(&self, lit: &Lit, borders: &PageBorders, page: &Page) -> Seen {
        let has_shadows = !self.shadows.casters().is_empty();
        let shadowed = has_shadows.then_some(|points: &[_]| self.shadowed(points));
        regions::see(lit, borders, shadowed, self.darkened, page.unit)
    }

    /// The outlines of regions that look as `pick` says, with their colours and where they are from.
    pub fn outlines(
        &self,
        seen: &Seen,
        page: &Page,
        camera: &Camera,
        style: &Style,
        pick: impl Fn(&Look) -> bool,
    ) -> Vec<(BezPath, Colour, Look, Provenance)> {
        // Each outline has one colour.
        let options = RegionOptions { steps_as: StepsAs::Bands, ..style.region.clone() };
        let regions = regions::gather(seen, &options, &style.chain, page.unit);
        let context = self.paint_context(page, camera);
        regions::paint::region_paint::outlines(&regions, context.offset, 0.0, |region| pick(&region.look))
            .into_iter()
            .map(|(path, Region { look, .. })| {
                let provenance = regions::paint::region_paint::provenance(look, &context);
                (path, self.shading.colour(look.paint, look.tone), look, provenance)
            })
            .collect()
    }

    /// Names, colours and the place on the page.
    pub fn paint_context(&self, page: &Page, camera: &Camera) -> PaintContext<'_> {
        PaintContext {
            unit: page.unit,
            offset: Vec2::new(page.width - camera.width, page.height - camera.height) / 2.0,
            parts: &self.parts,
            materials: &self.materials,
            shading: &self.shading,
        }
    }

    /// Which lights do not reach points of faces.
    fn shadowed(&self, points: &[(u32, DVec3)]) -> Vec<u32> {
        self.shadows.shadowed(self.casting, points)
    }

    /// Which lights do not reach each point, as hatching has it: none where it knows no cast shadows.
    pub fn shadowed_bins(&self, points: &[(u32, DVec3)]) -> Vec<u32> {
        if self.darkened.bins { self.shadowed(points) } else { vec![0; points.len()] }
    }

    /// The painted regions.
    pub fn paint(&self, seen: &Seen, page: &Page, camera: &Camera, style: &Style) -> (Vec<Layer>, Regions) {
        let regions = regions::gather(seen, &style.region, &style.chain, page.unit);
        (regions::paint(&regions, &self.paint_context(page, camera), &style.region), regions)
    }
}

/// Nooks are dark where they see no sky within this part of the frame's longer side, as it is at their depth.
const NOOK_OF_FRAME: f64 = 0.15;

/// With no more lights than this, tones are sought for every set of them that may be in shadow; with
/// more, for none, each, and all.
const FEW_LIGHTS: u32 = 3;

fn masks(lights: u32) -> Vec<u32> {
    let all = (1 << lights) - 1;
    if lights <= FEW_LIGHTS {
        return (0..=all).collect();
    }
    [0].into_iter().chain((0..lights).map(|k| 1 << k)).chain([all]).collect()
}
