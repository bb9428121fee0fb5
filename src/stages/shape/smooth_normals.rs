//! [`SmoothNormals`]: the normals of the rounded surfaces that a mesh stands for.
//!
//! Source: Nelson Max, "Weights for computing vertex normals from facet normals", Journal of
//! Graphics Tools 4(2), 1999: the weights that give the true normals of every polyhedron inscribed
//! in a sphere.

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::parting;
use crate::mesh::edge_set::EdgeSet;
use crate::mesh::{EdgeFaces, Mesh};

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
    /// Edges that part rounded surfaces from each other or from flat faces.
    pub parting: EdgeSet,
    /// Edges over which the surface is taken to be straight, though its normals turn: what is between their ends does not
    /// bend with what meets there.
    pub straight: EdgeSet,
    /// Whether all faces are rounded and no edge parts them, so that smooth vertices are vertices.
    pub seamless: bool,
}

impl SmoothNormals {
    /// The normals of a mesh all of which is one rounded surface without hard edges.
    #[must_use]
    pub fn rounded(mesh: &Mesh) -> Self {
        Self {
            normals: vertex_normals(mesh, |_| true),
            vertices: (0..mesh.positions.len() as u32).collect(),
            corners: mesh.triangles.clone(),
            parting: EdgeSet::default(),
            straight: EdgeSet::default(),
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
        let parting = EdgeSet::collect(mesh.edges.len(), |edge| match mesh.edges.faces(edge) {
            EdgeFaces::One(_) => false,
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
            mesh.triangles.iter().zip(&rounded).map(of).collect()
        };
        let mut smooth = Self {
            normals: vertex_normals(mesh, |face| rounded[face]),
            vertices: (0..mesh.positions.len() as u32).collect(),
            corners,
            seamless: all && parting.is_empty(),
            parting,
            straight: EdgeSet::default(),
        };
        parting::part(mesh, &mut smooth);
        smooth.straight = uneven(mesh, &smooth);
        smooth
    }

    /// The smooth vertices at the corners of a face; none where it is flat.
    #[inline]
    #[must_use]
    pub fn corners_of(&self, face: u32) -> Option<[u32; 3]> {
        self.corners.get(face as usize).copied().filter(|corners| corners[0] != NO_NORMAL)
    }

    /// The smooth vertices at the ends of an edge, smaller first, where the surface runs on across it
    /// or ends there: no face beside it is flat or of another surface.
    #[inline]
    #[must_use]
    pub fn across(&self, mesh: &Mesh, edge: usize) -> Option<[u32; 2]> {
        let ends = mesh.edges.vertices[edge];
        if self.seamless {
            return Some(ends);
        }
        if self.parting.contains(edge) {
            return None;
        }
        let face = match mesh.edges.faces(edge) {
            EdgeFaces::One(face) | EdgeFaces::Two { faces: [face, _], .. } => face,
            EdgeFaces::Many(_) => return None,
        };
        let corners = self.corners_of(face)?;
        let triangle = mesh.triangles[face as usize];
        let corner = |v: u32| triangle.iter().position(|t| *t == v).map(|k| corners[k]);
        let (a, b) = (corner(ends[0])?, corner(ends[1])?);
        Some([a.min(b), a.max(b)])
    }

    /// Whether every face is rounded.
    #[must_use]
    pub fn corners_of_all(&self) -> bool {
        !self.corners.is_empty() && self.corners.iter().all(|corners| corners[0] != NO_NORMAL)
    }

    /// Whether no face is rounded.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.corners.is_empty()
    }
}

/// Edges more than so many times as long as one beside them, between normals that turn by more than this
/// (cosine, 15 degrees), are straight.
const UNEVEN_LENGTHS: f64 = 4.0;
const UNEVEN_COSINE: f64 = 0.966;

/// Long edges beside short ones: the normals at their ends are those of a bevel or a fillet there, and what
/// is between the ends does not bend with them.
fn uneven(mesh: &Mesh, smooth: &SmoothNormals) -> EdgeSet {
    let squared = |a: u32, b: u32| mesh.positions[a as usize].distance_squared(mesh.positions[b as usize]);
    EdgeSet::collect(mesh.edges.len(), |edge| {
        let Some([a, b]) = smooth.across(mesh, edge) else { return false };
        if smooth.normals[a as usize].dot(smooth.normals[b as usize]) > UNEVEN_COSINE {
            return false;
        }
        let ends = mesh.edges.vertices[edge];
        let least = squared(ends[0], ends[1]) / (UNEVEN_LENGTHS * UNEVEN_LENGTHS);
        mesh.edges.faces(edge).list().iter().any(|face| {
            let [a, b, c] = mesh.triangles[*face as usize];
            [[a, b], [b, c], [c, a]].iter().any(|[a, b]| squared(*a, *b) < least)
        })
    })
}

/// The normal of each vertex from the faces with `counts` around it, or those that the file has
/// there.
fn vertex_normals(mesh: &Mesh, counts: impl Fn(usize) -> bool + Sync) -> Vec<DVec3> {
    let count = mesh.positions.len();
    // Each worker owns a range of vertices, so that sums do not depend on the number of workers.
    let workers = if count < 20_000 { 1 } else { rayon::current_num_threads().clamp(1, 8) };
    let bounds: Vec<usize> = (0..=workers).map(|k| count * k / workers).collect();
    let parts: Vec<Vec<DVec3>> = bounds
        .par_windows(2)
        .map(|range| {
            let mut sums = vec![NormalSum::default(); range[1] - range[0]];
            let mut own = vec![DVec3::ZERO; if mesh.corner_normals.is_empty() { 0 } else { sums.len() }];
            for (face, triangle) in mesh.triangles.iter().enumerate() {
                let slots = triangle.map(|v| (v as usize).wrapping_sub(range[0]));
                if slots.iter().all(|slot| *slot >= sums.len()) || !counts(face) {
                    continue;
                }
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
            sums.iter().enumerate().map(|(k, sum)| chosen(sum.normal(), of_file(k))).collect()
        })
        .collect();
    parts.concat()
}

/// The normal at a vertex, from the faces around it.
///
/// Max's weights are right for a ball, where small faces are as good as large ones. Where a strip of
/// small faces meets large ones, these are the surface and the strip is its edge: there each face
/// counts by its area and its angle.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct NormalSum {
    of_max: DVec3,
    of_area: DVec3,
    /// The largest and the smallest face, twice their areas squared; the smallest as its inverse.
    most: f64,
    least: f64,
}

/// Faces around a vertex whose areas differ by more than this are an edge strip and what it borders.
const UNEVEN: f64 = 6.0;

/// What a face adds to the normals at its corners.
#[derive(Debug, Clone, Copy)]
pub(super) struct FaceWeights {
    /// The normal, as long as the face is large, twice.
    cross: DVec3,
    squared: f64,
    inverse: f64,
    /// At each corner one through the squared lengths of the two sides there.
    of_max: [f64; 3],
}

impl FaceWeights {
    /// Of a face with these corners; none if it has no area.
    #[inline]
    pub fn new([a, b, c]: [DVec3; 3]) -> Option<Self> {
        let (ab, bc, ca) = (b - a, c - b, a - c);
        let cross = ca.cross(ab);
        let squared = cross.length_squared();
        let sides = [ab, bc, ca].map(DVec3::length_squared);
        let weights = [sides[2] * sides[0], sides[0] * sides[1], sides[1] * sides[2]];
        let has_area = squared > 0.0 && weights.iter().all(|weight| *weight > 0.0);
        has_area.then(|| Self { cross, squared, inverse: 1.0 / squared, of_max: weights.map(|w| 1.0 / w) })
    }
}

impl NormalSum {
    /// Adds a face of which a corner is the vertex.
    #[inline]
    pub fn add(&mut self, face: &FaceWeights, which: usize) {
        // Max, eq. 2.
        let of_max = face.of_max[which];
        self.of_max += face.cross * of_max;
        // The sine stands for the angle, to which it is near where faces are many.
        self.of_area += face.cross * (face.squared * of_max).sqrt();
        self.most = self.most.max(face.squared);
        self.least = self.least.max(face.inverse);
    }

    /// The sum that is meant, not of unit length.
    #[inline]
    pub fn normal(&self) -> DVec3 {
        if self.most * self.least > UNEVEN * UNEVEN { self.of_area } else { self.of_max }
    }
}

/// The direction of the file's normals, or where they leave the surface altogether, of those of the
/// faces.
pub(super) fn chosen(of_faces: DVec3, of_file: DVec3) -> DVec3 {
    let (of_faces, of_file) = (of_faces.normalize_or_zero(), of_file.normalize_or_zero());
    if of_file.dot(of_faces) > 0.5 { of_file } else { of_faces }
}

/// The file's normals at the corners of a face, turned to the face's own side; zero where there
/// are none.
pub(super) fn file_normals(mesh: &Mesh, face: usize) -> [DVec3; 3] {
    let Some(ids) = mesh.corner_normals.get(face) else { return [DVec3::ZERO; 3] };
    let own = Vec3::from_array(mesh.face_normals[face]).as_dvec3();
    ids.map(|id| {
        let normal = mesh.normals.get(id as usize).map_or(DVec3::ZERO, |n| Vec3::from_array(*n).as_dvec3());
        if normal.dot(own) < 0.0 { -normal } else { normal }
    })
}

/// The cosines between the normals that a file gives two faces at the ends of the edge they share, none where it
/// gives one of them none.
#[must_use]
pub fn file_cosines(mesh: &Mesh, edge: usize, faces: [u32; 2]) -> Option<[f32; 2]> {
    if mesh.corner_normals.is_empty() {
        return None;
    }
    let normal = |face: u32, vertex: u32| {
        let corner = mesh.triangles[face as usize].iter().position(|v| *v == vertex)?;
        let id = mesh.corner_normals.get(face as usize)?[corner];
        mesh.normals.get(id as usize).map(|normal| Vec3::from_array(*normal))
    };
    let cosine = |vertex: u32| Some(normal(faces[0], vertex)?.dot(normal(faces[1], vertex)?));
    let [a, b] = mesh.edges.vertices[edge];
    Some([cosine(a)?, cosine(b)?])
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
