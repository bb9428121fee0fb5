//! [`Lamp`]: one light in local space, with fall-off and spot cone.

use glam::DVec3;

use crate::colour::srgb::Colour;
use crate::geometry::numbers::portable_math::{cos, pow};
use crate::light::tolerances::{MIN_CONE_SOFTNESS_COSINE, MIN_LAMP_DISTANCE_OF_FRAME};
use crate::scene::{Light, LightKind};
use crate::view::Frame;

/// One light in local space.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Lamp {
    /// Direction or position of the light.
    pub reach: LampSource,
    /// Brightness factor.
    pub brightness: f64,
    /// Light at the centre of the model, for weighting lights against each other.
    pub weight: f64,
    /// Tint, channels as written (sRGB).
    pub colour: [f64; 3],
    /// Index of its tint among those of all lights.
    pub hue: usize,
    /// Whether it may cast shadows.
    pub shadows: bool,
    /// Its bit in a shadow mask, if it casts shadows.
    pub caster: Option<u32>,
}

/// Light near a point, with bounds for the surroundings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LocalLight {
    /// Unit vector to the light.
    pub towards: DVec3,
    /// Amount that reaches the point.
    pub amount: f64,
    /// Largest difference of its direction nearby, radians.
    pub turn: f64,
    /// Largest factor between amounts nearby.
    pub factor: f64,
}

/// Largest extent, as a share of the distance, for a bound.
pub(crate) const MAX_EXTENT_SHARE: f64 = 0.4;

/// Turn of the direction per unit of that share, radians, up to [`MAX_EXTENT_SHARE`].
pub(crate) const TURN_PER_EXTENT: f64 = 1.1;

/// Direction or position of a lamp.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum LampSource {
    /// Parallel light.
    Parallel { towards: DVec3 },
    /// Light from a point.
    Point { position: DVec3, falloff: FallOff, cone: Option<SpotCone> },
}

/// Fall-off of light with the distance d.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum FallOff {
    /// No fall-off.
    None,
    /// 1/(1 + (d/D)²): half is left at D, and the value is finite everywhere.
    Half(f64),
    /// 1/d², at most 1/nearest², and zero from the range on if there is one (KHR_lights_punctual).
    Square { nearest: f64, range: Option<f64> },
}

/// Cone of a spot light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SpotCone {
    /// Axis, away from the light.
    axis: DVec3,
    /// Cosine of the angle outside which there is no light.
    outer: f64,
    /// 1/(cosine of the angle inside of full light − `outer`).
    slope: f64,
}

impl Lamp {
    /// Parallel light.
    pub(crate) fn parallel(towards: DVec3, brightness: f64, colour: [f64; 3]) -> Self {
        let reach = LampSource::Parallel { towards };
        Self { reach, brightness, weight: brightness, colour, hue: 0, shadows: true, caster: None }
    }

    /// Light from a point that halves at a distance.
    pub(crate) fn point(position: DVec3, half_at: Option<f64>, brightness: f64, colour: [f64; 3]) -> Self {
        let falloff = half_at.map_or(FallOff::None, FallOff::Half);
        let reach = LampSource::Point { position, falloff, cone: None };
        Self { reach, brightness, weight: brightness, colour, hue: 0, shadows: true, caster: None }
    }

    /// Lights of a model, scaled together so that the brightest gives 1 at the camera's target.
    ///
    /// A file's lux and candela suit the exposure of its renderer, not drawings. Lights without intensity are
    /// left out. A lamp near the target counts as a quarter of the frame's longer side away, and a lamp aimed
    /// elsewhere as if aimed at the target. Otherwise small changes would alter the scale of all lights.
    pub(crate) fn of_model(lights: &[Light], origin: DVec3, frame: &Frame) -> Vec<Self> {
        let shines = |light: &&Light| light.intensity.is_finite() && light.intensity > 0.0;
        let mut lamps: Vec<Self> =
            lights.iter().filter(shines).filter_map(|light| of_light(light, origin, frame)).collect();
        let brightest = lamps.iter().map(|lamp| lamp.weight).fold(0.0, f64::max);
        if !(brightest.is_finite() && brightest > 0.0) {
            return Vec::new();
        }
        for lamp in &mut lamps {
            lamp.brightness /= brightest;
            lamp.weight /= brightest;
        }
        lamps
    }

    /// Whether its bit is set in a shadow mask.
    pub(crate) fn is_shadowed(&self, shadowed: u32) -> bool {
        self.caster.is_some_and(|bit| shadowed >> bit & 1 == 1)
    }

    /// Light at a point, with bounds within `extent` of it. `None` where the light is too near, has a cone,
    /// or ends at a range.
    pub(crate) fn near(&self, point: DVec3, extent: f64) -> Option<LocalLight> {
        let (towards, amount) = self.at(point);
        match &self.reach {
            LampSource::Parallel { .. } => Some(LocalLight { towards, amount, turn: 0.0, factor: 1.0 }),
            LampSource::Point { cone: Some(_), .. }
            | LampSource::Point { falloff: FallOff::Square { range: Some(_), .. }, .. } => None,
            LampSource::Point { position, .. } => {
                let part = extent / position.distance(point);
                (part <= MAX_EXTENT_SHARE).then(|| LocalLight {
                    towards,
                    amount,
                    turn: TURN_PER_EXTENT * part,
                    // Light falls off with the square of the distance at most.
                    factor: pow(1.0 - part, -2.0),
                })
            }
        }
    }

    /// Unit vector from a point to the light, and the amount that reaches the point.
    pub(crate) fn at(&self, point: DVec3) -> (DVec3, f64) {
        match &self.reach {
            LampSource::Parallel { towards } => (*towards, self.brightness),
            LampSource::Point { position, falloff, cone } => {
                let way = *position - point;
                let towards = way.normalize_or_zero();
                let cone = cone.as_ref().map_or(1.0, |cone| cone.at(-towards));
                (towards, self.brightness * falloff.at(way.length()) * cone)
            }
        }
    }
}

impl FallOff {
    fn at(self, distance: f64) -> f64 {
        match self {
            Self::None => 1.0,
            Self::Half(half_at) => 1.0 / (1.0 + (distance / half_at) * (distance / half_at)),
            Self::Square { nearest, range } => {
                let d = distance.max(nearest);
                let window = range.map_or(1.0, |range| {
                    let square = (distance / range) * (distance / range);
                    (1.0 - square * square).clamp(0.0, 1.0)
                });
                window / (d * d)
            }
        }
    }
}

impl SpotCone {
    /// Share of the light in a direction away from the lamp.
    fn at(&self, away: DVec3) -> f64 {
        let share = ((away.dot(self.axis) - self.outer) * self.slope).clamp(0.0, 1.0);
        share * share
    }
}

/// Light of the model in local space, not yet scaled; `None` if its direction is invalid.
fn of_light(light: &Light, origin: DVec3, frame: &Frame) -> Option<Lamp> {
    let size = frame.side_at(frame.focus);
    let size = if size > 0.0 && size.is_finite() { size } else { 1.0 };
    let [r, g, b] = light.colour;
    let colour = Colour::from_linear([r, g, b, 1.0]).channels();
    let lamp = match light.kind {
        LightKind::Directional { direction } => {
            Lamp::parallel(-direction.try_normalize()?, light.intensity, colour)
        }
        LightKind::Point { position } | LightKind::Spot { position, .. } => {
            let position = position - origin;
            let range = light.range.filter(|range| range.is_finite() && *range > 0.0);
            let falloff = FallOff::Square { nearest: size * MIN_LAMP_DISTANCE_OF_FRAME, range };
            let cone = match light.kind {
                LightKind::Spot { direction, inner_angle, outer_angle, .. } => {
                    let outer = cos(outer_angle);
                    let width = (cos(inner_angle) - outer).max(MIN_CONE_SOFTNESS_COSINE);
                    Some(SpotCone { axis: direction.try_normalize()?, outer, slope: 1.0 / width })
                }
                _ => None,
            };
            let away = position.distance(frame.target()).max(size / 4.0);
            Lamp {
                reach: LampSource::Point { position, falloff, cone },
                weight: light.intensity / (away * away),
                ..Lamp::parallel(DVec3::ZERO, light.intensity, colour)
            }
        }
    };
    lamp.weight.is_finite().then_some(lamp)
}
