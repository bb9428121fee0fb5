//! Tools for assemblies: paints, rotations, a list of meshes, and nodes that show them.

use std::f64::consts::{FRAC_1_SQRT_2, TAU};

use glam::{DQuat, DVec2, DVec3};

use crate::geometry::outline::polar;
use crate::geometry::part::{Material, Part};
use crate::geometry::solid::Solid;
use crate::writers::glb::Node;

pub const fn paint(name: &'static str, colour: [f64; 3]) -> Material {
    Material { name, colour, metallic: 0.0, roughness: 0.5 }
}

pub const BLUE: Material = paint("blue paint", [0.16, 0.38, 0.58]);
pub const GREEN: Material = paint("green paint", [0.45, 0.58, 0.50]);
pub const DARK: Material = paint("dark paint", [0.25, 0.27, 0.30]);
pub const ORANGE: Material = paint("orange rubber", [0.90, 0.45, 0.12]);
pub const STEEL: Material =
    Material { name: "steel", colour: [0.78, 0.79, 0.81], metallic: 1.0, roughness: 0.35 };
pub const ZINC: Material =
    Material { name: "zinc", colour: [0.62, 0.64, 0.66], metallic: 1.0, roughness: 0.5 };
pub const BRASS: Material =
    Material { name: "brass", colour: [0.85, 0.68, 0.33], metallic: 1.0, roughness: 0.3 };

pub const UP: DQuat = DQuat::IDENTITY;
pub const TO_BACK: DQuat = DQuat::from_xyzw(0.0, FRAC_1_SQRT_2, 0.0, FRAC_1_SQRT_2);
pub const TO_FRONT: DQuat = DQuat::from_xyzw(0.0, -FRAC_1_SQRT_2, 0.0, FRAC_1_SQRT_2);
pub const TO_SIDE: DQuat = DQuat::from_xyzw(FRAC_1_SQRT_2, 0.0, 0.0, FRAC_1_SQRT_2);
pub const HALF_TURN: DQuat = DQuat::from_xyzw(0.0, 0.0, 1.0, 0.0);

/// Meshes that nodes refer to by index.
#[derive(Default)]
pub struct Shop {
    pub meshes: Vec<Part>,
}

impl Shop {
    /// Adds a mesh and returns its index.
    pub fn mesh(&mut self, name: &str, material: Material, solid: Solid) -> usize {
        self.meshes.push(Part::new(name, material, solid));
        self.meshes.len() - 1
    }

    /// Adds a mesh and a node that shows it without a transform.
    pub fn part(&mut self, name: &str, material: Material, solid: Solid) -> Node {
        let mesh = self.mesh(name, material, solid);
        place(name, mesh, DVec3::ZERO, UP)
    }
}

/// Node that shows a mesh with a translation and a rotation.
pub fn place(name: &str, mesh: usize, translation: DVec3, rotation: DQuat) -> Node {
    Node { translation, rotation, mesh: Some(mesh), ..Node::group(name, Vec::new()) }
}

/// Instances of a mesh, numbered in list order.
pub fn several(
    name: &str,
    mesh: usize,
    rotation: DQuat,
    places: impl IntoIterator<Item = DVec3>,
) -> Vec<Node> {
    let numbered = places.into_iter().enumerate();
    numbered.map(|(i, at)| place(&format!("{name}-{}", i + 1), mesh, at, rotation)).collect()
}

/// Points on a circle about the shaft at `x`. The first one is offset by `start` steps.
pub fn around(x: f64, radius: f64, count: u32, start: f64) -> impl Iterator<Item = DVec3> {
    (0..count).map(move |i| {
        let place = polar(DVec2::ZERO, radius, TAU * (f64::from(i) + start) / f64::from(count));
        DVec3::new(x, place.x, place.y)
    })
}
