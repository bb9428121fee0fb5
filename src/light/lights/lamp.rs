//! [`Lamp`]: one light in local space, with its fall-off and its cone.

use glam::DVec3;

use crate::colour::srgb::Colour;
use crate::geometry::numbers::portable_math::{cos, pow};
use crate::geometry::numbers::tolerance::{LAMP_OF_FRAME, LEAST_CONE};
use crate::scene::{Light, LightKind};
use crate::view::Frame;

/// One light in local space.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Lamp {
    /// From where it shines.
    pub reach: Reach,
    /// Factor of its light.
    pub brightness: f64,
    /// Light at the middle of the model, for weighing lights against each other.
    pub weight: f64,
    /// Tint, channels as written.
    pub colour: [f64; 3],
    /// The number of its tint among those of all lights.
    pub hue: usize,
    /// Whether it may cast shadows.
    pub shadows: bool,
    /// Its bit among those that cast shadows.
    pub caster: Option<u32>,
}

/// Light near a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Near {
    /// Unit vector to the light.
    pub towards: DVec3,
    /// How much of it gets to the point.
    pub amount: f64,
    /// By how much its direction may differ nearby, radians.
    pub turn: f64,
    /// By what factor its amount may differ nearby.
    pub factor: f64,
}

/// Bounds are known for no more than this part of the distance.
pub(crate) const LARGEST_EXTENT: f64 = 0.4;

/// The turn of a direction, as a factor of that part, up to [`LARGEST_EXTENT`].
pub(crate) const EXTENT_TO_TURN: f64 = 1.1;

/// From where a lamp shines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Reach {
    /// Parallel light.
    Parallel { towards: DVec3 },
    /// Light from a point.
    Point { position: DVec3, falloff: FallOff, cone: Option<Cone> },
}

/// How light grows weaker with the distance d.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum FallOff {
    /// It does not.
    None,
    /// 1/(1 + (d/D)²): half is left at D, and nothing is ever infinite.
    Half(f64),
    /// 1/d², at most 1/nearest², and gone at the range if there is one (KHR_lights_punctual).
    Square { nearest: f64, range: Option<f64> },
}

/// The cone of a spot light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Cone {
    /// Axis, away from the light.
    axis: DVec3,
    /// Cosine of the angle outside which there is no light.
    outer: f64,
    /// 1/(cosine of the angle inside which it is full − `outer`).
    slope: f64,
}

impl Lamp {
    /// Parallel light.
    pub fn parallel(towards: DVec3, brightness: f64, colour: [f64; 3]) -> Self {
        let reach = Reach::Parallel { towards };
        Self { reach, brightness, weight: brightness, colour, hue: 0, shadows: true, caster: None }
    }

    /// Light from a point that halves at a distance.
    pub fn point(position: DVec3, half_at: Option<f64>, brightness: f64, colour: [f64; 3]) -> Self {
        let falloff = half_at.map_or(FallOff::None, FallOff::Half);
        let reach = Reach::Point { position, falloff, cone: None };
        Self { reach, brightness, weight: brightness, colour, hue: 0, shadows: true, caster: None }
    }

    /// The lights of a model, scaled together such that the brightest gives 1 where the
    /// camera looks.
    ///
    /// A file's lux and candela suit its renderer's exposure, not drawings. Those without light are
    /// left out. A lamp near the target counts as a quarter of the frame's longer side away, and one that
    /// shines elsewhere as if it were aimed at the target: the scale must not hang on a hair.
    pub fn of_model(lights: &[Light], origin: DVec3, frame: &Frame) -> Vec<Self> {
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

    /// Whether its bit is set.
    pub fn is_shadowed(&self, shadowed: u32) -> bool {
        self.caster.is_some_and(|bit| shadowed >> bit & 1 == 1)
    }

    /// Its light at a point and how that may vary within `extent` of it; none where the light is too
    /// near to tell, has a cone, or ends at a range.
    pub fn near(&self, point: DVec3, extent: f64) -> Option<Near> {
        let (towards, amount) = self.at(point);
        match &self.reach {
            Reach::Parallel { .. } => Some(Near { towards, amount, turn: 0.0, factor: 1.0 }),
            Reach::Point { cone: Some(_), .. }
            | Reach::Point { falloff: FallOff::Square { range: Some(_), .. }, .. } => None,
            Reach::Point { position, .. } => {
                let part = extent / position.distance(point);
                (part <= LARGEST_EXTENT).then(|| Near {
                    towards,
                    amount,
                    turn: EXTENT_TO_TURN * part,
                    // Light falls off with the square of the distance at most.
                    factor: pow(1.0 - part, -2.0),
                })
            }
        }
    }

    /// Unit vector from a point to the light, and how much of it gets there.
    pub fn at(&self, point: DVec3) -> (DVec3, f64) {
        match &self.reach {
            Reach::Parallel { towards } => (*towards, self.brightness),
            Reach::Point { position, falloff, cone } => {
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

impl Cone {
    /// Share of the light in a direction away from it.
    fn at(&self, away: DVec3) -> f64 {
        let share = ((away.dot(self.axis) - self.outer) * self.slope).clamp(0.0, 1.0);
        share * share
    }
}

/// A light of the model in local space, not yet scaled; none if it has no sound direction.
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
            let falloff = FallOff::Square { nearest: size * LAMP_OF_FRAME, range };
            let cone = match light.kind {
                LightKind::Spot { direction, inner_angle, outer_angle, .. } => {
                    let outer = cos(outer_angle);
                    let width = (cos(inner_angle) - outer).max(LEAST_CONE);
                    Some(Cone { axis: direction.try_normalize()?, outer, slope: 1.0 / width })
                }
                _ => None,
            };
            let away = position.distance(frame.target()).max(size / 4.0);
            Lamp {
                reach: Reach::Point { position, falloff, cone },
                weight: light.intensity / (away * away),
                ..Lamp::parallel(DVec3::ZERO, light.intensity, colour)
            }
        }
    };
    lamp.weight.is_finite().then_some(lamp)
}
