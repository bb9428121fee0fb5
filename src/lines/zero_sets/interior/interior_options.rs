//! Which interior lines are drawn: the `[lines.inside]` table of a style sheet.

use serde::{Deserialize, Deserializer, Serialize};

use crate::geometry::numbers::checked_number::checked;

/// How interior lines are found. Thresholds are relative: those of ridges and valleys to the inverse feature
/// size, those of suggestive contours and apparent ridges to its square.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct InsideOptions {
    /// Smoothing length of the normals, in fortieths of the model's size. Default: 0.3.
    #[serde(deserialize_with = "positive")]
    pub smooth: f64,
    /// Smallest change of radial curvature across a suggestive contour. Default: 0.01.
    #[serde(deserialize_with = "positive")]
    pub suggestive: f64,
    /// Find suggestive highlights too; their kind is `suggestive`. Default: false.
    pub highlights: bool,
    /// Smallest change of radial curvature across a suggestive highlight. Default: 0.02.
    #[serde(deserialize_with = "positive")]
    pub highlight: f64,
    /// Smallest curvature of a ridge. Default: 0.1.
    #[serde(deserialize_with = "positive")]
    pub ridge: f64,
    /// Smallest curvature of a valley. Default: 0.1.
    #[serde(deserialize_with = "positive")]
    pub valley: f64,
    /// Find apparent (view-dependent) ridges in place of ridges. Default: false.
    pub apparent: bool,
    /// Smallest square of the curvature of an apparent ridge. Default: 0.1.
    #[serde(deserialize_with = "positive")]
    pub apparent_ridge: f64,
}

impl Default for InsideOptions {
    fn default() -> Self {
        Self {
            smooth: 0.3,
            suggestive: 0.01,
            highlights: false,
            highlight: 0.02,
            ridge: 0.1,
            valley: 0.1,
            apparent: false,
            apparent_ridge: 0.1,
        }
    }
}

/// Reads a number that is not negative.
fn positive<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    let advice = "is not a threshold; write 0 or a number above it";
    checked(deserializer, |value| value >= 0.0 && value.is_finite(), advice)
}
