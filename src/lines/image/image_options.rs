//! How lines are found in the image: the `[lines.image]` table of a style sheet.

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize};

/// Where lines are sought.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Source {
    /// On the surface: exact.
    #[default]
    Object,
    /// In maps of normals and depth: what jumps from pixel to pixel, whatever the mesh is like.
    Image,
    /// On the surface, and in the image where the surface has none.
    Both,
}

/// What makes a pixel of the maps an edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum EdgeTest {
    /// How much the gradients of depth and normals change around it (Scheelk, section 3.4).
    #[default]
    Gradient,
    /// How much the pixels on opposite sides of it differ (Ishaya, listing 4).
    Opposite,
}

/// How lines in a picture of edges are made wider (Ishaya, listing 5).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Dilation {
    /// Any of four neighbours makes a pixel ink.
    #[default]
    Plain,
    /// Each of four neighbours gives a pixel half of its ink.
    Smooth,
}

/// How lines are found in the image. The thresholds are those of the papers.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ImageOptions {
    /// What makes a pixel an edge. Default: gradient.
    pub test: EdgeTest,
    /// Pixels of the maps a px of the drawing, 1 to 8; no more than make 4096 along the longer side. Default: 2.
    #[serde(deserialize_with = "samples")]
    pub samples: f64,
    /// Scheelk's k of depth: smaller draws more. Default: 0.003.
    #[serde(deserialize_with = "positive")]
    pub gradient_depth: f64,
    /// Scheelk's k of normals: smaller draws more. Default: 0.0125.
    #[serde(deserialize_with = "positive")]
    pub gradient_normal: f64,
    /// What a pixel must reach of both together, 0 to 2. Default: 0.75.
    #[serde(deserialize_with = "positive")]
    pub gradient_least: f64,
    /// Ishaya's threshold for depth: larger draws more. Default: 0.25.
    #[serde(deserialize_with = "positive")]
    pub opposite_depth: f64,
    /// Ishaya's threshold for the cosine of normals: larger draws more. Default: 0.9.
    #[serde(deserialize_with = "positive")]
    pub opposite_normal: f64,
    /// How much of that threshold is taken off where depth is 1, so that what is far away does not fill with lines.
    /// Default: 0.25.
    #[serde(deserialize_with = "positive")]
    pub opposite_far: f64,
    /// Draw lines between parts and between materials also where the test sees none, as between faces in one plane. Default: true.
    pub parts: bool,
    /// How many times the lines of `edges.png` are made wider. Default: 0.
    pub passes: u8,
    /// How they are made wider. Default: plain.
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

/// A number above 0.
fn positive<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    let value = f64::deserialize(deserializer)?;
    if value > 0.0 && value <= 100.0 {
        Ok(value)
    } else {
        Err(D::Error::custom(format!("{value} is not a threshold; write a number above 0, at most 100")))
    }
}

/// Pixels a px.
fn samples<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    let value = f64::deserialize(deserializer)?;
    if (1.0..=8.0).contains(&value) {
        Ok(value)
    } else {
        Err(D::Error::custom(format!("{value} pixels per px are not possible; write a number from 1 to 8")))
    }
}
