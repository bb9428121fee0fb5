//! Options for textures: part of the `[fills]` table of a style sheet.

use serde::{Deserialize, Serialize};

/// How the texture of a base colour is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub(crate) enum TextureFill {
    /// As regions of a few colours, with the borders of the picture.
    #[default]
    Regions,
    /// In its mean colour.
    Mean,
    /// As an embedded picture.
    Image,
    /// Not at all: in the colour of the material.
    Off,
}

/// Options for drawing textures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TextureOptions {
    /// How textures are drawn. Default: regions.
    pub fill: TextureFill,
    /// Maximum number of colours for a picture that is not a palette. Default: 6.
    pub colours: usize,
    /// Maximum texels per px of an embedded picture; never more than its file has. Default: 1.5.
    pub samples: f64,
}

impl Default for TextureOptions {
    fn default() -> Self {
        Self { fill: TextureFill::Regions, colours: 6, samples: 1.5 }
    }
}
