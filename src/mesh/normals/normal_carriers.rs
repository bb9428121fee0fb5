//! Narrow faces that are coplanar with a wider neighbour, within the rounding of the file.
//!
//! Flat polygons are often cut into narrow triangles. After rounding, a narrow triangle may tilt by any
//! angle: the error of its normal is the rounding divided by its height. A wider neighbour in the same plane
//! has a more accurate normal. Each narrow face therefore gets a *carrier*:
//!
//! 1. A face is unsure if rounding may turn its normal by more than [`MAX_NORMAL_ERROR_SINE`](tolerances::MAX_NORMAL_ERROR_SINE).
//! 2. The search crosses the longest edge to a neighbour of the same part whose plane contains all corners of
//!    the face, within the rounding. A face that is almost a line fits the planes on both sides. Its short
//!    edges show which part of it each neighbour meets, so the long edge is the one that vanishes.
//! 3. From an unsure neighbour, the search continues in the same way.
//!
//! The face takes the normal of its carrier, and is front-facing when its carrier is.

use crate::geometry::space::triangles::{area_vector, height, unit_normal, weight_sum};
use crate::mesh::edges::triangle_sides::sorted_sides;
use crate::parallel::prelude::*;
use glam::DVec3;

use super::face_normals::{is_narrow, normals_and_narrow};
use super::triangle_area::has_area;
use crate::geometry::numbers::portable_math::cos;
use crate::mesh::tolerances;
use crate::mesh::{Edges, Mesh, MeshMetrics, PartId};

/// Maximum number of faces in the search for a carrier.
const MAX_CARRIER_STEPS: usize = 16;

/// Data for the search for carriers.
pub(crate) struct CoplanarSearch<'a> {
    pub(crate) positions: &'a [DVec3],
    pub(crate) triangles: &'a [[u32; 3]],
    pub(crate) parts: &'a [PartId],
    pub(crate) edges: &'a Edges,
    pub(crate) extents: &'a MeshMetrics,
}

impl<'a> CoplanarSearch<'a> {
    /// Uses the faces of a mesh.
    pub(crate) fn of(mesh: &'a Mesh) -> Self {
        let Mesh { positions, triangles, face_part: parts, edges, extents, .. } = mesh;
        Self { positions, triangles, parts, edges, extents }
    }

    /// The neighbours whose planes contain a face, or that lie in its plane.
    pub(crate) fn neighbours_in_plane(&self, face: u32) -> Vec<u32> {
        let corners = self.corners(face);
        let is_in_plane =
            |candidate: &u32| self.holds(*candidate, &corners) || self.holds(face, &self.corners(*candidate));
        self.neighbours(face).filter(is_in_plane).collect()
    }

    /// Whether a face belongs to a curved surface: it has neighbours on all sides that turn by less than
    /// [`MAX_FACET_DEG`](tolerances::MAX_FACET_DEG).
    pub(crate) fn is_facet(&self, face: u32) -> bool {
        let normal = |face: u32| unit_normal(self.corners(face));
        let (own_normal, min_cosine) = (normal(face), cos(tolerances::MAX_FACET_DEG.to_radians()));
        self.neighbours(face).filter(|neighbour| normal(*neighbour).dot(own_normal) > min_cosine).count() == 3
    }

    /// Smallest height of a face, world units.
    pub(crate) fn height_of(&self, face: u32) -> f64 {
        height(&self.corners(face))
    }

    /// Pairs of the unsure faces (ascending) and their carriers. Faces without a carrier are left out.
    pub(crate) fn carriers(&self, unsure: &[u32]) -> Vec<[u32; 2]> {
        let carrier = |face: &u32| Some([*face, self.carrier(*face)?]);
        unsure.par_iter().with_min_len(64).filter_map(carrier).collect()
    }

    fn corners(&self, face: u32) -> [DVec3; 3] {
        self.triangles[face as usize].map(|v| self.positions[v as usize])
    }

    fn rounding(&self, face: u32) -> f64 {
        self.extents.part(self.parts[face as usize]).rounding
    }

    fn is_unsure(&self, face: u32) -> bool {
        let rounding = self.rounding(face);
        let corners = self.corners(face);
        // Faces without area are skipped.
        rounding > 0.0
            && is_narrow(height(&corners), rounding)
            && has_area(corners, self.extents.part(self.parts[face as usize]).scale)
    }

    /// The first sure face on a path across longest edges, through planes that contain the face.
    fn carrier(&self, face: u32) -> Option<u32> {
        let corners = self.corners(face);
        let mut visited = vec![face];
        while let Some(at) = visited.last().copied().filter(|_| visited.len() < MAX_CARRIER_STEPS) {
            let next = self
                .neighbours(at)
                .find(|candidate| !visited.contains(candidate) && self.holds(*candidate, &corners))?;
            if !self.is_unsure(next) {
                return Some(next);
            }
            visited.push(next);
        }
        None
    }

    /// The neighbours of a face in the same part, starting across the longest edge.
    fn neighbours(&self, face: u32) -> impl Iterator<Item = u32> {
        let length =
            |[v, w]: [u32; 2]| self.positions[v as usize].distance_squared(self.positions[w as usize]);
        let mut sides = sorted_sides(self.triangles[face as usize]);
        sides.sort_unstable_by(|p, q| length(*q).total_cmp(&length(*p)).then(p.cmp(q)));
        let part = self.parts[face as usize];
        let neighbour_across =
            move |[v, w]: [u32; 2]| self.edges.faces(self.edges.between(v, w)?).across(face);
        sides
            .into_iter()
            .filter_map(neighbour_across)
            .filter(move |neighbour| self.parts[*neighbour as usize] == part)
    }

    /// Whether points lie in the plane of a face, within the rounding.
    fn holds(&self, face: u32, points: &[DVec3; 3]) -> bool {
        let corners = self.corners(face);
        points.iter().all(|point| is_in_plane(&corners, *point, self.rounding(face)))
    }
}

/// Whether a point may lie in the plane of a triangle, if rounding has moved the point and each corner by up
/// to `rounding`.
///
/// At the point, the plane moves by the displacements of its corners, weighted by the barycentric coordinates
/// of the point.
#[must_use]
pub(crate) fn is_in_plane(corners: &[DVec3; 3], point: DVec3, rounding: f64) -> bool {
    let normal = area_vector(*corners);
    let area = normal.length_squared();
    let weights = weight_sum(*corners, normal, point);
    let distance = normal.dot(point - corners[0]).abs();
    distance * area <= rounding * (area + weights) * area.sqrt()
}

/// Normals of all faces, and the carriers of narrow ones.
pub(crate) fn normals_and_carriers(search: &CoplanarSearch) -> (Vec<[f32; 3]>, Vec<[u32; 2]>) {
    let measure = |face: usize| {
        let part = search.extents.part(search.parts[face]);
        (part.scale, part.rounding)
    };
    let (mut normals, narrow) = normals_and_narrow(search.positions, search.triangles, measure);
    let carriers = search.carriers(&narrow);
    for [face, carrier] in &carriers {
        normals[*face as usize] = normals[*carrier as usize];
    }
    (normals, carriers)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{FaceId, Mesh, Soup};

    /// Two wide triangles with a narrow one between them, whose middle corner is offset by `up` and `aside`.
    fn mesh_with_narrow_face(up: f64, aside: f64) -> Mesh {
        let points = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, aside, up], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0]];
        Mesh::build(Soup {
            positions: points.map(DVec3::from_array).to_vec(),
            triangles: vec![[0, 3, 1], [0, 1, 2], [0, 2, 4], [2, 1, 4]],
            steps: vec![1e-6],
            ..Soup::default()
        })
    }

    #[test]
    fn narrow_faces_take_the_normal_of_their_surrounding_plane() {
        // Within the rounding, the narrow face may tilt by any angle.
        let leaning = mesh_with_narrow_face(1e-6, 1e-6);
        let across = (0..4).map(FaceId).filter(|f| !leaning.is_degenerate(*f));
        assert_eq!(across.clone().count(), 4);
        assert!(across.into_iter().all(|f| leaning.face_normals[f.index()][2] > 0.999_99));
        assert_eq!(leaning.carriers.len(), 1);
        // A real fold is kept.
        let folded = mesh_with_narrow_face(0.1, 0.1);
        assert!(folded.carriers.is_empty());
        assert!(folded.face_normals.iter().any(|n| n[2] < 0.9));
    }
}
