//! Mesh defects as warnings.

use std::collections::BTreeMap;

use crate::mesh::{EdgeFaces, Mesh, PartId};
use crate::scene::{Scene, Warnings};

/// The defects that cleaning found, counted and named by part.
#[must_use]
pub(crate) fn of_mesh(mesh: &Mesh, scene: &Scene) -> Warnings {
    let mut warnings = Warnings::default();
    let c = &mesh.cleaning;
    warnings.count("faces with two corners at one place were left out", c.collapsed);
    warnings.count("lines with both ends at one place were left out", c.short_wires);
    warnings.count("doubled faces were left out", c.doubled);
    warnings.count("faces without area", c.degenerate);
    if c.non_manifold > 0 {
        for (part, n) in non_manifold_by_part(mesh) {
            let name = scene.parts.get(part.index()).map_or("", |p| p.name.as_str());
            warnings.count(format!("non-manifold edges in part '{name}'"), n);
        }
    }
    warnings
}

/// Number of edges per part where the faces cannot be paired into surfaces.
///
/// Along a manifold edge equal numbers of faces run in both directions. Where parts or solids touch, each has
/// its own pair of faces, which is no defect.
fn non_manifold_by_part(mesh: &Mesh) -> BTreeMap<PartId, u64> {
    let mut counts: BTreeMap<PartId, u64> = BTreeMap::new();
    for edge in 0..mesh.edges.len() {
        if let EdgeFaces::Many(faces) = mesh.edges.faces(edge) {
            let [lo, hi] = mesh.edges.vertices[edge];
            let runs_up = |face: u32| {
                let [a, b, c] = mesh.triangles[face as usize];
                [(a, b), (b, c), (c, a)].contains(&(lo, hi))
            };
            let part = |face: u32| mesh.face_part[face as usize];
            let mut balance: Vec<(PartId, i32)> =
                faces.iter().map(|f| (part(*f), if runs_up(*f) { 1 } else { -1 })).collect();
            balance.sort_unstable();
            for own in balance.chunk_by(|a, b| a.0 == b.0) {
                if own.len() > 2 && own.iter().map(|(_, way)| way).sum::<i32>() != 0 {
                    *counts.entry(own[0].0).or_default() += 1;
                }
            }
        }
    }
    counts
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::mesh::Soup;

    #[test]
    fn non_manifold_fins_are_defects_and_touching_solids_are_not() {
        let spokes = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];
        let mut positions = vec![DVec3::ZERO, DVec3::Z];
        positions.extend(spokes.iter().map(|[x, y]| DVec3::new(*x, *y, 0.0)));
        let defects = |triangles: &[[u32; 3]]| {
            let soup =
                Soup { positions: positions.clone(), triangles: triangles.to_vec(), ..Soup::default() };
            non_manifold_by_part(&Mesh::build(soup)).values().sum::<u64>()
        };
        assert_eq!(defects(&[[0, 1, 2], [1, 0, 3], [0, 1, 4], [1, 0, 5]]), 0);
        assert_eq!(defects(&[[0, 1, 2], [1, 0, 3], [0, 1, 4]]), 1);
        assert_eq!(defects(&[[0, 1, 2], [0, 1, 3], [0, 1, 4], [1, 0, 5]]), 1);
    }
}
