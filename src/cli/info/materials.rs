//! [`MaterialInfo`]: colour, texture and opacity of a material.

use serde::Serialize;

use super::text_lists::named;
use crate::cli::output::number_text::plain;
use crate::colour::srgb::Colour;
use crate::scene::textures::picture_of;
use crate::scene::{Alpha, Material, Scene};

/// Colour, texture and opacity of a material.
#[derive(Debug, Serialize)]
pub(crate) struct MaterialInfo {
    name: String,
    colour: Colour,
    texture: Option<String>,
    /// Width and height of the texture in pixels, if it can be read. Includes textures embedded in the model
    /// file.
    #[serde(skip_serializing_if = "Option::is_none")]
    texture_size: Option<[usize; 2]>,
    /// `opaque`, `mask` or `blend`.
    alpha: &'static str,
    /// Opacity from 0 to 1, if below 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    opacity: Option<f64>,
    /// Minimum alpha that a mask keeps.
    #[serde(skip_serializing_if = "Option::is_none")]
    cutoff: Option<f32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    opacity_map: Option<String>,
}

impl MaterialInfo {
    /// Describes a material of a scene.
    pub(crate) fn of(scene: &Scene, material: &Material) -> Self {
        let (alpha, cutoff) = match material.alpha {
            Alpha::Mask { cutoff } => ("mask", Some(cutoff)),
            Alpha::Blend => ("blend", None),
            Alpha::Opaque => ("opaque", None),
        };
        Self {
            name: material.name.clone(),
            colour: material.colour,
            texture: material.texture.clone(),
            texture_size: picture_of(scene, material)
                .and_then(Result::ok)
                .map(|picture| [picture.width, picture.height]),
            alpha,
            opacity: Some(material.opacity()).filter(|own| *own < 1.0),
            cutoff,
            opacity_map: material.opacity_map.clone(),
        }
    }

    /// Entry of the material in the text.
    pub(crate) fn line(&self) -> String {
        let texture = match (&self.texture, self.texture_size) {
            (Some(file), Some([width, height])) => format!(", texture {file}, {width} x {height} px"),
            (Some(file), None) => format!(", texture {file}"),
            (None, Some([width, height])) => format!(", texture inside the file, {width} x {height} px"),
            (None, None) => String::new(),
        };
        let alpha = match (self.alpha, self.cutoff) {
            (_, Some(cutoff)) => format!(", cut out below alpha {cutoff}"),
            ("blend", _) => ", blended".to_owned(),
            _ => String::new(),
        };
        let clear = self.opacity.map_or(String::new(), |own| format!(", {} % opaque", plain(own * 100.0, 0)));
        let map = self.opacity_map.as_ref().map_or(String::new(), |file| format!(", cut out by {file}"));
        format!("{}: {}{texture}{alpha}{clear}{map}", named(&self.name), String::from(self.colour))
    }
}
