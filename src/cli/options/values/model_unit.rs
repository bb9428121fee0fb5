//! Unit of length of a model.

use clap::ValueEnum;

use crate::cli::output::number_text::plain;
use crate::geometry::numbers::length_units::LENGTH_UNITS_MM;
use crate::scene::Scene;

/// Unit of length of a model, in the order of [`LENGTH_UNITS_MM`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum ModelUnit {
    /// Millimetres
    Mm,
    /// Centimetres
    Cm,
    /// Metres
    M,
    /// Inches
    In,
    /// Feet
    Ft,
}

/// Plausible range of the longest side of a model without a stated unit, mm, and maximum for glTF, metres.
const MIN_PLAUSIBLE_MM: f64 = 1.0;
const MAX_PLAUSIBLE_MM: f64 = 10_000.0;
const MAX_PLAUSIBLE_M: f64 = 1_000.0;

impl ModelUnit {
    /// Length of the unit in mm.
    pub(crate) const fn mm(self) -> f64 {
        LENGTH_UNITS_MM[self as usize].1
    }

    /// Abbreviation of the unit.
    pub(crate) const fn name(self) -> &'static str {
        LENGTH_UNITS_MM[self as usize].0
    }

    /// Unit of a scene: the given one, or the unit of its format. glTF requires metres. The other formats
    /// define no unit, and CAD programs write millimetres.
    pub(crate) fn of(scene: &Scene, given: Option<Self>) -> Self {
        given.unwrap_or(if is_in_metres(scene) { Self::M } else { Self::Mm })
    }
}

/// Whether the unit of a scene is defined: glTF requires metres, and STEP converters return millimetres.
pub(crate) fn is_stated(scene: &Scene) -> bool {
    scene.format == "STEP" || is_in_metres(scene)
}

/// Whether the format of a scene requires metres.
fn is_in_metres(scene: &Scene) -> bool {
    scene.format == "glTF"
}

/// Warning about a model of implausible size. `longest` is its longest side in model units. For models
/// without a given unit.
pub(crate) fn implausible_size(scene: &Scene, longest: f64) -> Option<String> {
    let number = |value: f64| plain(value, if value < 1.0 { 4 } else { 1 });
    let long = number(longest);
    if !(longest.is_finite() && longest > 0.0) {
        return None;
    }
    if scene.format == "STEP" {
        // The converter reads the unit from the file.
        return None;
    }
    if is_in_metres(scene) {
        return (longest > MAX_PLAUSIBLE_M).then(|| {
            let metres = number(longest / 1000.0);
            format!("the model is {long} m long, as glTF uses metres; if its numbers are mm, it is {metres} m long: --unit mm")
        });
    }
    let counted = "the file does not store its unit";
    if longest < MIN_PLAUSIBLE_MM {
        let (mm, inches) = (number(longest * 1000.0), number(longest * ModelUnit::In.mm()));
        Some(format!(
            "{counted}; in mm the model is only {long} mm long, in metres {mm} mm (--unit m), in inches {inches} mm (--unit in)"
        ))
    } else if longest > MAX_PLAUSIBLE_MM {
        let metres = number(longest / 1000.0);
        Some(format!(
            "{counted}; in mm the model is {metres} m long; if that is too long, its unit is smaller"
        ))
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn size_warning(format: &'static str, longest: f64) -> Option<String> {
        implausible_size(&Scene { format, ..Scene::default() }, longest)
    }

    #[test]
    fn implausible_size_warns_about_unlikely_model_lengths() {
        for (format, longest) in [("OBJ", 0.2), ("STL", 20_000.0), ("PLY", 1e-5), ("glTF", 20_000.0)] {
            assert!(size_warning(format, longest).is_some(), "{format} {longest}");
        }
        for (format, longest) in
            [("OBJ", 1.0), ("STL", 300.0), ("PLY", 10_000.0), ("glTF", 0.2), ("OBJ", 0.0)]
        {
            assert_eq!(size_warning(format, longest), None, "{format} {longest}");
        }
        let text = size_warning("OBJ", 0.2).unwrap();
        assert!(text.contains("200 mm (--unit m)") && text.contains("5.1 mm (--unit in)"), "{text}");
    }
}
