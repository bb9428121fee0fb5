//! Computes [`SmoothNormals`]: one normal per vertex, and several where surfaces are separated.

use crate::parallel::prelude::*;
use glam::DVec3;

use super::file_normals::{file_normals, preferred_normal};
use super::normal_sum::{FaceWeights, NormalSum};
use super::smooth_normals::{NO_NORMAL, SmoothNormals};
use super::straight_edges;
use super::vertex_split;
use crate::mesh::EdgeSet;
use crate::mesh::{EdgeFaces, Mesh, VertexRange, range_count, vertex_ranges};
use crate::parallel::task_size::MIN_TASK_ITEMS;

/// Maximum number of vertices per block.
const MAX_VERTICES_PER_BLOCK: usize = 1 << 13;

impl SmoothNormals {
    /// Normals of a mesh that is one curved surface without hard edges.
    #[cfg(test)]
    pub(crate) fn rounded(mesh: &Mesh) -> Self {
        Self {
            normals: vertex_normals(mesh, |_| true),
            vertices: (0..mesh.positions.len() as u32).collect(),
            corners: mesh.triangles.clone(),
            separating_edges: EdgeSet::default(),
            straight: EdgeSet::default(),
            gentle: EdgeSet::default(),
            seamless: true,
        }
    }

    /// Normals of a mesh whose faces with `is_rounded` form curved surfaces, separated by edges with
    /// `is_hard`. Normals of the file are used where present.
    #[must_use]
    pub(crate) fn new(
        mesh: &Mesh,
        is_rounded: impl Fn(u32) -> bool + Sync,
        is_hard: impl Fn(usize) -> bool + Sync,
    ) -> Self {
        let mut smooth = Self::without_straight_edges(mesh, is_rounded, is_hard);
        if !smooth.is_empty() {
            smooth.gentle = straight_edges::gentle(mesh, &smooth);
            smooth.straight = straight_edges::straight(mesh, &smooth);
        }
        smooth
    }

    /// Same, without gentle and straight edges, which shading does not need.
    #[must_use]
    pub(crate) fn without_straight_edges(
        mesh: &Mesh,
        is_rounded: impl Fn(u32) -> bool + Sync,
        is_hard: impl Fn(usize) -> bool + Sync,
    ) -> Self {
        let faces = 0..mesh.triangles.len() as u32;
        let rounded: Vec<bool> =
            faces.into_par_iter().with_min_len(MIN_TASK_ITEMS).map(&is_rounded).collect();
        if !rounded.contains(&true) {
            return Self::default();
        }
        let touching = touching_borders(mesh);
        let parting = EdgeSet::collect(mesh.edges.len(), |edge| match mesh.edges.faces(edge) {
            EdgeFaces::One(face) => {
                let is_touching = |vertex: &u32| touching.get(*vertex as usize) == Some(&true);
                rounded[face as usize] && mesh.edges.vertices[edge].iter().any(is_touching)
            }
            EdgeFaces::Two { faces, same_way } => {
                let count = faces.iter().filter(|f| rounded[**f as usize]).count();
                count == 1 || (count == 2 && (same_way || is_hard(edge)))
            }
            EdgeFaces::Many(faces) => faces.iter().any(|f| rounded[*f as usize]),
        });
        let all = !rounded.contains(&false);
        let corners = if all {
            mesh.triangles.clone()
        } else {
            let of = |(t, rounded): (&[u32; 3], &bool)| if *rounded { *t } else { [NO_NORMAL; 3] };
            mesh.triangles.par_iter().zip(&rounded).with_min_len(MIN_TASK_ITEMS).map(of).collect()
        };
        let mut smooth = Self {
            normals: vertex_normals(mesh, |face| rounded[face]),
            vertices: (0..mesh.positions.len() as u32).collect(),
            corners,
            seamless: all && parting.is_empty(),
            separating_edges: parting,
            straight: EdgeSet::default(),
            gentle: EdgeSet::default(),
        };
        vertex_split::part(mesh, &mut smooth);
        smooth
    }
}

/// Whether surfaces touch at each vertex with their borders, without an edge in common. Empty if none do.
fn touching_borders(mesh: &Mesh) -> Vec<bool> {
    let mut borders: Vec<u8> = Vec::new();
    for edge in 0..mesh.edges.len() {
        if matches!(mesh.edges.faces(edge), EdgeFaces::One(_)) {
            borders.resize(mesh.positions.len(), 0);
            mesh.edges.vertices[edge].iter().for_each(|vertex| {
                let count = &mut borders[*vertex as usize];
                *count = count.saturating_add(1);
            });
        }
    }
    borders.into_iter().map(|count| count > 2).collect()
}

/// Normal of each vertex, from its adjacent faces with `counts` or from the file.
fn vertex_normals(mesh: &Mesh, counts: impl Fn(usize) -> bool + Sync) -> Vec<DVec3> {
    let count = mesh.positions.len();
    // The sums of a block fit in the cache. Faces at the border of a block are weighted once per block.
    let shares = vertex_ranges(count, &mesh.triangles, range_count(count, MAX_VERTICES_PER_BLOCK));
    let mut normals = vec![DVec3::ZERO; count];
    let mut rest = &mut normals[..];
    let work: Vec<(&VertexRange, &mut [DVec3])> = shares
        .iter()
        .map(|share| {
            let (own, others) = std::mem::take(&mut rest).split_at_mut(share.vertices.len());
            rest = others;
            (share, own)
        })
        .collect();
    work.into_par_iter().with_max_len(1).for_each(|(share, normals)| {
        let mut sums = vec![NormalSum::default(); share.vertices.len()];
        let mut own = vec![DVec3::ZERO; if mesh.corner_normals.is_empty() { 0 } else { sums.len() }];
        for face in share.faces.iter().flat_map(Clone::clone).filter(|face| counts(*face)) {
            let triangle = mesh.triangles[face];
            let slots = triangle.map(|v| (v as usize).wrapping_sub(share.vertices.start));
            let Some(weighted) = FaceWeights::new(triangle.map(|v| mesh.positions[v as usize])) else {
                continue;
            };
            for (k, slot) in slots.iter().enumerate() {
                if let Some(sum) = sums.get_mut(*slot) {
                    sum.add(&weighted, k);
                }
            }
            if !own.is_empty() {
                for (slot, normal) in slots.iter().zip(file_normals(mesh, face)) {
                    if let Some(sum) = own.get_mut(*slot) {
                        *sum += normal;
                    }
                }
            }
        }
        let of_file = |k: usize| own.get(k).copied().unwrap_or_default();
        let of_faces = sums.iter().map(NormalSum::normal);
        normals.iter_mut().zip(of_faces).enumerate().for_each(|(k, (normal, of_faces))| {
            *normal = preferred_normal(of_faces, of_file(k));
        });
    });
    normals
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Soup;

    #[test]
    fn vertex_normals_of_an_inscribed_polyhedron_match_the_sphere() {
        // An octahedron with one corner moved along the sphere.
        let tilted = DVec3::new(0.6, 0.0, 0.8);
        let positions = vec![DVec3::X, DVec3::Y, tilted, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z];
        let triangles =
            vec![[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2], [1, 0, 5], [3, 1, 5], [4, 3, 5], [0, 4, 5]];
        let mesh = Mesh::build(Soup { positions, triangles, ..Soup::default() });
        let smooth = SmoothNormals::rounded(&mesh);
        for (normal, position) in smooth.normals.iter().zip(&mesh.positions) {
            let on_sphere = *position + mesh.origin;
            assert!(normal.distance(on_sphere) < 1e-9, "{normal} at {on_sphere}");
        }
    }
}
