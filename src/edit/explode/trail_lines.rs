//! [`with_trails`]: lines from where parts were to where they are.

use glam::{DAffine3, DVec3};

use super::Ways;
use super::bodies::bodies;
use crate::colour::srgb::Colour;
use crate::scene::{Geometry, Material, Part, Scene};

/// The name of the parts and of the material of these lines.
pub const TRAIL: &str = "trail";

/// The scene with its parts moved so, and with a wire from the middle of where each was, once all that holds it had moved,
/// to the middle of where it is.
#[must_use]
pub fn with_trails(scene: Scene, ways: &Ways) -> Scene {
    let mut wires = Geometry::default();
    let bodies = bodies(&scene);
    let both = ways.offsets.iter().zip(&ways.alone).enumerate();
    for (part, (whole, way)) in both.filter(|(_, (_, alone))| **alone != DVec3::ZERO) {
        let Some([low, high]) = bodies[part].bounds() else { continue };
        let from = (low + high) / 2.0;
        let first = wires.positions.len() as u32;
        wires.positions.extend([from + (*whole - *way), from + *whole]);
        wires.wires.push([first, first + 1]);
    }
    let mut scene = super::moved(scene, ways);
    if wires.wires.is_empty() {
        return scene;
    }
    // What has no material looks like the one after the last.
    scene.materials.push(Material::default());
    wires.material = Some(scene.materials.len() as u32);
    scene.materials.push(Material { name: TRAIL.to_owned(), colour: Colour::BLACK, ..Material::default() });
    let geometry = scene.geometries.len();
    scene.geometries.push(wires);
    scene.parts.push(Part { name: TRAIL.to_owned(), geometry, world_from_part: DAffine3::IDENTITY });
    scene
}
