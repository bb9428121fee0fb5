//! How the pictures of materials are painted: part of the `[fills]` table of a style sheet.

use serde::{Deserialize, Serialize};

/// What becomes of the picture of a base colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum TextureFill {
    /// Regions of a few colours, with the borders that the picture has.
    #[default]
    Regions,
    /// Its mean colour.
    Mean,
    /// The picture itself.
    Image,
    /// Nothing: the colour of the material.
    Off,
}

/// How the pictures of materials are painted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TextureOptions {
    /// What becomes of a picture. Default: regions.
    pub fill: TextureFill,
    /// Into how many colours a picture falls, at most, unless it is a palette. Default: 6.
    pub colours: usize,
    /// How many texels of a picture that is put into the drawing itself are kept along a px, at most; it has never more
    /// than its file. Default: 1.5.
    pub samples: f64,
}

impl Default for TextureOptions {
    fn default() -> Self {
        Self { fill: TextureFill::Regions, colours: 6, samples: 1.5 }
    }
}
