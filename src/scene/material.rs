//! Materials, as far as a drawing needs them.

use std::sync::Arc;

use crate::math::colour::Colour;

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
        }
    }
}
