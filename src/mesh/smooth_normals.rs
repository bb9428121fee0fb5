//! [`SmoothNormals`]: the normals of the rounded surfaces that a mesh stands for.
//!
//! Source: Nelson Max, "Weights for computing vertex normals from facet normals", Journal of
//! Graphics Tools 4(2), 1999: the weights that give the true normals of every polyhedron inscribed
//! in a sphere.

use glam::DVec3;

use super::Mesh;

/// In [`SmoothNormals::corners`]: the face is flat.
pub const NO_NORMAL: u32 = u32::MAX;

/// Normals of the rounded surfaces that the faces of a mesh approximate.
///
/// Each normal belongs to one *smooth vertex*: a vertex of the mesh together with those faces
/// around it that no hard edge parts. Where no edge is hard, smooth vertices are the vertices.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SmoothNormals {
    /// Unit normals, local space; zero where no face around has area. One per smooth vertex.
    pub normals: Vec<DVec3>,
    /// The mesh vertex each smooth vertex stands on. One per smooth vertex.
    pub vertices: Vec<u32>,
    /// The smooth vertices at the corners of each face, [`NO_NORMAL`] at all three where the face
    /// is flat. One per face.
    pub corners: Vec<[u32; 3]>,
}

impl SmoothNormals {
    /// The normals of a mesh all of which is one rounded surface without hard edges.
    #[must_use]
    pub fn rounded(mesh: &Mesh) -> Self {
        let mut normals = vec![DVec3::ZERO; mesh.positions.len()];
        for triangle in &mesh.triangles {
            let weighted = weighted_normals(triangle.map(|v| mesh.positions[v as usize]));
            for (v, normal) in triangle.iter().zip(weighted) {
                normals[*v as usize] += normal;
            }
        }
        Self {
            normals: normals.into_iter().map(DVec3::normalize_or_zero).collect(),
            vertices: (0..mesh.positions.len() as u32).collect(),
            corners: mesh.triangles.clone(),
        }
    }
}

/// What a triangle adds to the normal at each of its corners (Max, eq. 2).
pub(super) fn weighted_normals([a, b, c]: [DVec3; 3]) -> [DVec3; 3] {
    let (u, v, w) = (b - a, c - b, a - c);
    let cross = u.cross(v);
    let [uu, vv, ww] = [u, v, w].map(DVec3::length_squared);
    [uu * ww, uu * vv, vv * ww].map(|weight| if weight > 0.0 { cross / weight } else { DVec3::ZERO })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Soup;

    #[test]
    fn normals_of_an_inscribed_polyhedron_are_those_of_the_sphere() {
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
