//! The unit of length that the numbers of a model count.

use clap::ValueEnum;

use crate::cli::output::number_text::plain;
use crate::scene::Scene;

/// What a unit of the model is.
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

/// Models of which the longest side is shorter or longer than this, mm, are seldom meant so.
const SHORTEST_MM: f64 = 1.0;
const LONGEST_MM: f64 = 10_000.0;
const LONGEST_METRES: f64 = 1_000.0;

impl ModelUnit {
    /// Millimetres in it.
    pub(crate) const fn mm(self) -> f64 {
        match self {
            Self::Mm => 1.0,
            Self::Cm => 10.0,
            Self::M => 1000.0,
            Self::In => 25.4,
            Self::Ft => 304.8,
        }
    }

    /// How it is written.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Mm => "mm",
            Self::Cm => "cm",
            Self::M => "m",
            Self::In => "in",
            Self::Ft => "ft",
        }
    }

    /// The unit of a scene: the one that is given, else that of its format. glTF demands metres; the other formats leave it open, and CAD
    /// programs write millimetres.
    pub(crate) fn of(scene: &Scene, given: Option<Self>) -> Self {
        given.unwrap_or(if is_in_metres(scene) { Self::M } else { Self::Mm })
    }
}

/// Whether the unit of a scene is known without asking: glTF demands metres, and converters of STEP return millimetres.
pub(crate) fn is_stated(scene: &Scene) -> bool {
    scene.format == "STEP" || is_in_metres(scene)
}

/// Whether the format of a scene demands metres.
fn is_in_metres(scene: &Scene) -> bool {
    scene.format == "glTF"
}

/// What to wonder about a model whose longest side is `longest`, in its own numbers, where nobody said in which unit it is.
pub(crate) fn doubt(scene: &Scene, longest: f64) -> Option<String> {
    let number = |value: f64| plain(value, if value < 1.0 { 4 } else { 1 });
    let long = number(longest);
    if !(longest.is_finite() && longest > 0.0) {
        return None;
    }
    if scene.format == "STEP" {
        // The converter has read the unit of the file.
        return None;
    }
    if is_in_metres(scene) {
        return (longest > LONGEST_METRES).then(|| {
            let metres = number(longest / 1000.0);
            format!("the model is {long} m long, as glTF uses metres; if its numbers are mm, it is {metres} m long: --unit mm")
        });
    }
    let counted = "the file does not store its unit";
    if longest < SHORTEST_MM {
        let (mm, inches) = (number(longest * 1000.0), number(longest * ModelUnit::In.mm()));
        Some(format!(
            "{counted}; in mm the model is only {long} mm long, in metres {mm} mm (--unit m), in inches {inches} mm (--unit in)"
        ))
    } else if longest > LONGEST_MM {
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

    fn doubted(format: &'static str, longest: f64) -> Option<String> {
        doubt(&Scene { format, ..Scene::default() }, longest)
    }

    #[test]
    fn lengths_that_nobody_means_are_doubted() {
        for (format, longest) in [("OBJ", 0.2), ("STL", 20_000.0), ("PLY", 1e-5), ("glTF", 20_000.0)] {
            assert!(doubted(format, longest).is_some(), "{format} {longest}");
        }
        for (format, longest) in
            [("OBJ", 1.0), ("STL", 300.0), ("PLY", 10_000.0), ("glTF", 0.2), ("OBJ", 0.0)]
        {
            assert_eq!(doubted(format, longest), None, "{format} {longest}");
        }
        let text = doubted("OBJ", 0.2).unwrap();
        assert!(text.contains("200 mm (--unit m)") && text.contains("5.1 mm (--unit in)"), "{text}");
    }
}
