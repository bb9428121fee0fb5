//! [`with_trails`]: trail lines from the original to the final positions of parts.

use glam::{DAffine3, DVec3};

use super::PartOffsets;
use super::bodies::bodies;
use crate::colour::srgb::Colour;
use crate::scene::{Geometry, Material, Part, Scene};

/// Name of the part and of the material of trail lines.
pub(crate) const TRAIL: &str = "trail";

/// Moves the parts of a scene and adds trail lines. A line starts at the centre of a part after the common
/// movement with interlocking parts, and ends at its final centre.
#[must_use]
pub fn with_trails(scene: Scene, part_offsets: &PartOffsets) -> Scene {
    let mut wires = Geometry::default();
    let bodies = bodies(&scene);
    let both = part_offsets.offsets.iter().zip(&part_offsets.alone).enumerate();
    for (part, (total_offset, last_move)) in both.filter(|(_, (_, alone))| **alone != DVec3::ZERO) {
        let bounds = bodies[part].bounds();
        if bounds.is_empty() {
            continue;
        }
        let from = bounds.middle();
        let first = wires.positions.len() as u32;
        wires.positions.extend([from + (*total_offset - *last_move), from + *total_offset]);
        wires.wires.push([first, first + 1]);
    }
    let mut scene = super::moved(scene, part_offsets);
    if wires.wires.is_empty() {
        return scene;
    }
    // Parts without a material use the entry after the last, so that entry becomes explicit.
    scene.materials.push(Material::default());
    wires.material = Some(scene.materials.len() as u32);
    scene.materials.push(Material { name: TRAIL.to_owned(), colour: Colour::BLACK, ..Material::default() });
    let geometry = scene.geometries.len();
    scene.geometries.push(wires);
    scene.parts.push(Part { name: TRAIL.to_owned(), geometry, world_from_part: DAffine3::IDENTITY });
    scene
}
