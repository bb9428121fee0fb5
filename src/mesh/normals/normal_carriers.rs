//! Narrow faces that lie in the plane of a wider neighbour, within the rounding of the file.
//!
//! Programs cut flat polygons into triangles, and some of these are narrow. Once the coordinates are rounded, a narrow triangle leans
//! by any angle: its normal is as uncertain as the rounding divided by its height. Its wider neighbour in the same plane knows the
//! normal better. So each narrow face gets a *carrier*:
//!
//! 1. A face is unsure if rounding may turn its normal by more than [`UNSURE_SINE`](tolerance::UNSURE_SINE).
//! 2. The search goes on beyond its longest edge, to a neighbour of the same part whose plane holds all its corners, within the rounding.
//!    A face that is little more than a line lies in the planes on both sides of it: at its short edges, which part of it each of the
//!    faces there meets is known, so that the long edge is the one that vanishes.
//! 3. From a neighbour that is unsure itself, the search goes on in the same way.
//!
//! The face takes over the normal of its carrier, and turns to the eye when its carrier does.

use crate::parallel::prelude::*;
use glam::DVec3;

use super::triangle_area::has_area;
use crate::geometry::numbers::portable_math::cos;
use crate::geometry::numbers::tolerance;
use crate::mesh::{EdgeFaces, Edges, Extents, Mesh, PartId};

/// The search for a carrier ends after this many faces.
const MAX_STEPS: usize = 16;

/// What is needed to find carriers.
pub(crate) struct Faces<'a> {
    pub(crate) positions: &'a [DVec3],
    pub(crate) triangles: &'a [[u32; 3]],
    pub(crate) parts: &'a [PartId],
    pub(crate) edges: &'a Edges,
    pub(crate) extents: &'a Extents,
}

impl<'a> Faces<'a> {
    /// The faces of a mesh.
    pub(crate) fn of(mesh: &'a Mesh) -> Self {
        let Mesh { positions, triangles, face_part: parts, edges, extents, .. } = mesh;
        Self { positions, triangles, parts, edges, extents }
    }

    /// The neighbours of a face whose planes hold it, or that lie in its own plane.
    pub(crate) fn neighbours_in_plane(&self, face: u32) -> Vec<u32> {
        let corners = self.corners(face);
        let is_in_plane =
            |other: &u32| self.holds(*other, &corners) || self.holds(face, &self.corners(*other));
        self.neighbours(face).filter(is_in_plane).collect()
    }

    /// Whether a face is one of those of a bent surface: whether it has neighbours on all sides, which turn by less than
    /// [`MAX_FACET_DEG`](tolerance::MAX_FACET_DEG).
    pub(crate) fn is_facet(&self, face: u32) -> bool {
        let normal = |face: u32| {
            let [a, b, c] = self.corners(face);
            (b - a).cross(c - a).normalize_or_zero()
        };
        let (own, least) = (normal(face), cos(tolerance::MAX_FACET_DEG.to_radians()));
        self.neighbours(face).filter(|other| normal(*other).dot(own) > least).count() == 3
    }

    /// The least height of a face.
    pub(crate) fn height_of(&self, face: u32) -> f64 {
        height(&self.corners(face))
    }

    /// Each of the unsure faces, ascending, with its carrier, where it has one.
    pub(crate) fn carriers(&self, unsure: &[u32]) -> Vec<[u32; 2]> {
        let carrier = |face: &u32| Some([*face, self.carrier(*face)?]);
        unsure.par_iter().with_min_len(64).filter_map(carrier).collect()
    }

    fn corners(&self, face: u32) -> [DVec3; 3] {
        self.triangles[face as usize].map(|v| self.positions[v as usize])
    }

    fn rounding(&self, face: u32) -> f64 {
        self.extents.of(self.parts[face as usize]).rounding
    }

    fn is_unsure(&self, face: u32) -> bool {
        let rounding = self.rounding(face);
        let corners = self.corners(face);
        // Faces without area are looked through.
        rounding > 0.0
            && is_narrow(height(&corners), rounding)
            && has_area(corners, self.extents.of(self.parts[face as usize]).scale)
    }

    /// The first face that is sure on the way over longest edges, through planes that hold the face.
    fn carrier(&self, face: u32) -> Option<u32> {
        let corners = self.corners(face);
        let mut way = vec![face];
        while let Some(at) = way.last().copied().filter(|_| way.len() < MAX_STEPS) {
            let next =
                self.neighbours(at).find(|other| !way.contains(other) && self.holds(*other, &corners))?;
            if !self.is_unsure(next) {
                return Some(next);
            }
            way.push(next);
        }
        None
    }

    /// The faces of the same part beyond the edges of a face, that beyond the longest edge first.
    fn neighbours(&self, face: u32) -> impl Iterator<Item = u32> {
        let [a, b, c] = self.triangles[face as usize];
        let length =
            |[v, w]: [u32; 2]| self.positions[v as usize].distance_squared(self.positions[w as usize]);
        let mut sides = [[a, b], [b, c], [c, a]].map(|[v, w]| [v.min(w), v.max(w)]);
        sides.sort_unstable_by(|p, q| length(*q).total_cmp(&length(*p)).then(p.cmp(q)));
        let part = self.parts[face as usize];
        let beyond = move |side: [u32; 2]| {
            let edge = self.edges.vertices.binary_search(&side).ok()?;
            match self.edges.faces(edge) {
                EdgeFaces::Two { faces: [p, q], same_way: false } => Some(if p == face { q } else { p }),
                _ => None,
            }
        };
        sides.into_iter().filter_map(beyond).filter(move |other| self.parts[*other as usize] == part)
    }

    /// Whether points lie in the plane of a face, within the rounding.
    fn holds(&self, face: u32, points: &[DVec3; 3]) -> bool {
        let corners = self.corners(face);
        points.iter().all(|point| is_in_plane(&corners, *point, self.rounding(face)))
    }
}

/// Whether a point may lie in the plane of a triangle, if rounding has moved it and each corner by up to `rounding`.
///
/// The plane moves by the sum of what its corners move by, each times the barycentric weight of the point.
#[must_use]
pub fn is_in_plane([a, b, c]: &[DVec3; 3], point: DVec3, rounding: f64) -> bool {
    let normal = (*b - *a).cross(*c - *a);
    let area = normal.length_squared();
    let weight = |p: DVec3, q: DVec3| (p - point).cross(q - point).dot(normal).abs();
    let weights = weight(*a, *b) + weight(*b, *c) + weight(*c, *a);
    let distance = normal.dot(point - *a).abs();
    distance * area <= rounding * (area + weights) * area.sqrt()
}

/// The least height of a triangle: its distance to being a line.
#[must_use]
pub fn height(&[a, b, c]: &[DVec3; 3]) -> f64 {
    let longest = (b - a).length_squared().max((c - a).length_squared()).max((c - b).length_squared());
    if longest > 0.0 { (b - a).cross(c - a).length() / longest.sqrt() } else { 0.0 }
}

/// Whether rounding may turn the normal of a face of this height by more than [`UNSURE_SINE`](tolerance::UNSURE_SINE).
#[inline]
pub(crate) fn is_narrow(height: f64, rounding: f64) -> bool {
    height * tolerance::UNSURE_SINE < 2.0 * rounding
}

/// Gives each face the normal of its carrier.
pub(crate) fn take_over(carriers: &[[u32; 2]], normals: &mut [[f32; 3]]) {
    for [face, carrier] in carriers {
        normals[*face as usize] = normals[*carrier as usize];
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{FaceId, Mesh, Soup};

    /// Two wide triangles and a narrow one between them, whose middle corner is off by `up` and `aside`.
    fn mesh(up: f64, aside: f64) -> Mesh {
        let points = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, aside, up], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0]];
        Mesh::build(Soup {
            positions: points.map(DVec3::from_array).to_vec(),
            triangles: vec![[0, 3, 1], [0, 1, 2], [0, 2, 4], [2, 1, 4]],
            steps: vec![1e-6],
            ..Soup::default()
        })
    }

    #[test]
    fn a_narrow_face_takes_over_the_normal_of_its_plane() {
        // Within the rounding the narrow face may lean by any angle.
        let leaning = mesh(1e-6, 1e-6);
        let across = (0..4).map(FaceId).filter(|f| !leaning.is_degenerate(*f));
        assert_eq!(across.clone().count(), 4);
        assert!(across.into_iter().all(|f| leaning.face_normals[f.index()][2] > 0.999_99));
        assert_eq!(leaning.carriers.len(), 1);
        // A real fold stays one.
        let folded = mesh(0.1, 0.1);
        assert!(folded.carriers.is_empty());
        assert!(folded.face_normals.iter().any(|n| n[2] < 0.9));
    }
}
