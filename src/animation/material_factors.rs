//! [`MaterialFactors`]: the values of a material as stored in a file, and their conversion to a drawable material.

use crate::colour::srgb::Colour;
use crate::scene::material::Gloss;
use crate::scene::{Alpha, Material};

/// Values of a material as stored in a file.
///
/// Source: Khronos Group, glTF 2.0 specification, sections 3.9.2 and 3.9.4.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct MaterialFactors {
    /// Base colour and alpha, linear.
    pub base: [f32; 4],
    /// Emitted light, linear; `None` if a texture varies it.
    pub emissive: Option<[f32; 3]>,
    /// Interpretation of alpha.
    pub mode: AlphaMode,
    /// Alpha cutoff.
    pub cutoff: f32,
    /// Roughness, if the file gives it.
    pub roughness: Option<f32>,
    /// Transmission: share of light that passes through.
    pub transmission: f32,
}

/// Interpretation of alpha.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum AlphaMode {
    /// Alpha is ignored.
    #[default]
    Opaque,
    /// Surface with alpha below the cutoff is removed.
    Mask,
    /// Alpha is the opacity of the surface.
    Blend,
}

impl MaterialFactors {
    /// Sets the derived values of a material and leaves its other values unchanged.
    pub(crate) fn apply_to(&self, material: &mut Material) {
        let [r, g, b, _] = self.base;
        material.colour = Colour::from_linear([r, g, b, self.opacity()]);
        // Emission textures are not read. Their surfaces are mostly dark, so they emit nothing here.
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
            // Alpha is the texture times the factor, and is never negative.
            AlphaMode::Mask if self.cutoff <= 0.0 => Alpha::Opaque,
            AlphaMode::Mask => Alpha::Mask { cutoff: self.cutoff / self.base[3] },
            AlphaMode::Opaque => Alpha::Opaque,
        }
    }
}

/// Blinn-Phong gloss that corresponds to a roughness.
fn gloss(roughness: f32) -> Gloss {
    let roughness = roughness.clamp(0.0, 1.0);
    let exponent = (2.0 / roughness.max(0.1).powi(4) - 2.0).max(1.0);
    Gloss { exponent, strength: 1.0 - roughness }
}
