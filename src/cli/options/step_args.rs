//! [`StepArgs`]: options of STEP files.

use clap::Args;

use crate::cli::tolerances;
use crate::drawing::{Length, Unit};

/// Default linear tolerance, mm: a third of a 0.35 mm pen at 1:1.
const DEFAULT_TOLERANCE_MM: f64 = 0.1;

/// Radius, mm, whose number of facets all smaller circles keep. Source: measured on parts of 50 to 150 mm;
/// table in `docs/how-to/import.md`.
const MIN_SMOOTH_RADIUS_MM: f64 = 20.0;

/// Limits of the angle between neighbouring facets, radians.
const MIN_FACET_ANGLE_RAD: f64 = 0.05;
const MAX_FACET_ANGLE_RAD: f64 = 0.5;

/// How models in STEP files (.step, .stp) are converted to triangles.
#[derive(Debug, Clone, Default, Args)]
pub(crate) struct StepArgs {
    /// Converter of STEP models: a name, or PROGRAM IN.step OUT.glb MM [default: first found] [env: LIGNE_STEP_CONVERTER]
    #[arg(long, value_name = "PROGRAM", help_heading = "STEP", value_parser = program)]
    step_converter: Option<String>,

    /// Largest distance between a STEP model and its triangles [default: 0.1mm]
    #[arg(long, value_name = "LENGTH", help_heading = "STEP", value_parser = tolerance)]
    step_tolerance: Option<f64>,
}

/// Environment variable that names a converter.
const CONVERTER_VARIABLE: &str = "LIGNE_STEP_CONVERTER";

impl StepArgs {
    /// Converter from the option or the variable. The variable is read here too, because cases under test
    /// have no call to extend.
    pub(crate) fn converter(&self) -> Option<String> {
        self.step_converter
            .clone()
            .or_else(|| std::env::var(CONVERTER_VARIABLE).ok().filter(|name| !name.is_empty()))
    }

    /// Maximum distance between surface and triangles, mm.
    pub(crate) fn tolerance_mm(&self) -> f64 {
        self.step_tolerance.unwrap_or(DEFAULT_TOLERANCE_MM)
    }

    /// Maximum angle between neighbouring facets, radians: that of a circle of [`MIN_SMOOTH_RADIUS_MM`] at
    /// this tolerance. Small holes and fillets stay round, where the tolerance alone would allow few facets.
    pub(crate) fn angle(&self) -> f64 {
        // The sagitta of an arc with angle a and radius R is about R a² / 8.
        (8.0 * self.tolerance_mm() / MIN_SMOOTH_RADIUS_MM)
            .sqrt()
            .clamp(MIN_FACET_ANGLE_RAD, MAX_FACET_ANGLE_RAD)
    }
}

fn program(text: &str) -> Result<String, String> {
    if text.trim().is_empty() { Err("name a program".to_owned()) } else { Ok(text.to_owned()) }
}

/// Reads `0.1mm` or `0.004in`; a bare number is in mm.
fn tolerance(text: &str) -> Result<f64, String> {
    let bare = text.trim().parse().ok();
    let with_unit =
        || Length::parse(text).filter(|length| length.unit == Unit::Mm).map(|length| length.value);
    bare.or_else(with_unit)
        .filter(|mm: &f64| tolerances::STEP_TOLERANCES_MM.contains(mm))
        .ok_or_else(|| "write a length from 0.0001mm to 1000mm, such as 0.1mm".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn step_tolerance_accepts_units_and_rejects_invalid_lengths() {
        for (text, mm) in [("0.1mm", 0.1), ("0.05", 0.05), ("0.1in", 2.54), ("1cm", 10.0)] {
            assert!((tolerance(text).unwrap() - mm).abs() < 1e-12, "{text}");
        }
        for text in ["0", "-1mm", "nan", "fine", "1e9mm", "1px", ""] {
            assert!(tolerance(text).is_err(), "{text}");
        }
    }

    #[test]
    fn facet_angle_grows_with_the_step_tolerance_within_limits() {
        let angle = |mm| StepArgs { step_tolerance: Some(mm), ..StepArgs::default() }.angle();
        assert!((StepArgs::default().angle() - 0.2).abs() < 1e-12);
        assert!(angle(0.01) < angle(0.1) && angle(0.1) < angle(1.0));
        assert_eq!((angle(1e-4), angle(1e3)), (MIN_FACET_ANGLE_RAD, MAX_FACET_ANGLE_RAD));
    }
}
