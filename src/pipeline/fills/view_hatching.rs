//! Hatching of a view: ground, tones, and names for marks.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use kurbo::{BezPath, Point, Rect, Size, Vec2};

use super::surface_fills::SurfaceFills;
use crate::colour::srgb::Colour;
use crate::drawing::{Layer, Length, Page, Unit};
use crate::geometry::names::name_ids::stable_ids;
use crate::geometry::numbers::noise::hash;
use crate::geometry::numbers::portable_math::{cos, sin};
use crate::geometry::numbers::powers_of_two::power_of_two_below;
use crate::hatching::guides::guide::rank;
use crate::hatching::guides::section_guides;
use crate::hatching::{
    self, Direction, Guide, GuideDirections, HatchContext, HatchLayer, LayerStrokes, ToneCoverage,
};
use crate::mesh::{FaceId, Mesh, PaintId, PartId};
use crate::regions::sampling::direction_field::DirectionSource;
use crate::regions::surface_curves::level_curves::{are_visible, level_curves};
use crate::regions::{self, HatchRegions, LabelledPage, LightLattice, RegionOptions, SurfaceLabel};
use crate::scene::{Camera, Scene, UpAxis};
use crate::style::Style;

/// Lit view, ready to be hatched.
pub(crate) struct Hatching<'a> {
    pub fills: &'a SurfaceFills<'a>,
    pub scene: &'a Scene,
    pub page: &'a Page,
    pub camera: &'a Camera,
    pub style: &'a Style,
}

impl Hatching<'_> {
    /// The layer `hatching`, if anything is hatched.
    pub(crate) fn layer(&self, labelled_page: &LabelledPage) -> Option<Layer> {
        let ground = self.ground(labelled_page);
        let blacks = if self.style.hatch.blacks > 0 { self.blacks(labelled_page) } else { Vec::new() };
        self.with_context(&ground, |context| hatching::fill(&ground, context, &self.style.hatch, blacks))
    }

    /// The ground, and the strokes of each layer on it.
    pub(crate) fn strokes(&self, labelled_page: &LabelledPage) -> (HatchRegions, Vec<LayerStrokes>) {
        let ground = self.ground(labelled_page);
        let strokes =
            self.with_context(&ground, |context| hatching::strokes(&ground, context, &self.style.hatch));
        (ground, strokes)
    }

    /// Offset of the camera's frame on the page.
    fn offset(&self) -> Vec2 {
        Vec2::new(self.page.width - self.camera.width, self.page.height - self.camera.height) / 2.0
    }

    fn ground(&self, labelled_page: &LabelledPage) -> HatchRegions {
        HatchRegions::new(labelled_page, self.style.hatch.crumb, self.page.unit, self.offset())
    }

    /// Calls `call` with the context of hatching.
    fn with_context<T>(&self, ground: &HatchRegions, call: impl FnOnce(&HatchContext) -> T) -> T {
        let Self { fills, scene, page, style, .. } = self;
        let offset = self.offset();
        let parts: Vec<Arc<str>> = scene.parts.iter().map(|part| Arc::from(part.name.as_str())).collect();
        let materials: Vec<(Arc<str>, Colour)> = scene
            .materials
            .iter()
            .map(|material| (Arc::from(material.name.as_str()), material.colour))
            .collect();
        let tones = tones(fills, scene, style);
        let sampled = style.hatch.layers.iter().any(HatchLayer::samples);
        let lit = fills.lit();
        let px = Length::px(1.0).in_unit(page.unit);
        let shadowed = |points: &[(u32, DVec3)]| fills.shadowed_bins(points);
        let samples = sampled.then(|| {
            LightLattice::new(
                &lit,
                ground,
                shadowed,
                |face| fills.is_round(face),
                offset,
                LATTICE_STEP_PX * px,
            )
        });
        let flow = |layer: &HatchLayer| {
            let (samples, probe) = samples.as_ref()?;
            let angle = layer.angle.to_radians();
            let asked = match layer.direction {
                Direction::Surface => DirectionSource::Curvature(angle),
                Direction::Light => DirectionSource::LightGradient(angle),
                Direction::Page | Direction::Uv | Direction::Object => return None,
            };
            Some(GuideDirections::new(samples, &samples.axes(probe, asked)))
        };
        let flows: Vec<Option<GuideDirections>> = style.hatch.layers.iter().map(flow).collect();
        let fixed: Vec<Option<Vec<Guide>>> = style
            .hatch
            .layers
            .iter()
            .enumerate()
            .map(|(number, layer)| {
                fixed(fills, ground, scene, page, offset, layer, hash(style.seed, &[number as u64]))
            })
            .collect();
        let size = Size::new(self.camera.width, self.camera.height);
        let frame = Rect::from_origin_size(offset.to_point(), size);
        let context = HatchContext {
            unit: page.unit,
            seed: style.seed,
            parts: &parts,
            materials: &materials,
            paints: &fills.paint_colours(scene, style),
            tones: &tones,
            samples: samples.as_ref().map(|(samples, _)| samples),
            paper: style.background.unwrap_or(Colour::WHITE),
            flows: &flows,
            fixed: &fixed,
            frame: Some(frame),
        };
        call(&context)
    }

    /// Whether a look is a spot black.
    fn is_spot_black(&self, look: &SurfaceLabel) -> bool {
        self.style.hatch.enabled && usize::from(look.bin) < self.style.hatch.blacks
    }

    /// Whether ink on a look would be invisible.
    fn is_black(&self, look: &SurfaceLabel) -> bool {
        let painted = || {
            let colour = self.fills.lit().shading.colour(look.paint, look.tone);
            self.style.region.enabled
                && [colour.r, colour.g, colour.b].into_iter().all(|c| c <= MAX_BLACK_CHANNEL)
        };
        self.is_spot_black(look) || painted()
    }

    /// The ground, divided into black and other cells. `None` if nothing is black or blacks are not
    /// separated.
    pub(crate) fn black_ground(&self, labelled_page: &LabelledPage) -> Option<HatchRegions> {
        let hatch = &self.style.hatch;
        let coarser = |look: &SurfaceLabel| black_or_not(look, self.is_black(look));
        (hatch.parting > 0.0 && labelled_page.shows(|look| self.is_black(look)))
            .then(|| HatchRegions::coarse(labelled_page, coarser, hatch.crumb, self.page.unit, self.offset()))
    }

    /// The outlines of spot blacks, and their looks.
    fn blacks(&self, labelled_page: &LabelledPage) -> Vec<(BezPath, SurfaceLabel)> {
        let style = self.style;
        let coarser = |look: &SurfaceLabel| black_or_not(look, self.is_spot_black(look));
        let options = RegionOptions { crumb: style.hatch.crumb, ..style.region.clone() };
        let regions =
            regions::gather_relabelled(labelled_page, coarser, &options, &style.chain, self.page.unit);
        let reach = style.region.underlap.in_unit(self.page.unit);
        let black = regions::paint::region_paint::outlines(&regions, self.offset(), reach, |region| {
            region.label.bin == 0
        });
        black.into_iter().map(|(path, region)| (path, region.label)).collect()
    }
}

/// Greatest channel value of a black paint.
const MAX_BLACK_CHANNEL: u8 = 0x20;

/// A look reduced to black or not black.
fn black_or_not(look: &SurfaceLabel, is_black: bool) -> SurfaceLabel {
    SurfaceLabel { tone: 0, cast: false, bin: u16::from(!is_black), ..*look }
}

/// A warning if a coverage table wants more ink than the layers can give.
pub(crate) fn too_dark(style: &Style, unit: Unit) -> Option<String> {
    let asked = style.hatch.coverage.iter().skip(style.hatch.blacks).copied().fold(0.0, f64::max);
    let most = hatching::max_coverage(&style.hatch, unit);
    (style.hatch.enabled && asked > most + COVERAGE_TOLERANCE).then(|| {
        let percent = |share: f64| (share * 100.0).round();
        format!(
            "hatching.coverage is {} % of ink, but its layers cover {} % at most; make strokes wider or add a layer",
            percent(asked),
            percent(most),
        )
    })
}

/// Greatest excess of coverage that gives no warning.
const COVERAGE_TOLERANCE: f64 = 0.02;

/// Guides of a layer that is fixed to the model; `None` for other directions.
fn fixed(
    fills: &SurfaceFills,
    ground: &HatchRegions,
    scene: &Scene,
    page: &Page,
    offset: Vec2,
    layer: &HatchLayer,
    seed: u64,
) -> Option<Vec<Guide>> {
    let pitch = layer.pitch().in_unit(page.unit);
    let lit = &fills.lit();
    let mesh = lit.mesh;
    let frame = &lit.view.frame;
    // The pitch in the model at the camera's target, rounded down to a power of two, so that small camera
    // moves change nothing. Finer sets fill surfaces seen at a slant.
    let in_model = pitch / frame.scale * if frame.perspective { frame.focus } else { 1.0 };
    let spacing = power_of_two_below(in_model) / CUTS_PER_PITCH;
    let angle = layer.angle.to_radians();
    let (sine, cosine) = (sin(angle), cos(angle));
    let across = cut_of(scene, angle);
    let cut = |face: u32| Some(fills.rest_corners(face).map(|p| p.dot(across) / spacing));
    let texels = if layer.direction == Direction::Uv { texture_scales(mesh) } else { Vec::new() };
    let woven = |face: u32| {
        let corners = mesh.corner_uvs.get(face as usize)?;
        let texels = texels.get(mesh.face_part[face as usize].index())?;
        let value = |uv: u32| {
            let [u, v] = mesh.uvs.get(uv as usize)?.map(f64::from);
            Some((u * cosine + v * sine) * texels / spacing)
        };
        let [a, b, c] = corners.map(value);
        Some([a?, b?, c?])
    };
    let is_wanted = |level: i64, density: f64| rank(level) * density * pitch < 1.0;
    let curves = match layer.direction {
        Direction::Object => level_curves(lit, offset, cut, is_wanted),
        // Without texture coordinates, planes are used.
        Direction::Uv => level_curves(lit, offset, |face| woven(face).or_else(|| cut(face)), is_wanted),
        Direction::Page | Direction::Surface | Direction::Light => return None,
    };
    let seen = |points: &[(Point, f64)]| are_visible(lit, offset, points);
    let names = stable_ids(scene.parts.iter().map(|part| part.name.as_str()));
    let name = |part: PartId, at: DVec3| {
        let [x, y, z] = fills
            .rough_rest_position(part, at, IDENTITY_CELL_OF_PART)
            .round()
            .to_array()
            .map(|x| (x as i64).cast_unsigned());
        hash(names.get(part.index()).copied().unwrap_or_default(), &[x, y, z])
    };
    Some(section_guides::guides_along_curves(ground, &curves, seen, name, pitch, seed))
}

/// The normal of the planes that cut a model: upwards at 0, tilted by an angle in radians.
pub(crate) fn cut_of(scene: &Scene, angle: f64) -> DVec3 {
    let up = match scene.up {
        UpAxis::Y => DVec3::Y,
        UpAxis::Z => DVec3::Z,
    };
    up * cos(angle) + (DVec3::X + up.cross(DVec3::X) * CUT_SLANT).normalize() * sin(angle)
}

/// Number of cutting planes per pitch. Surfaces facing the camera use only some of them.
const CUTS_PER_PITCH: f64 = 4.0;

/// Turn of tilted planes away from the model's axes, because walls often follow these.
const CUT_SLANT: f64 = 0.35;

/// Cell size for the identity of curve pieces, as a share of their part's size.
const IDENTITY_CELL_OF_PART: f64 = 0.3;

/// The mean world length of a texture coordinate unit in each part.
pub(crate) fn texture_scales(mesh: &Mesh) -> Vec<f64> {
    let mut sums: Vec<[f64; 2]> = Vec::new();
    for (face, uvs) in mesh.corner_uvs.iter().enumerate() {
        let [Some(a), Some(b), Some(c)] = uvs.map(|uv| mesh.uvs.get(uv as usize)) else { continue };
        let [p, q, r] = mesh.corners(FaceId(face as u32));
        let part = mesh.face_part[face].index();
        if sums.len() <= part {
            sums.resize(part + 1, [0.0; 2]);
        }
        let [space, texture] = &mut sums[part];
        *space += (q - p).cross(r - p).length();
        let [a, b, c] = [a, b, c].map(|uv| DVec2::new(f64::from(uv[0]), f64::from(uv[1])));
        *texture += (b - a).perp_dot(c - a).abs();
    }
    let scale = |(part, [space, texture]): (usize, [f64; 2])| {
        let scale = (space / texture).sqrt();
        if scale.is_normal() { scale } else { mesh.extents.part(PartId::from(part)).scale }
    };
    sums.into_iter().enumerate().map(scale).collect()
}

/// Distance between lattice points where light and directions are sampled, px.
const LATTICE_STEP_PX: f64 = 3.0;

/// The tone of each paint.
fn tones(fills: &SurfaceFills, scene: &Scene, style: &Style) -> Vec<ToneCoverage> {
    let lit = fills.lit();
    let Some(bins) = lit.shading.bin_channel() else { return Vec::new() };
    let paints = fills.paints();
    let of = |number: usize| {
        let name = paints
            .get(number)
            .and_then(|paint| scene.materials.get(paint.material.index()))
            .map_or("", |material| material.name.as_str());
        let own = style.hatch.materials.iter().rev().find(|(pattern, _)| pattern.matches(name));
        let table = own.map_or(&style.hatch.coverage, |(_, table)| table);
        ToneCoverage::new(lit.shading.levels(PaintId(number as u32), bins), table)
    };
    // The last entry stands in for unknown paints.
    (0..=paints.len()).map(of).collect()
}
