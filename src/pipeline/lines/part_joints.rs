//! Removal of joints from the lines of a view, for styles that omit them (`lines.joints`).
//!
//! A joint is a line where parts of one material meet and their surfaces continue in one plane. This file
//! decides which materials are equal; `crate::lines::joints` finds the joints.

use rustc_hash::FxHashMap;

use crate::colour::srgb::Colour;
use crate::lines::{FeatureLines, joints};
use crate::mesh::Mesh;
use crate::scene::MaterialPaint;
use crate::scene::Paints;
use crate::scene::Scene;
use crate::style::Style;

/// Removes the joints from the lines of a view, unless the style draws them. With `has_regions` they stay
/// as borders of regions, and their indices are returned, ascending.
pub(crate) fn remove_part_joints(
    scene: &Scene,
    paints: Option<&Paints>,
    mesh: &Mesh,
    lines: &mut FeatureLines,
    style: &Style,
    has_regions: bool,
) -> Vec<u32> {
    if style.lines.joints {
        return Vec::new();
    }
    joints::remove_joints(mesh, lines, &kinds(scene, paints), has_regions)
}

/// For each paint, the first one that looks the same: its material and colour are equal. Without paints,
/// the same for each material. A file may list a material twice.
fn kinds(scene: &Scene, paints: Option<&Paints>) -> Vec<u32> {
    let mut named: FxHashMap<(&str, [u8; 4]), Vec<u32>> = FxHashMap::default();
    let mut materials: Vec<u32> = Vec::with_capacity(scene.materials.len());
    for (material, number) in scene.materials.iter().zip(0..) {
        let same = named.entry((&material.name, channels(material.colour))).or_default();
        let equal = same.iter().copied().find(|other| scene.materials[*other as usize] == *material);
        materials.push(equal.unwrap_or(number));
        if equal.is_none() {
            same.push(number);
        }
    }
    let Some(paints) = paints else { return materials };
    let mut first: FxHashMap<(u32, [u8; 4]), u32> = FxHashMap::default();
    let of_paint = |(paint, number): (&MaterialPaint, u32)| {
        let material = materials.get(paint.material.index()).copied().unwrap_or(paint.material.0);
        *first.entry((material, channels(paint.colour))).or_insert(number)
    };
    paints.list.iter().zip(0..).map(of_paint).collect()
}

fn channels(Colour { r, g, b, a }: Colour) -> [u8; 4] {
    [r, g, b, a]
}
