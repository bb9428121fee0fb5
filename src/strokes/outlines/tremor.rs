//! Tremor: moves the points of an axis by smooth noise along its arc length.

use kurbo::Vec2;

use crate::chains::Anchor;
use crate::geometry::numbers::noise::{hash, value_noise, value_noise_3d};
use crate::geometry::numbers::portable_math::{ln, pow};
use crate::strokes::axes::stroke_axis::StrokeAxis;

/// Distance from ends and corners where the motion reaches its full size, in wavelengths.
const PIN_REACH_WAVES: f64 = 0.4;

/// Relative length and share of the second, finer wave, which makes the motion irregular.
const SECOND_WAVE_LENGTH_AND_SHARE: [f64; 2] = [0.43, 0.3];

/// Wavelength of the drift of further passes, relative to the tremor.
const DRIFT_LENGTH_WAVES: f64 = 2.5;

/// Motion of one pass over a chain.
#[derive(Debug, Clone)]
pub(crate) struct Tremor {
    /// Greatest sideways motion.
    pub amplitude: f64,
    /// Wavelength.
    pub wave: f64,
    /// Greatest drift of the whole pass, in any direction.
    pub stray: f64,
    pub seed: u64,
    /// Arc lengths of fixed points: ends and corners of the chain.
    pub pins: Vec<f64>,
    /// Length of a closed chain; `None` for an open one.
    pub round: Option<f64>,
    /// Random seed for lines with known positions on the model. There the noise varies over the surface
    /// instead of along the line, so it stays when the model moves or the visible part changes.
    pub solid: u64,
}

impl Tremor {
    /// Moves each point by at most its limit.
    pub(crate) fn shake(&self, axis: &mut StrokeAxis, limits: &[f64]) {
        if self.amplitude <= 0.0 && self.stray <= 0.0 {
            return;
        }
        let n = axis.len();
        let moved = (0..n).map(|i| {
            let arc = axis.arcs[i];
            let along = axis.direction(i, super::offset_side::DIRECTION_REACH_POINTS);
            let at = NoisePosition {
                arc,
                anchor: axis.samples.get(i).map(|sample| sample.anchor).unwrap_or_default(),
            };
            let across = Vec2::new(along.y, -along.x) * (self.amplitude * self.pin(arc) * self.tremor(at));
            let drift = if self.stray > 0.0 {
                let [x, y] = [2, 3].map(|word| self.noise(word, at, self.wave * DRIFT_LENGTH_WAVES));
                Vec2::new(x, y) * (self.stray * std::f64::consts::FRAC_1_SQRT_2)
            } else {
                Vec2::ZERO
            };
            let way = across + drift;
            let far = way.hypot2().sqrt();
            axis.points[i] + way * within(far, limits[i])
        });
        axis.points = moved.collect();
    }

    /// Sum of the main and the finer wave, -1 to 1.
    fn tremor(&self, at: NoisePosition) -> f64 {
        let [length, share] = SECOND_WAVE_LENGTH_AND_SHARE;
        (1.0 - share) * self.noise(0, at, self.wave) + share * self.noise(1, at, self.wave * length)
    }

    /// Attenuation: 0 at a pin, 1 away from all pins.
    fn pin(&self, arc: f64) -> f64 {
        let away = |pin: &f64| {
            let way = (arc - pin).abs();
            self.round.map_or(way, |round| way.rem_euclid(round).min(round - way.rem_euclid(round)))
        };
        let t = self.pins.iter().map(away).fold(f64::INFINITY, f64::min) / (PIN_REACH_WAVES * self.wave);
        let t = t.clamp(0.0, 1.0);
        t * t * (3.0 - 2.0 * t)
    }

    /// Noise along the chain. In a closed chain it is periodic.
    fn noise(&self, word: u64, NoisePosition { arc, anchor }: NoisePosition, wave: f64) -> f64 {
        if wave <= 0.0 {
            return 0.0;
        }
        if anchor.is_known() {
            return on_surface(hash(self.solid, &[word]), anchor, wave);
        }
        let seed = hash(self.seed, &[word]);
        let Some(round) = self.round else { return value_noise(seed, arc / wave) };
        let arc = arc.rem_euclid(round);
        // Over the last wavelength it blends into the noise before the start.
        let t = ((arc - round) / wave.min(round) + 1.0).clamp(0.0, 1.0);
        let share = t * t * (3.0 - 2.0 * t);
        let before = |arc: f64| value_noise(seed, arc / wave);
        before(arc) * (1.0 - share) + before(arc - round) * share
    }
}

/// Position of an axis point: along the axis, and on the model.
#[derive(Debug, Clone, Copy)]
struct NoisePosition {
    arc: f64,
    anchor: Anchor,
}

/// Noise on the model's surface, with waves about `wave` long on the page.
///
/// Wavelengths on the model are powers of two. As the model comes closer, one octave blends into the next.
fn on_surface(seed: u64, anchor: Anchor, wave: f64) -> f64 {
    let exponent = ln(f64::from(anchor.scale) / wave) / std::f64::consts::LN_2;
    if !exponent.is_finite() {
        return 0.0;
    }
    let (coarse, t) = (exponent.floor(), exponent - exponent.floor());
    let at = |octave: f64| {
        let waves = pow(2.0, octave);
        value_noise_3d(
            hash(seed, &[(octave as i64).cast_unsigned()]),
            anchor.rest_position.map(|x| f64::from(x) * waves),
        )
    };
    (1.0 - t) * at(coarse) + t * at(coarse + 1.0)
}

/// Factor that keeps a displacement within a limit, smoothly.
fn within(way: f64, limit: f64) -> f64 {
    if limit.is_infinite() {
        return 1.0;
    }
    limit / (limit * limit + way * way).sqrt().max(f64::MIN_POSITIVE)
}
