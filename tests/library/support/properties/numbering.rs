//! Changes to the numbering of a model: other orders of vertices, faces and parts, and reversed faces.

use ligne::scene::{Geometry, Scene};

use crate::library::support::scenes::random_dice::Dice;

/// The items in another order: item `order[k]` moves to position k.
fn permuted<T: Copy>(items: &[T], order: &[u32]) -> Vec<T> {
    if items.is_empty() { Vec::new() } else { order.iter().map(|k| items[*k as usize]).collect() }
}

fn random_permutation(dice: &mut Dice, count: usize) -> Vec<u32> {
    dice.shuffled((0..count as u32).collect())
}

/// The inverse of a permutation: the new position of each item.
fn inverse_permutation(order: &[u32]) -> Vec<u32> {
    let mut new_id = vec![0; order.len()];
    order.iter().zip(0..).for_each(|(old, new)| new_id[*old as usize] = new);
    new_id
}

/// Shuffles values, and updates the indices in `corners`.
fn renumber<T: Copy>(dice: &mut Dice, values: &mut Vec<T>, corners: &mut [u32]) {
    let order = random_permutation(dice, values.len());
    let new_id = inverse_permutation(&order);
    *values = permuted(values, &order);
    // Corners without a value have an index out of range, which stays.
    corners.iter_mut().for_each(|id| *id = new_id.get(*id as usize).copied().unwrap_or(*id));
}

/// Rotates the corner data of each triangle.
fn rotate_corners<T: Copy>(corners: &mut [[T; 3]], turns: &[usize]) {
    for (corners, by) in corners.iter_mut().zip(turns) {
        corners.rotate_left(*by);
    }
}

/// The geometry with vertices, normals, triangles and wires shuffled, and the corners of triangles rotated.
fn renumbered_geometry(geometry: &Geometry, dice: &mut Dice) -> Geometry {
    let mut mixed = geometry.clone();
    let order = random_permutation(dice, geometry.positions.len());
    let new_id = inverse_permutation(&order);
    mixed.positions = permuted(&geometry.positions, &order);
    mixed.colours = permuted(&geometry.colours, &order);
    let corners = mixed.triangles.as_flattened_mut().iter_mut().chain(mixed.wires.as_flattened_mut());
    corners.for_each(|v| *v = new_id[*v as usize]);
    renumber(dice, &mut mixed.normals, mixed.corner_normals.as_flattened_mut());
    renumber(dice, &mut mixed.uvs, mixed.corner_uvs.as_flattened_mut());

    let count = geometry.triangles.len();
    let turns: Vec<usize> = (0..count).map(|_| dice.below(3)).collect();
    rotate_corners(&mut mixed.triangles, &turns);
    rotate_corners(&mut mixed.corner_normals, &turns);
    rotate_corners(&mut mixed.corner_uvs, &turns);
    rotate_corners(&mut mixed.edge_marks, &turns);
    let order = random_permutation(dice, count);
    mixed.triangles = permuted(&mixed.triangles, &order);
    mixed.triangle_material = permuted(&mixed.triangle_material, &order);
    mixed.corner_normals = permuted(&mixed.corner_normals, &order);
    mixed.corner_uvs = permuted(&mixed.corner_uvs, &order);
    mixed.edge_marks = permuted(&mixed.edge_marks, &order);
    mixed.wires = dice.shuffled(mixed.wires);
    for wire in &mut mixed.wires {
        wire.rotate_left(dice.below(2));
    }
    mixed
}

/// The scene with each geometry renumbered.
pub(crate) fn renumbered(scene: &Scene, dice: &mut Dice) -> Scene {
    let geometries = scene.geometries.iter().map(|geometry| renumbered_geometry(geometry, dice)).collect();
    Scene { geometries, ..scene.clone() }
}

/// The scene with its parts shuffled.
pub(crate) fn with_parts_shuffled(scene: &Scene, dice: &mut Dice) -> Scene {
    Scene { parts: dice.shuffled(scene.parts.clone()), ..scene.clone() }
}

/// An OBJ text with its vertices shuffled, and the faces of each object shuffled.
pub(crate) fn renumbered_obj(text: &str, dice: &mut Dice) -> String {
    let vertices: Vec<&str> = text.lines().filter(|line| line.starts_with("v ")).collect();
    let order = random_permutation(dice, vertices.len());
    let new_id = inverse_permutation(&order);
    let renamed = |corner: &str| {
        let (vertex, rest) = corner.find('/').map_or((corner, ""), |slash| corner.split_at(slash));
        // The file counts from 1.
        format!("{}{rest}", new_id[vertex.parse::<usize>().unwrap() - 1] + 1)
    };
    let mut mixed: Vec<String> = order.iter().map(|old| vertices[*old as usize].to_owned()).collect();
    let mut faces: Vec<String> = Vec::new();
    for line in text.lines().filter(|line| !line.starts_with("v ")) {
        if let Some(corners) = line.strip_prefix("f ") {
            let corners: Vec<String> = corners.split_whitespace().map(renamed).collect();
            faces.push(format!("f {}", corners.join(" ")));
        } else {
            mixed.append(&mut dice.shuffled(std::mem::take(&mut faces)));
            mixed.push(line.to_owned());
        }
    }
    mixed.append(&mut dice.shuffled(faces));
    mixed.join("\n")
}

/// The scene with the winding of some faces reversed; `is_turned` gets the geometry index for each face.
pub(crate) fn with_faces_reversed(scene: &Scene, mut is_turned: impl FnMut(usize) -> bool) -> Scene {
    let mut scene = scene.clone();
    for (shape, geometry) in scene.geometries.iter_mut().enumerate() {
        for face in 0..geometry.triangles.len() {
            if !is_turned(shape) {
                continue;
            }
            for list in [&mut geometry.triangles, &mut geometry.corner_normals, &mut geometry.corner_uvs] {
                if let Some(corners) = list.get_mut(face) {
                    corners.swap(1, 2);
                }
            }
            if let Some(marks) = geometry.edge_marks.get_mut(face) {
                marks.swap(0, 2);
            }
        }
    }
    scene
}
