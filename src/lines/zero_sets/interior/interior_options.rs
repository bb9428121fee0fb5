//! Which lines inside are drawn: the `[lines.inside]` table of a style sheet.

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize};

/// How lines inside are found. Thresholds have no unit: those of ridges are divided by the size of
/// the model's features, those of suggestive contours and apparent ridges by its square.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct InsideOptions {
    /// Length over which normals are smoothed beforehand, in fortieths of the model's size.
    /// Default: 0.3.
    #[serde(deserialize_with = "positive")]
    pub smooth: f64,
    /// How fast radial curvature must change across a suggestive contour. Default: 0.01.
    #[serde(deserialize_with = "positive")]
    pub suggestive: f64,
    /// Seek suggestive highlights too; their kind is `suggestive`. Default: false.
    pub highlights: bool,
    /// How fast radial curvature must change across a suggestive highlight. Default: 0.02.
    #[serde(deserialize_with = "positive")]
    pub highlight: f64,
    /// The curvature a ridge must have. Default: 0.1.
    #[serde(deserialize_with = "positive")]
    pub ridge: f64,
    /// The curvature a valley must have. Default: 0.1.
    #[serde(deserialize_with = "positive")]
    pub valley: f64,
    /// Seek apparent ridges, as the view bends the surface, in place of ridges. Default: false.
    pub apparent: bool,
    /// The square of the curvature that an apparent ridge must have. Default: 0.1.
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

/// A number that is not negative.
fn positive<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    let value = f64::deserialize(deserializer)?;
    if value >= 0.0 && value.is_finite() {
        Ok(value)
    } else {
        Err(D::Error::custom(format!("{value} is not a threshold; write 0 or a number above it")))
    }
}
