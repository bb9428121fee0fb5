//! How lines are found in the image: the `[lines.image]` table of a style sheet.

use serde::{Deserialize, Deserializer, Serialize};

use crate::geometry::numbers::checked_number::checked;

/// Where lines are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Source {
    /// On the surface, exactly.
    #[default]
    Object,
    /// In maps of normals and depth, for any mesh.
    Image,
    /// On the surface, and in the image where the surface has none.
    Both,
}

/// Test for edge pixels of the maps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum EdgeTest {
    /// Change of the gradients of depth and normals (Scheelk, section 3.4).
    #[default]
    Gradient,
    /// Difference of the pixels on opposite sides (Ishaya, listing 4).
    Opposite,
}

/// How lines in an edge image are widened (Ishaya, listing 5).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Dilation {
    /// A pixel becomes ink if any of its four neighbours is.
    #[default]
    Plain,
    /// A pixel gets half the ink of each of its four neighbours.
    Smooth,
}

/// How lines are found in the image. The default thresholds are those of the papers.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct ImageOptions {
    /// Test for edge pixels. Default: gradient.
    pub test: EdgeTest,
    /// Map pixels per px of the drawing, 1 to 8, with at most 4096 along the longer side. Default: 2.
    #[serde(deserialize_with = "samples")]
    pub samples: f64,
    /// Scheelk's k for depth; smaller values draw more. Default: 0.003.
    #[serde(deserialize_with = "positive")]
    pub gradient_depth: f64,
    /// Scheelk's k for normals; smaller values draw more. Default: 0.0125.
    #[serde(deserialize_with = "positive")]
    pub gradient_normal: f64,
    /// Threshold for the sum of both tests, 0 to 2. Default: 0.75.
    #[serde(deserialize_with = "positive")]
    pub gradient_least: f64,
    /// Ishaya's threshold for depth; larger values draw more. Default: 0.25.
    #[serde(deserialize_with = "positive")]
    pub opposite_depth: f64,
    /// Ishaya's threshold for the cosine of normals; larger values draw more. Default: 0.9.
    #[serde(deserialize_with = "positive")]
    pub opposite_normal: f64,
    /// Reduction of that threshold at depth 1, so that distant parts do not fill with lines. Default: 0.25.
    #[serde(deserialize_with = "positive")]
    pub opposite_far: f64,
    /// Draw lines between parts and between materials even where the test finds none, as in one plane.
    /// Default: true.
    pub parts: bool,
    /// Number of passes that widen the lines of `edges.png`. Default: 0.
    pub passes: u8,
    /// How lines are widened. Default: plain.
    pub dilation: Dilation,
}

impl Default for ImageOptions {
    fn default() -> Self {
        Self {
            test: EdgeTest::Gradient,
            samples: 2.0,
            gradient_depth: 0.003,
            gradient_normal: 0.0125,
            gradient_least: 0.75,
            opposite_depth: 0.25,
            opposite_normal: 0.9,
            opposite_far: 0.25,
            parts: true,
            passes: 0,
            dilation: Dilation::Plain,
        }
    }
}

/// Reads a number above 0, at most 100.
fn positive<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    let advice = "is not a threshold; write a number above 0, at most 100";
    checked(deserializer, |value| value > 0.0 && value <= 100.0, advice)
}

/// Reads a number from 1 to 8.
fn samples<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    let advice = "pixels per px are not possible; write a number from 1 to 8";
    checked(deserializer, |value| (1.0..=8.0).contains(&value), advice)
}
