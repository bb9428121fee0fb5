//! [`Lighting`]: the lights of a drawing in local space, and the light that reaches a point.

use std::f64::consts::PI;

use glam::DVec3;

use super::lamp::{Lamp, LampSource, MAX_EXTENT_SHARE, TURN_PER_EXTENT};
use super::light_options::{LightOptions, LightSource, SourceKind, Space};
use super::specular;
use crate::geometry::numbers::portable_math::{acos, cos, pow};
use crate::light::LightSlope;
use crate::light::tolerances::HIGHLIGHT_FADE_COSINE;
use crate::mesh::Mesh;
use crate::scene::Scene;
use crate::view::Frame;

/// Largest number of lights that cast shadows.
pub(crate) const MAX_SHADOW_LIGHTS: usize = 8;

/// A light that casts shadows, in local space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Caster {
    /// Parallel light.
    Directional {
        /// Unit vector towards the light.
        towards: DVec3,
    },
    /// Light from a point.
    Point {
        /// Position.
        position: DVec3,
    },
}

/// Point of the surface where light is evaluated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SurfacePoint {
    /// Position, local space.
    pub position: DVec3,
    /// Unit normal of the visible side, local space. A surface without normal counts as turned to the eye.
    pub normal: DVec3,
    /// Share of the sky it sees, 0 (none) to 1 (all).
    pub ambient_visibility: f64,
}

/// Selection of lights.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum LampFilter {
    All,
    /// The light with this index.
    Lamp(usize),
    /// The lights with this tint, by index.
    Hue(usize),
}

/// Largest difference per channel between tints that count as one.
const MAX_HUE_DIFFERENCE: f64 = 0.125;

/// Assigns each light the index of its tint, and returns the tints. Similar tints give their mean by weight.
fn part_by_hue(lamps: &mut [Lamp]) -> Vec<[f64; 3]> {
    let mut firsts: Vec<[f64; 3]> = Vec::new();
    let mut sums: Vec<([f64; 3], f64)> = Vec::new();
    for lamp in lamps.iter_mut() {
        let is_like =
            |first: &[f64; 3]| first.iter().zip(lamp.colour).all(|(a, b)| (a - b).abs() < MAX_HUE_DIFFERENCE);
        lamp.hue = firsts.iter().position(is_like).unwrap_or(firsts.len());
        if lamp.hue == firsts.len() {
            firsts.push(lamp.colour);
            sums.push(([0.0; 3], 0.0));
        }
        let (sum, weight_sum) = &mut sums[lamp.hue];
        sum.iter_mut().zip(lamp.colour).for_each(|(sum, c)| *sum += c * lamp.weight);
        *weight_sum += lamp.weight;
    }
    let mean = |(first, (sum, total_weight)): ([f64; 3], ([f64; 3], f64))| {
        if total_weight > 0.0 { sum.map(|c| c / total_weight) } else { first }
    };
    firsts.into_iter().zip(sums).map(mean).collect()
}

/// Lights of a drawing in local space.
#[derive(Debug, Clone)]
pub(crate) struct Lighting {
    lamps: Vec<Lamp>,
    /// Tints of the lights; similar ones are merged.
    hues: Vec<[f64; 3]>,
    casters: Vec<Caster>,
    frame: Option<Frame>,
    wrap: f64,
    occlusion: f64,
    /// Distance of the eye and of parallel lights from the camera's target for highlights, world units, if it
    /// is changed.
    highlight_distance: Option<f64>,
}

impl Lighting {
    /// Lights of a model and a style sheet, for a mesh seen by a camera. With `cast_shadows`, the first eight
    /// lights that may do so cast shadows.
    #[must_use]
    pub(crate) fn new(
        scene: &Scene,
        mesh: &Mesh,
        frame: &Frame,
        options: &LightOptions,
        cast_shadows: bool,
        warnings: &mut Vec<String>,
    ) -> Self {
        let mut lamps = Vec::new();
        if options.from_model {
            lamps = Lamp::of_model(&scene.lights, mesh.origin, frame);
            if lamps.is_empty() && !scene.lights.is_empty() {
                warnings.push("the model's lights give no light and are left out".to_owned());
            }
        }
        lamps.extend(options.sources.iter().map(|source| of_source(source, mesh.origin, frame)));
        if lamps.is_empty() {
            lamps.push(of_source(&LightSource::default(), mesh.origin, frame));
        } else if lamps.iter().all(|lamp| lamp.weight <= 0.0) {
            warnings.push("no light has any brightness, so all surfaces are in shadow".to_owned());
        }

        let mut casters = Vec::new();
        for lamp in lamps.iter_mut().filter(|lamp| cast_shadows && lamp.shadows) {
            if casters.len() < MAX_SHADOW_LIGHTS {
                lamp.caster = Some(casters.len() as u32);
            }
            casters.push(match lamp.reach {
                LampSource::Parallel { towards } => Caster::Directional { towards },
                LampSource::Point { position, .. } => Caster::Point { position },
            });
        }
        if casters.len() > MAX_SHADOW_LIGHTS {
            let count = casters.len();
            warnings
                .push(format!("{count} lights would cast shadows; only the first {MAX_SHADOW_LIGHTS} do"));
            casters.truncate(MAX_SHADOW_LIGHTS);
        }
        let hues = part_by_hue(&mut lamps);
        let (wrap, occlusion) = (options.wrap, options.occlusion);
        Self { lamps, hues, casters, frame: Some(*frame), wrap, occlusion, highlight_distance: None }
    }

    /// Moves the eye and parallel lights to `sides` frame sides from the camera's target, for highlights
    /// only; 0 leaves them in place.
    #[must_use]
    pub(crate) fn near_for_highlights(self, sides: f64) -> Self {
        let near_distance =
            self.frame.map(|frame| sides * frame.side_at(frame.focus)).filter(|far| *far > 0.0);
        Self { highlight_distance: near_distance, ..self }
    }

    /// Lights that cast shadows; the index of each is its bit in `shadowed`.
    #[must_use]
    pub(crate) fn casters(&self) -> &[Caster] {
        &self.casters
    }

    /// Number of lights.
    #[must_use]
    pub(crate) fn count(&self) -> usize {
        self.lamps.len()
    }

    /// Whether light varies over a flat surface.
    #[must_use]
    pub(crate) fn is_local(&self) -> bool {
        self.occlusion > 0.0
            || self.lamps.iter().any(|lamp| !matches!(lamp.reach, LampSource::Parallel { .. }))
    }

    /// If there is one light, and it is parallel: its direction, and the cosine between it and the normal at
    /// which the diffuse light has a value.
    #[must_use]
    pub(crate) fn only_parallel(&self) -> Option<(DVec3, impl Fn(f64) -> f64 + '_)> {
        let [lamp] = self.lamps.as_slice() else { return None };
        let LampSource::Parallel { towards } = lamp.reach else { return None };
        Some((towards, move |value| value / lamp.brightness * (1.0 + self.wrap) - self.wrap))
    }

    /// Bounds for the change of parallel light with the normal.
    #[must_use]
    pub(crate) fn slope(&self) -> LightSlope {
        let most = self.lamps.iter().map(|lamp| lamp.weight / (1.0 + self.wrap)).sum();
        LightSlope { most, dips: self.lamps.len() > 1 }
    }

    /// Tint of all lights together: their colours weighted by brightness; white without light.
    ///
    /// Tinting each point by the light that reaches it would spoil the steps (Ishaya 2003).
    #[must_use]
    pub(crate) fn tint(&self) -> [f64; 3] {
        let total: f64 = self.lamps.iter().map(|lamp| lamp.weight).sum();
        if total <= 0.0 {
            return [1.0; 3];
        }
        let channel = |c: usize| self.lamps.iter().map(|lamp| lamp.weight * lamp.colour[c]).sum::<f64>();
        [0, 1, 2].map(|c| channel(c) / total)
    }

    /// Tints of the lights; similar ones are merged.
    #[must_use]
    pub(crate) fn hues(&self) -> &[[f64; 3]] {
        &self.hues
    }

    /// Diffuse light of the selected lights that are not `shadowed`: the sum of brightness · fall-off ·
    /// max(L·n, 0).
    #[must_use]
    pub(crate) fn diffuse(&self, of: LampFilter, point: &SurfacePoint, shadowed: u32) -> f64 {
        let normal = self.normal(point);
        let lamps = self.chosen(of, shadowed);
        let light: f64 = lamps.map(|lamp| self.diffuse_of(lamp, point.position, normal)).sum();
        light * self.open(point)
    }

    /// Selected lights that are not `shadowed`.
    fn chosen(&self, of: LampFilter, shadowed: u32) -> impl Iterator<Item = &Lamp> {
        let is_chosen = move |(k, lamp): &(usize, &Lamp)| match of {
            LampFilter::All => true,
            LampFilter::Lamp(lamp_index) => lamp_index == *k,
            LampFilter::Hue(hue) => hue == lamp.hue,
        };
        let chosen = self.lamps.iter().enumerate().filter(is_chosen).map(|(_, lamp)| lamp);
        chosen.filter(move |lamp| !lamp.is_shadowed(shadowed))
    }

    /// Strength of the highlight: the sum of brightness · fall-off · (n·h)^exponent over the lights that are
    /// not `shadowed`; see [`specular::blinn_phong`].
    #[must_use]
    pub(crate) fn specular(&self, point: &SurfacePoint, exponent: f64, shadowed: u32) -> f64 {
        let Some(frame) = &self.frame else { return 0.0 };
        let (to_eye, _) = self.eye_of_highlights(frame, point.position);
        let normal = self.normal(point);
        let of = |lamp: &Lamp| {
            let (towards, amount) = lamp.at(point.position);
            let towards =
                self.towards_for_highlights(frame, lamp, point.position).map_or(towards, |(to, _)| to);
            let fade = (towards.dot(normal) / HIGHLIGHT_FADE_COSINE).clamp(0.0, 1.0);
            amount * fade * specular::blinn_phong(normal, towards, to_eye, exponent)
        };
        self.chosen(LampFilter::All, shadowed).map(of).sum()
    }

    /// Bounds of the diffuse light of the selected lights; see [`crate::light::Shading::range`].
    pub(crate) fn diffuse_range(
        &self,
        of: LampFilter,
        point: &SurfacePoint,
        shadowed: u32,
        turn: f64,
        extent: f64,
    ) -> (f64, f64) {
        let normal = self.normal(point);
        let lambert = |angle: f64| ((cos(angle) + self.wrap) / (1.0 + self.wrap)).max(0.0);
        let (mut low, mut high) = (0.0, 0.0);
        for lamp in self.chosen(of, shadowed) {
            let Some(lamp_bounds) = lamp.near(point.position, extent) else { return UNBOUNDED };
            let angle = acos(lamp_bounds.towards.dot(normal).clamp(-1.0, 1.0));
            let turn = turn + lamp_bounds.turn;
            low += lamp_bounds.amount / lamp_bounds.factor * lambert((angle + turn).min(PI));
            high += lamp_bounds.amount * lamp_bounds.factor * lambert((angle - turn).max(0.0));
        }
        (low * (1.0 - self.occlusion.clamp(0.0, 1.0)), high)
    }

    /// Bounds of the highlight; see [`crate::light::Shading::range`].
    pub(crate) fn specular_range(
        &self,
        point: &SurfacePoint,
        exponent: f64,
        shadowed: u32,
        turn: f64,
        extent: f64,
    ) -> (f64, f64) {
        let Some(frame) = &self.frame else { return (0.0, 0.0) };
        let (to_eye, eye_distance) = self.eye_of_highlights(frame, point.position);
        if extent > MAX_EXTENT_SHARE * eye_distance {
            return UNBOUNDED;
        }
        let eye_turn = TURN_PER_EXTENT * extent / eye_distance;
        let normal = self.normal(point);
        let mut high = 0.0;
        for lamp in self.chosen(LampFilter::All, shadowed) {
            let Some(mut lamp_bounds) = lamp.near(point.position, extent) else { return UNBOUNDED };
            if let Some((towards, lamp_distance)) = self.towards_for_highlights(frame, lamp, point.position) {
                if extent > MAX_EXTENT_SHARE * lamp_distance {
                    return UNBOUNDED;
                }
                (lamp_bounds.towards, lamp_bounds.turn) = (towards, TURN_PER_EXTENT * extent / lamp_distance);
            }
            let half = (lamp_bounds.towards + to_eye).normalize_or_zero();
            // The half vector turns by at most the sum of both turns, while the two directions are within a
            // right angle. Otherwise there is no bound.
            if lamp_bounds.towards.dot(to_eye) < 0.0 {
                return UNBOUNDED;
            }
            let angle = acos(normal.dot(half).clamp(-1.0, 1.0)) - turn - lamp_bounds.turn - eye_turn;
            high += lamp_bounds.amount
                * lamp_bounds.factor
                * pow(cos(angle.clamp(0.0, PI / 2.0)).max(0.0), exponent);
        }
        (0.0, high)
    }

    /// Direction and distance to the eye for highlights; the distance is infinite in parallel views.
    fn eye_of_highlights(&self, frame: &Frame, position: DVec3) -> (DVec3, f64) {
        match self.highlight_distance {
            Some(near) => {
                let offset = frame.target() - frame.forward * near - position;
                (offset.normalize_or_zero(), offset.length())
            }
            None if frame.perspective => (frame.to_eye(position), frame.eye.distance(position)),
            None => (frame.to_eye(position), f64::INFINITY),
        }
    }

    /// Direction and distance to a parallel light moved near for highlights; `None` for other lights.
    fn towards_for_highlights(&self, frame: &Frame, lamp: &Lamp, position: DVec3) -> Option<(DVec3, f64)> {
        let LampSource::Parallel { towards } = lamp.reach else { return None };
        let offset = frame.target() + towards * self.highlight_distance? - position;
        Some((offset.normalize_or_zero(), offset.length()))
    }

    fn diffuse_of(&self, lamp: &Lamp, position: DVec3, normal: DVec3) -> f64 {
        let (towards, amount) = lamp.at(position);
        amount * ((towards.dot(normal) + self.wrap) / (1.0 + self.wrap)).max(0.0)
    }

    /// The normal or, without one, the direction to the eye.
    fn normal(&self, point: &SurfacePoint) -> DVec3 {
        match &self.frame {
            Some(frame) if point.normal == DVec3::ZERO || !point.normal.is_finite() => {
                frame.to_eye(point.position)
            }
            _ => point.normal,
        }
    }

    /// Share of the light left after ambient occlusion.
    fn open(&self, point: &SurfacePoint) -> f64 {
        1.0 - self.occlusion * (1.0 - point.ambient_visibility.clamp(0.0, 1.0))
    }
}

/// Bounds that exclude nothing.
const UNBOUNDED: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);

/// Light of the style sheet in local space.
fn of_source(source: &LightSource, origin: DVec3, frame: &Frame) -> Lamp {
    // Camera space has z towards the viewer; the frame's third axis points away from the eye.
    let turned = |v: DVec3| frame.right * v.x + frame.up * v.y - frame.forward * v.z;
    let colour = source.colour.channels();
    let lamp = match (source.kind, source.space) {
        (SourceKind::Directional { direction }, space) => {
            let direction = direction.normalize_or_zero();
            let towards = if space == Space::Camera { turned(direction) } else { direction };
            Lamp::parallel(towards, source.brightness, colour)
        }
        (SourceKind::Point { position, falloff }, space) => {
            let position =
                if space == Space::Camera { frame.eye + turned(position) } else { position - origin };
            Lamp::point(position, falloff, source.brightness, colour)
        }
    };
    Lamp { shadows: source.shadows, ..lamp }
}
