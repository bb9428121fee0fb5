//! [`VertexFans`]: the curved faces around each smooth vertex, with their shares of area.

use crate::parallel::prelude::*;
use glam::DVec3;

use crate::geometry::lists::csr_lists::{CsrLists, csr_lists};
use crate::mesh::{FaceId, Mesh, PartId};
use crate::parallel::task_size::MIN_TASK_ITEMS;
use crate::surface::SmoothNormals;
use crate::surface::normals::smooth_normals::NO_NORMAL;

/// The curved faces around each smooth vertex, and a coordinate frame in each face.
///
/// Flat faces and faces without area are in no fan.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct VertexFans {
    corners: CsrLists<u32>,
    /// One per face.
    pub(crate) frames: Vec<FaceFrame>,
}

/// Coordinate frame in the plane of a face, and the area of each corner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FaceFrame {
    /// Unit vectors that form a right-handed frame with the normal; zero where the face is in no fan.
    pub u: DVec3,
    pub v: DVec3,
    /// Voronoi area of each corner, world units squared.
    pub areas: [f64; 3],
}

impl VertexFans {
    /// The fans of a mesh.
    #[must_use]
    pub(crate) fn new(mesh: &Mesh, smooth: &SmoothNormals) -> Self {
        let faces = smooth.corners.len();
        let frames: Vec<FaceFrame> = (0..faces)
            .into_par_iter()
            .with_min_len(MIN_TASK_ITEMS)
            .map(|face| FaceFrame::of(mesh, smooth, face).unwrap_or(FaceFrame::NONE))
            .collect();
        let corners = csr_lists(smooth.vertices.len(), |put| {
            for face in (0..faces).filter(|face| frames[*face].u != DVec3::ZERO) {
                for (corner, v) in smooth.corners[face].into_iter().enumerate() {
                    put(v as usize, (face as u32) << 2 | corner as u32);
                }
            }
        });
        Self { corners, frames }
    }

    /// The faces around a smooth vertex, with the index of their corner there, in mesh order.
    #[inline]
    pub(crate) fn around(&self, vertex: usize) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.corners.of(vertex).iter().map(|corner| ((corner >> 2) as usize, (corner & 3) as usize))
    }

    /// Body of each of `vertices` smooth vertices, by its first part: that of the first face around the
    /// vertex.
    #[must_use]
    pub(crate) fn bodies(&self, mesh: &Mesh, vertices: usize) -> Vec<PartId> {
        let body = |vertex| {
            self.around(vertex).next().map_or_else(PartId::default, |(face, _)| mesh.body(face as u32))
        };
        (0..vertices).map(body).collect()
    }

    /// Whether a face is in the fans of its corners.
    #[inline]
    #[must_use]
    pub(crate) fn holds(&self, face: usize) -> bool {
        self.frames[face].u != DVec3::ZERO
    }

    /// Voronoi area of a smooth vertex over its curved faces, world units squared.
    #[must_use]
    pub(crate) fn area(&self, vertex: usize) -> f64 {
        self.around(vertex).map(|(face, corner)| self.frames[face].areas[corner]).sum()
    }
}

impl FaceFrame {
    const NONE: Self = Self { u: DVec3::ZERO, v: DVec3::ZERO, areas: [0.0; 3] };

    fn of(mesh: &Mesh, smooth: &SmoothNormals, face: usize) -> Option<Self> {
        if smooth.corners[face][0] == NO_NORMAL || mesh.is_degenerate(FaceId::from(face)) {
            return None;
        }
        let points = mesh.corners(FaceId::from(face));
        let sides = sides(&points);
        let u = sides[0].try_normalize()?;
        let cross = sides[0].cross(sides[1]);
        let normal = cross.try_normalize()?;
        Some(Self { u, v: normal.cross(u), areas: corner_areas(sides, cross.length() / 2.0) })
    }

    /// The unit normal.
    #[inline]
    pub(crate) fn normal(&self) -> DVec3 {
        self.u.cross(self.v)
    }
}

/// The sides of a triangle, each opposite its corner.
#[inline]
pub(crate) fn sides([a, b, c]: &[DVec3; 3]) -> [DVec3; 3] {
    [c - b, a - c, b - a]
}

/// Voronoi areas of the corners of a triangle, cut off at the sides of an obtuse triangle.
///
/// Source: Meyer, Desbrun, Schröder and Barr, "Discrete differential-geometry operators for triangulated
/// 2-manifolds", 2002, section 3.3.
fn corner_areas(sides: [DVec3; 3], area: f64) -> [f64; 3] {
    let squares = sides.map(DVec3::length_squared);
    // Unnormalised barycentric coordinates of the circumcentre.
    let centre = [0, 1, 2].map(|i| {
        let (next, last) = ((i + 1) % 3, (i + 2) % 3);
        squares[i] * (squares[next] + squares[last] - squares[i])
    });
    if let Some(obtuse) = (0..3).find(|i| centre[*i] <= 0.0) {
        let (next, last) = ((obtuse + 1) % 3, (obtuse + 2) % 3);
        let mut areas = [0.0; 3];
        areas[next] = -0.25 * squares[last] * area / sides[obtuse].dot(sides[last]);
        areas[last] = -0.25 * squares[next] * area / sides[obtuse].dot(sides[next]);
        areas[obtuse] = area - areas[next] - areas[last];
        return areas;
    }
    let scale = 0.5 * area / (centre[0] + centre[1] + centre[2]);
    [centre[1] + centre[2], centre[2] + centre[0], centre[0] + centre[1]].map(|part| part * scale)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corner_areas_are_voronoi_areas_that_add_up() {
        let areas = |points: [[f64; 2]; 3]| {
            let points = points.map(|[x, y]| DVec3::new(x, y, 0.0));
            let sides = sides(&points);
            corner_areas(sides, sides[0].cross(sides[1]).length() / 2.0)
        };
        let even = areas([[0.0, 0.0], [1.0, 0.0], [0.5, 0.75f64.sqrt()]]);
        assert!(even.iter().all(|a| (a - 0.75f64.sqrt() / 6.0).abs() < 1e-12), "{even:?}");
        let right = areas([[0.0, 0.0], [2.0, 0.0], [0.0, 2.0]]);
        assert!(right.iter().zip([1.0, 0.5, 0.5]).all(|(a, b)| (a - b).abs() < 1e-12), "{right:?}");
        let obtuse = areas([[0.0, 0.0], [4.0, 0.0], [2.0, 0.5]]);
        assert!((obtuse.iter().sum::<f64>() - 1.0).abs() < 1e-12 && obtuse.iter().all(|a| *a > 0.0));
        // The Voronoi area of an end of the long side is bounded by the bisector of the neighbouring side.
        let half = 17f64.sqrt() / 4.0;
        assert!((obtuse[0] - half * half / 4.0 / 2.0 * 1.0).abs() < 0.02, "{obtuse:?}");
    }
}
