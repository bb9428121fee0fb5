//! [`LengthPrecision`]: how many decimals the input carries of a length.
//!
//! Each point of the model has a step, the resolution of its coordinates:
//!
//! - the unit of the last decimal in a text file,
//! - the distance between neighbouring numbers in single precision,
//! - the step of the lattice in a quantised file,
//! - 0 in double precision and for points that a page file spells out.
//!
//! Rules:
//!
//! - A length from decimals keeps those decimals.
//! - A coordinate in single precision or on a lattice is off by up to half a step. A length is rounded to the
//!   finest power of ten whose half is at least the error of both ends. That restores lengths with few
//!   decimals.
//! - A circle is fitted to many corners. The error is the distance of the corners from the circle; the radius
//!   is rounded to the next power of ten.

use glam::DVec3;

use crate::page::tolerances::{MAX_CIRCLE_FIT_OF_COORDINATE, MAX_ROUNDING_OF_COORDINATE};
use crate::scene::extent::drawn_points::DrawnPoints;
use crate::scene::triangle_soup::longest_axis;
use crate::scene::{Geometry, Part, Scene};
use crate::surface::Cylinder;

/// A point of the model or of a page file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct MeasuredPoint {
    /// Position, world.
    pub at: DVec3,
    /// Step of its coordinates, world; 0 in double precision.
    pub step: f64,
}

impl MeasuredPoint {
    /// A point with exact coordinates.
    pub(crate) fn exact(at: DVec3) -> Self {
        Self { at, step: 0.0 }
    }

    /// The coarsest step of all parts of a scene.
    pub(crate) fn coarsest(scene: &Scene) -> f64 {
        scene.parts.iter().map(|part| step_of(scene, part)).fold(0.0, f64::max)
    }

    /// The drawn points of selected parts.
    pub(crate) fn of_parts(scene: &Scene, is_wanted: impl Fn(&Part) -> bool) -> Vec<Self> {
        let drawn = DrawnPoints::of_parts(scene, is_wanted);
        let mut found = Vec::with_capacity(drawn.points.len());
        for own in &drawn.parts {
            let step = scene.parts.get(own.part).map_or(0.0, |part| step_of(scene, part));
            let points = drawn.points.get(own.points.clone()).unwrap_or_default();
            found.extend(points.iter().map(|at| Self { at: *at, step }));
        }
        found
    }
}

/// The step of a part's coordinates, world.
fn step_of(scene: &Scene, part: &Part) -> f64 {
    let own = scene.geometry_of(part).map_or(0.0, Geometry::finest_step);
    own * longest_axis(&part.world_from_part)
}

/// The number of decimals that the input carries of a length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LengthPrecision {
    /// Minus the exponent of the power of ten used for rounding.
    decimals: i32,
    /// Lengths up to this value cannot be distinguished from 0.
    noise: f64,
}

impl LengthPrecision {
    /// Precision of a length between two points along a direction.
    pub(crate) fn between(ends: [MeasuredPoint; 2], along: DVec3) -> Self {
        let [a, b] = ends.map(|end| end.step);
        let rounding = MAX_ROUNDING_OF_COORDINATE * largest_coordinate(ends.map(|end| end.at));
        // Half a step at both ends, summed over the three coordinates.
        let error = (a + b) / 2.0 * along.abs().element_sum() + rounding;
        let step = a.max(b);
        let is_decimal = step > rounding && power_above(1.000_001 * step) > power_above(step);
        let decimals = if is_decimal { -power_above(step) } else { -power_above(2.0 * error) };
        Self { decimals, noise: if is_decimal { rounding } else { error } }
    }

    /// Precision of a fitted radius, diameter or axis position.
    pub(crate) fn of_cylinder(cylinder: &Cylinder) -> Self {
        let largest = cylinder.point.abs().max_element().max(cylinder.radius);
        let error = cylinder.spread.max(MAX_CIRCLE_FIT_OF_COORDINATE * largest);
        Self { decimals: -power_above(error), noise: error }
    }

    /// The coarser of two precisions.
    pub(crate) fn coarser(self, other: Self) -> Self {
        Self { decimals: self.decimals.min(other.decimals), noise: self.noise.max(other.noise) }
    }

    /// Rounds a positive length to the decimals of the input.
    pub(crate) fn rounded(self, length: f64) -> f64 {
        let power = power_of_ten(self.decimals.unsigned_abs() as usize);
        let rounded = if self.decimals >= 0 {
            (length * power).round() / power
        } else {
            (length / power).round() * power
        };
        if !rounded.is_finite() || (rounded == 0.0 && length > self.noise) { length } else { rounded }
    }
}

fn largest_coordinate(points: [DVec3; 2]) -> f64 {
    points.into_iter().map(|p| p.abs().max_element()).fold(f64::MIN_POSITIVE, f64::max)
}

/// The exponent of the smallest power of ten that is at least `number`, rounded to ten significant digits.
fn power_above(number: f64) -> i32 {
    let text = format!("{number:.9e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or(("1", "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let is_power =
        mantissa.bytes().skip(1).all(|byte| matches!(byte, b'.' | b'0')) && mantissa.starts_with('1');
    if is_power { exponent } else { exponent + 1 }
}

/// A power of ten: exact up to 10^22, infinite from 10^309.
pub(crate) fn power_of_ten(exponent: usize) -> f64 {
    (0..exponent).fold(1.0, |power, _| power * 10.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rounded(length: f64, from: f64, step: f64) -> f64 {
        let end = |x: f64| MeasuredPoint { at: DVec3::new(x, 0.0, 0.0), step };
        LengthPrecision::between([end(from), end(from + length)], DVec3::X).rounded(length)
    }

    #[test]
    fn lengths_are_rounded_to_the_precision_of_the_input() {
        for length in [53.975, 9.525, 20.125, 0.1, 1234.565, 7.0] {
            for from in [0.0, 3.7, -812.35] {
                // The three lines test single precision, double precision, and decimals.
                let (a, b) = (from as f32, (from + length) as f32);
                let step = f64::from(a.abs().max(b.abs()).next_up()) - f64::from(a.abs().max(b.abs()));
                assert_eq!(rounded(f64::from(b) - f64::from(a), f64::from(a), step), length, "{from}");
                assert_eq!(rounded(from + length - from, from, 0.0), length, "{from}");
                assert_eq!(rounded(length + 1e-12, from, 1e-6), length, "{from}");
            }
        }
        // The last decimal of a text is kept.
        assert_eq!(rounded(0.053_4, 0.0, 1e-4), 0.053_4);
        assert!((rounded(2.0_f64.sqrt(), 0.0, 0.0) - 2.0_f64.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn length_precision_rounds_only_noise_to_zero() {
        assert_eq!(rounded(1e-17, 0.3, 0.0), 0.0);
        assert_eq!(rounded(0.004, 0.0, 0.0), 0.004);
        assert_eq!(rounded(1e-6, 900.0, 1e-6), 1e-6);
        // Neighbouring numbers in single precision may stand for the same value; numbers farther apart do
        // not.
        let step = 1.0 / 16384.0;
        assert_eq!(rounded(step, 900.0, step), 0.0);
        assert_eq!(rounded(1.5 * step, 0.0, step), 1.5 * step);
    }

    #[test]
    fn power_above_finds_the_next_power_of_ten() {
        for (number, wanted) in
            [(1e-6, -6), (1.1e-6, -5), (0.1 + 0.2 - 0.2, -1), (1.0, 0), (9.0, 1), (5e-324, -323)]
        {
            assert_eq!(power_above(number), wanted, "{number}");
        }
    }
}
