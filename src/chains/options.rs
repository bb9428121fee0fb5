//! [`ChainOptions`]: how lines are linked, tidied, smoothed and fitted (the `[chain]` table of a style
//! sheet).

use serde::{Deserialize, Serialize};

use crate::drawing::{Length, Unit};

/// How lines are linked, tidied, smoothed and fitted. A length of 0 turns its step off. With all steps off, a
/// chain is exactly the projected mesh edges.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct ChainOptions {
    /// How far smoothing may move a point of a line on a smooth surface. Default: 0.5 px.
    pub smooth: Length,
    /// How far a simplified line may lie from the points that are left out. Default: 0.05 px.
    pub simplify: Length,
    /// Isolated lines shorter than this are dropped. Default: 4 px.
    pub tidy: Length,
    /// Whether lines on smooth surfaces become Bézier curves. Default: true.
    pub fit: bool,
    /// How far a fitted curve may lie from the smoothed line. Default: 0.15 px.
    pub fit_tolerance: Length,
    /// Whether corners on one circle become that circle or arc, within the rounding of the file. Applies to
    /// parallel views. Default: false.
    pub circles: bool,
}

/// How far simplifying and fitting may move a point on a page to scale, mm. Together with the lines and arcs
/// of DXF, the error stays below 0.02 mm.
const MAX_SIMPLIFY_MM: f64 = 0.002;
const MAX_FIT_MM: f64 = 0.008;

/// Minimum tolerance of refined surfaces, px. Bounds the work for styles that fit curves more closely.
const MIN_REFINEMENT_TOLERANCE_PX: f64 = 0.02;

impl ChainOptions {
    /// Tolerance of refined surfaces, in user units: the same as that of fitted curves.
    #[must_use]
    pub(crate) fn refinement_tolerance(&self, unit: Unit) -> f64 {
        let least = Length::px(MIN_REFINEMENT_TOLERANCE_PX).in_unit(unit);
        self.fit_tolerance.in_unit(unit).max(least)
    }

    /// Options for a page to scale or a DXF file: no point moves by more than 0.02 mm, and corners on one
    /// circle become arcs.
    #[must_use]
    pub(crate) fn drawn_to_scale(self) -> Self {
        let within = |length: Length, most: f64| {
            if length.in_unit(Unit::Mm) > most { Length { value: most, unit: Unit::Mm } } else { length }
        };
        Self {
            // Smoothing cuts corners by more than its tolerance.
            smooth: within(self.smooth, 0.0),
            simplify: within(self.simplify, MAX_SIMPLIFY_MM),
            fit_tolerance: within(self.fit_tolerance, MAX_FIT_MM),
            circles: true,
            ..self
        }
    }
}

impl Default for ChainOptions {
    fn default() -> Self {
        Self {
            smooth: Length::px(0.5),
            simplify: Length::px(0.05),
            tidy: Length::px(4.0),
            fit: true,
            fit_tolerance: Length::px(0.15),
            circles: false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn surfaces_are_refined_as_exactly_as_curves_are_fitted() {
        let of = |fit_tolerance: Length, unit: Unit| {
            ChainOptions { fit_tolerance, ..ChainOptions::default() }.refinement_tolerance(unit)
        };
        assert_eq!(of(Length::px(0.5), Unit::Px), 0.5);
        assert_eq!(of(Length { value: 0.1, unit: Unit::Mm }, Unit::Mm), 0.1);
        assert_eq!(of(Length::px(0.0), Unit::Px), MIN_REFINEMENT_TOLERANCE_PX);
        let to_scale = ChainOptions::default().drawn_to_scale();
        assert_eq!(to_scale.refinement_tolerance(Unit::Mm), MAX_FIT_MM);
    }
}
