//! [`Factors`]: the values of a material as a file stores them, from which those of a drawing follow.

use crate::colour::srgb::Colour;
use crate::scene::material::Gloss;
use crate::scene::{Alpha, Material};

/// The values of a material as a file stores them: what is drawn of them may follow from several.
///
/// Source: Khronos Group, glTF 2.0 specification, sections 3.9.2 and 3.9.4.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Factors {
    /// Its base colour and how opaque it is, linear.
    pub base: [f32; 4],
    /// The light of its own, linear; none where a picture says where it shines.
    pub emissive: Option<[f32; 3]>,
    /// What becomes of alpha.
    pub mode: AlphaMode,
    /// The least alpha that is not cut away.
    pub cutoff: f32,
    /// How rough it is, if its file says so.
    pub roughness: Option<f32>,
    /// How much light goes through it.
    pub transmission: f32,
}

/// What becomes of alpha.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum AlphaMode {
    /// It says nothing.
    #[default]
    Opaque,
    /// What has less than the cutoff is cut away.
    Mask,
    /// The surface is as opaque as it says.
    Blend,
}

impl Factors {
    /// Gives a material what follows from them, and leaves it all else.
    pub fn give(&self, material: &mut Material) {
        let [r, g, b, _] = self.base;
        material.colour = Colour::from_linear([r, g, b, self.opacity()]);
        // What is lit from within by a picture is dark elsewhere, and a picture of lights is not read.
        let [r, g, b] = self.emissive.unwrap_or_default();
        material.emissive = Colour::from_linear([r, g, b, 1.0]);
        material.alpha = self.alpha();
        material.gloss = self.roughness.map(gloss);
        material.transmission = self.transmission.clamp(0.0, 1.0);
    }

    fn opacity(&self) -> f32 {
        match self.mode {
            AlphaMode::Blend => self.base[3],
            AlphaMode::Mask if self.base[3] < self.cutoff => 0.0,
            AlphaMode::Mask | AlphaMode::Opaque => 1.0,
        }
    }

    fn alpha(&self) -> Alpha {
        match self.mode {
            AlphaMode::Blend => Alpha::Blend,
            // The texture is multiplied by the factor before it is compared; nothing is less than nothing.
            AlphaMode::Mask if self.cutoff <= 0.0 => Alpha::Opaque,
            AlphaMode::Mask => Alpha::Mask { cutoff: self.cutoff / self.base[3] },
            AlphaMode::Opaque => Alpha::Opaque,
        }
    }
}

/// How a material shines that is so rough: as Blinn-Phong has it.
fn gloss(roughness: f32) -> Gloss {
    let roughness = roughness.clamp(0.0, 1.0);
    let exponent = (2.0 / roughness.max(0.1).powi(4) - 2.0).max(1.0);
    Gloss { exponent, strength: 1.0 - roughness }
}
