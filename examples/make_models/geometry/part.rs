//! A solid with a name and a material.

use glam::{DAffine3, DMat3, DVec3};

use super::solid::Solid;

/// Named material. Colour channels are sRGB, 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    pub name: &'static str,
    pub colour: [f64; 3],
    /// Metalness and roughness, 0 to 1, for formats that store them.
    pub metallic: f64,
    pub roughness: f64,
}

/// A solid with a name and a material.
#[derive(Debug, Clone)]
pub struct Part {
    pub name: String,
    pub material: Material,
    pub solid: Solid,
}

impl Part {
    pub fn new(name: &str, material: Material, solid: Solid) -> Part {
        Part { name: name.to_owned(), material, solid }
    }
}

/// Combines several solids.
pub fn together(solids: impl IntoIterator<Item = Solid>) -> Solid {
    let mut all = Solid::default();
    for solid in solids {
        all.append(&solid);
    }
    all
}

/// Rotation from z up, as all models are built, to y up, as OBJ and PLY files are read.
pub fn y_up_from_z_up() -> DAffine3 {
    DAffine3::from_mat3(DMat3::from_cols(DVec3::X, DVec3::NEG_Z, DVec3::Y))
}
