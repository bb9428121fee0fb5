//! Materials, as far as a drawing needs them.

use std::sync::Arc;

use crate::colour::srgb::Colour;

/// How a surface looks.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Name in the file; may be empty.
    pub name: String,
    /// Base (diffuse) colour, sRGB.
    pub colour: Colour,
    /// Light of its own, sRGB.
    pub emissive: Colour,
    /// Whether the file asks for both sides to be seen. ligne draws both sides always; kept for
    /// shading.
    pub double_sided: bool,
    /// Path of the base-colour texture relative to the model, if it is a file.
    pub texture: Option<String>,
    /// The base-colour texture, still encoded, if it is inside the model's file.
    pub picture: Option<Arc<[u8]>>,
    /// What becomes of the alpha of the base colour and of its texture.
    pub alpha: Alpha,
    /// How it shines, if its file says so.
    pub gloss: Option<Gloss>,
    /// How much light goes through it, 0 to 1, beside what its alpha says.
    pub transmission: f32,
    /// Path of a picture that says how opaque the material is, relative to the model (`map_d` in MTL).
    pub opacity_map: Option<String>,
    /// How the texture goes on beyond its borders, along u and along v.
    pub wrap: [Wrap; 2],
    /// What is between the texels of the texture.
    pub filter: Filter,
    /// Where the texture lies on its coordinates (`-s` and `-o` in MTL).
    pub placing: Placing,
}

/// Where a texture lies on its coordinates: it is looked up at (u, v) · scale + offset.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placing {
    /// How often it comes along u and along v where it came once.
    pub scale: [f32; 2],
    /// By how much it is shifted back, as parts of it.
    pub offset: [f32; 2],
}

impl Default for Placing {
    fn default() -> Self {
        Self { scale: [1.0; 2], offset: [0.0; 2] }
    }
}

/// How a material shines, by its file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gloss {
    /// The exponent of its highlights (Blinn-Phong): `Ns` of MTL; of a roughness r in glTF 2/r⁴ − 2.
    pub exponent: f32,
    /// How strong they are, 0 to 1: the greatest channel of `Ks` in MTL, 1 − roughness in glTF.
    pub strength: f32,
}

/// What becomes of alpha.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub enum Alpha {
    /// It says nothing.
    #[default]
    Opaque,
    /// What of the texture has less is cut away.
    Mask {
        /// The least alpha of the texture that is left, 0 to 1.
        cutoff: f32,
    },
    /// The surface is as opaque as it says. Where some of the texture is wholly clear, as between leaves, what has less than
    /// half of its most is cut away.
    Blend,
}

/// How a texture goes on beyond its borders.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[non_exhaustive]
pub enum Wrap {
    /// It begins again.
    #[default]
    Repeat,
    /// Its border goes on.
    Clamp,
    /// It goes back and forth.
    Mirror,
}

/// What is between the texels of a texture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[non_exhaustive]
pub enum Filter {
    /// They pass into each other.
    #[default]
    Smooth,
    /// Nothing: each is a block of one colour.
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
