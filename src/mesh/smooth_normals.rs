//! [`SmoothNormals`]: the normals of the rounded surfaces that a mesh stands for.
//!
//! Source: Nelson Max, "Weights for computing vertex normals from facet normals", Journal of
//! Graphics Tools 4(2), 1999: the weights that give the true normals of every polyhedron inscribed
//! in a sphere.

use glam::DVec3;
use rayon::prelude::*;

use super::{EdgeFaces, Mesh};

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
    /// is flat. One per face, or empty where all faces are flat.
    pub corners: Vec<[u32; 3]>,
    /// Whether all faces are rounded and no edge is hard, so that smooth vertices are vertices.
    pub seamless: bool,
}

impl SmoothNormals {
    /// The normals of a mesh all of which is one rounded surface without hard edges.
    #[must_use]
    pub fn rounded(mesh: &Mesh) -> Self {
        let count = mesh.positions.len();
        // Each worker owns a range of vertices, so that sums do not depend on the number of workers.
        let workers = if count < 20_000 { 1 } else { rayon::current_num_threads().clamp(1, 8) };
        let bounds: Vec<usize> = (0..=workers).map(|k| count * k / workers).collect();
        let parts: Vec<Vec<DVec3>> = bounds
            .par_windows(2)
            .map(|range| {
                let mut sums = vec![DVec3::ZERO; range[1] - range[0]];
                for triangle in &mesh.triangles {
                    let slots = triangle.map(|v| (v as usize).wrapping_sub(range[0]));
                    if slots.iter().all(|slot| *slot >= sums.len()) {
                        continue;
                    }
                    let weighted = weighted_normals(triangle.map(|v| mesh.positions[v as usize]));
                    for (slot, normal) in slots.into_iter().zip(weighted) {
                        if let Some(sum) = sums.get_mut(slot) {
                            *sum += normal;
                        }
                    }
                }
                sums.iter_mut().for_each(|sum| *sum = sum.normalize_or_zero());
                sums
            })
            .collect();
        Self {
            normals: parts.concat(),
            vertices: (0..count as u32).collect(),
            corners: mesh.triangles.clone(),
            seamless: true,
        }
    }

    /// The normals of a mesh of which the faces with `is_rounded` belong to rounded surfaces, which
    /// the edges with `is_hard` part. The file's own normals are taken where it has any.
    #[must_use]
    pub fn new(
        mesh: &Mesh,
        is_rounded: impl Fn(u32) -> bool + Sync,
        is_hard: impl Fn(usize) -> bool + Sync,
    ) -> Self {
        let rounded: Vec<bool> = (0..mesh.triangles.len() as u32).map(&is_rounded).collect();
        if !rounded.contains(&true) {
            return Self::default();
        }
        let parts = |edge: &usize| match mesh.edges.faces(*edge) {
            EdgeFaces::One(_) => false,
            EdgeFaces::Two { faces, same_way } => {
                let both = faces.iter().all(|f| rounded[*f as usize]);
                !both || same_way || is_hard(*edge)
            }
            EdgeFaces::Many(_) => true,
        };
        let parting: Vec<bool> =
            (0..mesh.edges.len()).into_par_iter().with_min_len(1 << 13).map(|e| parts(&e)).collect();
        if mesh.corner_normals.is_empty() && !rounded.contains(&false) && !parting.contains(&true) {
            return Self::rounded(mesh);
        }
        let mut fans = Fans::new(mesh.triangles.len());
        for edge in (0..mesh.edges.len()).filter(|e| !parting[*e]) {
            if let EdgeFaces::Two { faces: [first, second], .. } = mesh.edges.faces(edge) {
                for vertex in mesh.edges.vertices[edge] {
                    fans.join(corner(mesh, first, vertex), corner(mesh, second, vertex));
                }
            }
        }
        fans.normals(mesh, &rounded)
    }

    /// The smooth vertices at the corners of a face; none where it is flat.
    #[inline]
    #[must_use]
    pub fn corners_of(&self, face: u32) -> Option<[u32; 3]> {
        self.corners.get(face as usize).copied().filter(|corners| corners[0] != NO_NORMAL)
    }

    /// The smooth vertices at the ends of an edge, smaller first, where the surface runs on across it:
    /// all faces beside it are rounded and agree.
    #[inline]
    #[must_use]
    pub fn across(&self, mesh: &Mesh, edge: usize) -> Option<[u32; 2]> {
        let ends = mesh.edges.vertices[edge];
        let of_face = |face: u32| {
            let corners = self.corners_of(face)?;
            let triangle = mesh.triangles[face as usize];
            let corner = |v: u32| triangle.iter().position(|t| *t == v).map(|k| corners[k]);
            let (a, b) = (corner(ends[0])?, corner(ends[1])?);
            Some([a.min(b), a.max(b)])
        };
        match mesh.edges.faces(edge) {
            EdgeFaces::Two { same_way: true, .. } | EdgeFaces::Many(_) => None,
            _ if self.seamless => Some(ends),
            EdgeFaces::One(face) => of_face(face),
            EdgeFaces::Two { faces: [first, second], .. } => {
                let ends = of_face(first)?;
                (of_face(second)? == ends).then_some(ends)
            }
        }
    }

    /// Whether no face is rounded.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.corners.is_empty()
    }
}

/// The corner of a face at one of its vertices, numbered through all faces.
fn corner(mesh: &Mesh, face: u32, vertex: u32) -> u32 {
    let triangle = mesh.triangles[face as usize];
    3 * face + triangle.iter().position(|v| *v == vertex).unwrap_or(0) as u32
}

/// Corners that belong to one smooth vertex: a forest in which every corner knows one before it.
struct Fans {
    before: Vec<u32>,
}

impl Fans {
    fn new(faces: usize) -> Self {
        Self { before: (0..3 * faces as u32).collect() }
    }

    fn first(&mut self, mut corner: u32) -> u32 {
        while self.before[corner as usize] != corner {
            let skip = self.before[self.before[corner as usize] as usize];
            self.before[corner as usize] = skip;
            corner = skip;
        }
        corner
    }

    fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.first(a), self.first(b));
        self.before[a.max(b) as usize] = a.min(b);
    }

    /// Numbers the fans in the order of their first corners and sums their normals.
    fn normals(mut self, mesh: &Mesh, rounded: &[bool]) -> SmoothNormals {
        let mut smooth =
            SmoothNormals { corners: vec![[NO_NORMAL; 3]; rounded.len()], ..SmoothNormals::default() };
        let mut id_of = vec![NO_NORMAL; 3 * rounded.len()];
        let mut from_file: Vec<DVec3> = Vec::new();
        for face in (0..rounded.len()).filter(|f| rounded[*f]) {
            let weighted = weighted_normals(mesh.corners(super::FaceId(face as u32)));
            let own = file_normals(mesh, face);
            for k in 0..3 {
                let first = self.first((3 * face + k) as u32) as usize;
                if id_of[first] == NO_NORMAL {
                    id_of[first] = smooth.normals.len() as u32;
                    smooth.normals.push(DVec3::ZERO);
                    smooth.vertices.push(mesh.triangles[face][k]);
                    from_file.push(DVec3::ZERO);
                }
                let id = id_of[first];
                smooth.corners[face][k] = id;
                smooth.normals[id as usize] += weighted[k];
                from_file[id as usize] += own[k];
            }
        }
        for (normal, own) in smooth.normals.iter_mut().zip(from_file) {
            let geometric = normal.normalize_or_zero();
            let own = own.normalize_or_zero();
            // A file's normal that leaves the surface altogether is worth less than none.
            *normal = if own.dot(geometric) > 0.5 { own } else { geometric };
        }
        smooth
    }
}

/// The file's normals at the corners of a face, turned to the face's own side; zero where there
/// are none.
fn file_normals(mesh: &Mesh, face: usize) -> [DVec3; 3] {
    let Some(ids) = mesh.corner_normals.get(face) else { return [DVec3::ZERO; 3] };
    let own = glam::Vec3::from_array(mesh.face_normals[face]).as_dvec3();
    ids.map(|id| {
        let normal =
            mesh.normals.get(id as usize).map_or(DVec3::ZERO, |n| glam::Vec3::from_array(*n).as_dvec3());
        if normal.dot(own) < 0.0 { -normal } else { normal }
    })
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
