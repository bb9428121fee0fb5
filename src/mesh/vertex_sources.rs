//! [`VertexSources`]: source vertices of a mesh in its soup, so that the mesh can follow a pose.
//!
//! A pose changes positions and normals only. Welding, edges, creases and patches stay those of the rest
//! pose.

use std::cmp::Ordering;

use crate::parallel::prelude::*;
use glam::DVec3;
use rustc_hash::FxHashMap;

use super::tolerances;
use super::{Mesh, MeshMetrics, Soup};
use crate::mesh::normals::normal_carriers::{CoplanarSearch, normals_and_carriers};
use crate::mesh::overlaps::overlay_order::overlays;

/// Mapping between the vertices of a soup and of its mesh.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct VertexSources {
    /// For each vertex of the soup, the vertex of the mesh at its position.
    vertices: Vec<u32>,
    /// For each vertex of the mesh, the first vertex of the soup at its position.
    first: Vec<u32>,
    triangles: usize,
    normals: usize,
}

impl VertexSources {
    /// Maps a mesh and the soup that it was built from. `None` if some position of one is missing in the
    /// other.
    #[must_use]
    pub(crate) fn of(mesh: &Mesh, soup: &Soup) -> Option<Self> {
        let places = mesh.positions.iter().zip(0..).map(|(p, vertex)| (bits(*p), vertex));
        let places: FxHashMap<[u64; 3], u32> = places.collect();
        let place = |p: &DVec3| places.get(&bits(local(*p, mesh.origin))).copied();
        let vertices: Option<Vec<u32>> = soup.positions.iter().map(place).collect();
        let vertices = vertices?;
        let mut first = vec![u32::MAX; mesh.positions.len()];
        for (vertex, number) in vertices.iter().zip(0..) {
            let own = first.get_mut(*vertex as usize)?;
            *own = (*own).min(number);
        }
        let known = first.iter().all(|number| *number != u32::MAX);
        known.then_some(Self {
            vertices,
            first,
            triangles: soup.triangles.len(),
            normals: soup.normals.len(),
        })
    }
}

impl Mesh {
    /// This mesh with the vertex positions of `soup`, which must be the soup of `sources` in another pose.
    ///
    /// `None` if it is a different soup, or if welded vertices have separated. The mesh must then be built
    /// again.
    #[must_use]
    pub(crate) fn posed(&self, sources: &VertexSources, soup: &Soup) -> Option<Self> {
        let VertexSources { vertices, first, triangles, normals } = sources;
        let same = [soup.positions.len(), soup.triangles.len(), soup.normals.len()];
        if same != [vertices.len(), *triangles, *normals] || self.positions.len() != first.len() {
            return None;
        }
        let positions: Option<Vec<DVec3>> = first
            .iter()
            .map(|source| Some(local(*soup.positions.get(*source as usize)?, self.origin)))
            .collect();
        let moved = Soup {
            positions: positions?,
            triangles: self.triangles.clone(),
            triangle_part: self.face_part.clone(),
            wires: self.wires.clone(),
            single_precision: soup.single_precision,
            steps: soup.steps.clone(),
            ..Soup::default()
        };
        let extents = MeshMetrics::new(&moved, self.origin, true);
        let extents = extents.united(&self.bodies, self.origin, moved.single_precision);
        let together = tolerances::MAX_SPREAD_OF_MODEL * extents.counted_diagonal();
        let parted = |(vertex, p): (&u32, &DVec3)| {
            let joined = moved.positions.get(*vertex as usize).copied().unwrap_or(DVec3::NAN);
            (local(*p, self.origin) - joined).length().partial_cmp(&together).is_none_or(Ordering::is_gt)
        };
        if vertices.par_iter().zip(&soup.positions).any(parted) {
            return None;
        }
        let Soup { positions, triangles, triangle_part: parts, .. } = &moved;
        let search = CoplanarSearch { positions, triangles, parts, edges: &self.edges, extents: &extents };
        let (face_normals, carriers) = normals_and_carriers(&search);
        let mut posed = Self {
            face_normals,
            carriers,
            normals: soup.normals.clone(),
            positions: moved.positions,
            extents,
            ..self.clone()
        };
        posed.overlays = overlays(&posed);
        Some(posed)
    }
}

/// Position relative to the origin of a mesh, with the same operations as in [`Mesh::build`]; adding zero
/// turns -0 into +0.
fn local(p: DVec3, origin: DVec3) -> DVec3 {
    let p = p + DVec3::ZERO;
    if origin == DVec3::ZERO { p } else { p - origin }
}

fn bits(p: DVec3) -> [u64; 3] {
    p.to_array().map(f64::to_bits)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn soup(shift: f64, apart: f64) -> Soup {
        let points = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 0.0], [0.0, 1.0], [1.0 + apart, 1.0]];
        let split = |(number, p): (usize, &[f64; 2])| {
            DVec3::new(p[0] + shift, p[1], if number == 4 { apart } else { 0.0 })
        };
        Soup {
            positions: points.iter().enumerate().map(split).collect(),
            triangles: vec![[0, 1, 2], [3, 5, 4]],
            ..Soup::default()
        }
    }

    #[test]
    fn posed_mesh_equals_a_mesh_built_in_the_pose() {
        let rest = Mesh::build(soup(0.0, 0.0));
        let sources = VertexSources::of(&rest, &soup(0.0, 0.0)).unwrap();
        let moved = rest.posed(&sources, &soup(3.0, 0.0)).unwrap();
        let built = Mesh::build(soup(3.0, 0.0));
        // Sorted, because the moved mesh keeps the order of the rest pose.
        let faces = |mesh: &Mesh| {
            let corner =
                |vertex: u32| (mesh.positions[vertex as usize] + mesh.origin).to_array().map(f64::to_bits);
            let mut faces: Vec<_> = mesh
                .triangles
                .iter()
                .zip(&mesh.face_normals)
                .map(|(face, normal)| {
                    let mut corners = face.map(corner);
                    corners.sort_unstable();
                    (corners, normal.map(|x| (x + 0.0).to_bits()))
                })
                .collect();
            faces.sort_unstable();
            faces
        };
        assert_eq!(faces(&moved), faces(&built));
        assert_eq!(moved.edges.len(), built.edges.len());
    }

    #[test]
    fn posed_is_none_if_welded_vertices_separate_or_soups_differ() {
        let rest = Mesh::build(soup(0.0, 0.0));
        let sources = VertexSources::of(&rest, &soup(0.0, 0.0)).unwrap();
        assert!(rest.posed(&sources, &soup(0.0, 0.1)).is_none());
        assert!(rest.posed(&sources, &Soup::default()).is_none());
        assert!(VertexSources::of(&rest, &soup(9.0, 0.0)).is_none());
    }
}
