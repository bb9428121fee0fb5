//! Measures the precision of a file's coordinates from the coordinates themselves.
//!
//! A text has decimals, often six, and many programs compute in single precision before they write. Positions
//! are therefore on a lattice that is much coarser than double precision. Its step is derived as follows:
//!
//! - If all numbers are single-precision numbers, and some have eight digits or more: single precision.
//! - Otherwise the step is the unit of the last digit of the numbers with the most digits. Whole numbers and
//!   short decimals, such as 2.5, are exact: rounding to such a coarse step would be visible in a drawing.

use std::fmt::Write;

use glam::DVec3;

use super::tolerances::{MAX_SINGLE_ERROR, MIN_VALUE_OF_LARGEST};
use crate::geometry::space::bounds::Bounds;
use crate::mesh::tolerances::MAX_ROUNDED_STEP_OF_SIZE;
use crate::scene::{Geometry, Scene};

/// Maximum number of positions of a file that are measured, evenly spread.
const MAX_SAMPLES: usize = 1024;

/// Minimum digits that indicate single precision. Almost every number of seven digits is the shortest text of
/// some `f32`.
const MIN_SINGLE_DIGITS: i32 = 8;

/// Minimum digits that indicate double precision.
const MIN_DOUBLE_DIGITS: i32 = 15;

/// Stores the measured precision in each geometry of a scene.
pub(crate) fn measure(scene: &mut Scene) {
    let is_open = |geometry: &Geometry| !geometry.single_precision && geometry.lattice_step == 0.0;
    let count: usize = scene.geometries.iter().filter(|g| is_open(g)).map(|g| g.positions.len()).sum();
    let every = count.div_ceil(MAX_SAMPLES).max(1);
    let positions = scene.geometries.iter().filter(|g| is_open(g)).flat_map(|g| &g.positions);
    let samples: Vec<DVec3> = positions.step_by(every).copied().filter(|p| p.is_finite()).collect();
    let precision = Precision::of(&samples);
    for geometry in scene.geometries.iter_mut().filter(|g| is_open(g)) {
        match precision {
            Precision::Exact => {}
            Precision::Single => geometry.single_precision = true,
            Precision::Decimals(step) => geometry.lattice_step = step,
        }
    }
}

/// Precision of the numbers of a file.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Precision {
    /// Whole numbers, short decimals, or double precision.
    Exact,
    /// Single precision.
    Single,
    /// Decimals with this unit.
    Decimals(f64),
}

impl Precision {
    fn of(positions: &[DVec3]) -> Self {
        let numbers = || positions.iter().flat_map(|p| p.to_array());
        let largest = numbers().fold(0.0_f64, |most, x| most.max(x.abs()));
        let all = || numbers().filter(|x| x.abs() > MIN_VALUE_OF_LARGEST * largest);
        let mut text = String::new();
        let mut most_digits = 0;
        let mut step: f64 = 0.0;
        for number in all() {
            let (digits, unit) = digits(number, &mut text);
            if digits > most_digits {
                (most_digits, step) = (digits, unit);
            } else if digits == most_digits {
                step = step.max(unit);
            }
        }
        if most_digits >= MIN_SINGLE_DIGITS && all().all(is_single) {
            return Self::Single;
        }
        if most_digits >= MIN_DOUBLE_DIGITS {
            return Self::Exact;
        }
        let size = Bounds::of(positions.iter().copied()).diagonal();
        if step > 0.0 && step <= MAX_ROUNDED_STEP_OF_SIZE * size { Self::Decimals(step) } else { Self::Exact }
    }
}

/// Whether a number represents an `f32`: it has at least nine digits of one, or its shortest unique digits.
fn is_single(number: f64) -> bool {
    let single = number as f32;
    (number - f64::from(single)).abs() <= MAX_SINGLE_ERROR * number.abs()
        || single.to_string().parse() == Ok(number)
}

/// Number of digits of a number, and the unit of the last one.
fn digits(number: f64, text: &mut String) -> (i32, f64) {
    text.clear();
    // Shortest digits that read back as the number. Writing to a string cannot fail.
    let _ = write!(text, "{:e}", number.abs());
    let (mantissa, exponent) = text.split_once('e').unwrap_or((text.as_str(), "0"));
    let digits = mantissa.bytes().filter(u8::is_ascii_digit).count() as i32;
    let exponent: i32 = exponent.parse().unwrap_or(0);
    text.clear();
    let _ = write!(text, "1e{}", exponent + 1 - digits);
    (digits, text.parse().unwrap_or(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::dice::Dice;

    fn precision_of_written(size: f64, write: impl Fn(f64) -> f64) -> Precision {
        let mut dice = Dice::new(5);
        let points: Vec<DVec3> = (0..300).map(|_| (dice.point(size)).to_array().map(&write).into()).collect();
        Precision::of(&points)
    }

    fn round_to_decimals(places: usize) -> impl Fn(f64) -> f64 {
        move |x| format!("{x:.places$}").parse().unwrap()
    }

    #[test]
    fn coordinate_precision_matches_how_numbers_were_written() {
        assert_eq!(precision_of_written(20.0, |x| f64::from(x as f32)), Precision::Single);
        // C's %.9g, and the shortest digits of an `f32`.
        assert_eq!(
            precision_of_written(20.0, |x| format!("{:.8e}", x as f32).parse().unwrap()),
            Precision::Single
        );
        assert_eq!(
            precision_of_written(20.0, |x| (x as f32).to_string().parse().unwrap()),
            Precision::Single
        );
        let step = |precision| match precision {
            Precision::Decimals(step) => step,
            other => panic!("{other:?}"),
        };
        for (decimals, unit) in [(4, 1e-4), (5, 1e-5), (9, 1e-9)] {
            let measured_step = step(precision_of_written(20.0, round_to_decimals(decimals)));
            assert!((measured_step / unit - 1.0).abs() < 1e-9, "{decimals}: {measured_step}");
        }
        let measured_step = step(precision_of_written(9.0, round_to_decimals(6)));
        assert!((measured_step / 1e-6 - 1.0).abs() < 1e-9, "{measured_step}");
        // Eight digits have the precision of an `f32`, so both results are valid.
        assert!(matches!(
            precision_of_written(20.0, round_to_decimals(6)),
            Precision::Single | Precision::Decimals(_)
        ));
        // Six digits, C's %g, of numbers up to 20.
        let measured_step = step(precision_of_written(20.0, |x| format!("{x:.5e}").parse().unwrap()));
        assert!((measured_step / 1e-4 - 1.0).abs() < 1e-9, "{measured_step}");
        assert_eq!(precision_of_written(20.0, |x| x), Precision::Exact);
        // Quarters are exact, and so are whole numbers of a small range.
        assert_eq!(precision_of_written(20.0, |x| (4.0 * x).round() / 4.0), Precision::Exact);
        assert_eq!(precision_of_written(20.0, |x| x.round()), Precision::Exact);
        assert_eq!(Precision::of(&[]), Precision::Exact);
    }

    #[test]
    fn coordinate_precision_ignores_noise_near_zero() {
        let exact = |x: f64| if x.abs() < 10.0 { 1.224_646_799_147_353_2e-16 } else { x.round() };
        assert_eq!(precision_of_written(20.0, exact), Precision::Exact);
    }
}
