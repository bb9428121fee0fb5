//! Materials, reduced to what a drawing needs.

use std::sync::Arc;

use crate::colour::srgb::Colour;

/// Appearance of a surface.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Name in the file; may be empty.
    pub name: String,
    /// Base (diffuse) colour, sRGB.
    pub colour: Colour,
    /// Emitted light, sRGB.
    pub emissive: Colour,
    /// Whether both sides are visible according to the file. ligne always draws both sides; kept for shading.
    pub double_sided: bool,
    /// Path of the base-colour texture relative to the model, if it is a file.
    pub texture: Option<String>,
    /// Encoded base-colour texture, if it is inside the model's file.
    pub picture: Option<Arc<[u8]>>,
    /// Interpretation of the alpha of base colour and texture.
    pub alpha: Alpha,
    /// Gloss, if the file gives it.
    pub gloss: Option<Gloss>,
    /// Share of light that is transmitted, 0 to 1, in addition to the alpha.
    pub transmission: f32,
    /// Path of an opacity map relative to the model (`map_d` in MTL).
    pub opacity_map: Option<String>,
    /// Wrapping of the texture along u and along v.
    pub wrap: [Wrap; 2],
    /// Interpolation between the texels of the texture.
    pub filter: Filter,
    /// Scale and offset of texture coordinates (`-s` and `-o` in MTL).
    pub placing: Placing,
}

/// Scale and offset of texture coordinates: the texture is sampled at (u, v) · scale + offset.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placing {
    /// Repetitions along u and along v per unit of the original coordinates.
    pub scale: [f32; 2],
    /// Offset in units of the texture.
    pub offset: [f32; 2],
}

impl Default for Placing {
    fn default() -> Self {
        Self { scale: [1.0; 2], offset: [0.0; 2] }
    }
}

/// Highlights of a material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gloss {
    /// Blinn-Phong exponent: `Ns` of MTL, or 2/r⁴ − 2 for a glTF roughness r.
    pub exponent: f32,
    /// Strength, 0 to 1: greatest channel of `Ks` in MTL, or 1 − roughness in glTF.
    pub strength: f32,
}

/// Interpretation of alpha.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub enum Alpha {
    /// Alpha is ignored.
    #[default]
    Opaque,
    /// Surface with texture alpha below the cutoff is removed.
    Mask {
        /// Minimum texture alpha that remains, 0 to 1.
        cutoff: f32,
    },
    /// Alpha is the opacity of the surface. If parts of the texture are fully transparent, as between leaves,
    /// surface below half the maximum alpha is removed.
    Blend,
}

/// Continuation of a texture outside its borders.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[non_exhaustive]
pub enum Wrap {
    /// Repeats from the start.
    #[default]
    Repeat,
    /// Repeats the border texel.
    Clamp,
    /// Alternates between forward and mirrored.
    Mirror,
}

/// Interpolation between the texels of a texture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[non_exhaustive]
pub enum Filter {
    /// Bilinear.
    #[default]
    Smooth,
    /// Nearest texel: each texel is a block of one colour.
    Blocks,
}

impl Default for Material {
    fn default() -> Self {
        Self {
            name: String::new(),
            colour: Colour::rgb(204, 204, 204),
            emissive: Colour::BLACK,
            double_sided: false,
            texture: None,
            picture: None,
            alpha: Alpha::Opaque,
            gloss: None,
            transmission: 0.0,
            opacity_map: None,
            wrap: [Wrap::Repeat; 2],
            filter: Filter::Smooth,
            placing: Placing::default(),
        }
    }
}
