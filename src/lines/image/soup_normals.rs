//! [`SoupNormals`]: normals of polygon soups, whose faces are not connected.
//!
//! Lines in the image need no connectivity, but they need the normals of the surface. Faces with corners
//! within a px of each other, which turn by less than a crease, count as one surface there. Closed surfaces
//! are not affected.

use crate::parallel::prelude::*;
use glam::{DVec3, IVec3};

use crate::mesh::{EdgeFaces, FaceId, Mesh};
use crate::view::View;

/// Largest distance of corners that count as one, px.
const MERGE_RADIUS_PX: f64 = 1.0;

/// Maximum number of corners that are used in each of the 27 cells around a corner. Where more meet within a
/// px, no single face is visible.
const MAX_CORNERS_PER_CELL: usize = 16;

/// Faces with corners at open edges, and the normals at their corners.
#[derive(Debug, Clone, Default)]
pub(crate) struct SoupNormals {
    /// Index of each face into `normals`, or [`NO_NORMALS`]; empty if there is no such face.
    number: Vec<u32>,
    normals: Vec<[DVec3; 3]>,
}

const NO_NORMALS: u32 = u32::MAX;

/// Corner of a face at an open vertex.
#[derive(Clone, Copy)]
struct LooseCorner {
    cell: IVec3,
    face: u32,
    position: DVec3,
    /// On the visible side; its length is twice the face's area.
    normal: DVec3,
}

impl SoupNormals {
    /// Normals of the loose faces in a view. Faces that differ by more than `crease_deg` stay separate.
    ///
    /// `normals` returns a face's own corner normals on its outer side, which are kept at corners that are
    /// not open.
    #[must_use]
    pub(crate) fn new(
        mesh: &Mesh,
        view: &View,
        crease_deg: f64,
        normals: impl Fn(u32) -> [DVec3; 3] + Sync,
    ) -> Self {
        if mesh.edges.border_count() == 0 {
            return Self::default();
        }
        let mut open = vec![false; mesh.positions.len()];
        for edge in 0..mesh.edges.len() {
            if matches!(mesh.edges.faces(edge), EdgeFaces::One(_)) {
                mesh.edges.vertices[edge].iter().for_each(|v| open[*v as usize] = true);
            }
        }
        let loose: Vec<u32> = (0..mesh.triangles.len() as u32)
            .filter(|face| mesh.triangles[*face as usize].iter().any(|v| open[*v as usize]))
            .collect();
        let reach = (MERGE_RADIUS_PX * view.frame.px_at(view.frame.focus)).max(f64::MIN_POSITIVE);
        let corners_of = |face: u32| {
            let normal = seen_normal(mesh, view, face);
            mesh.triangles[face as usize].iter().filter(|v| open[**v as usize]).map(move |v| {
                let position = mesh.positions[*v as usize];
                LooseCorner { cell: (position / reach).floor().as_ivec3(), face, position, normal }
            })
        };
        let mut corners: Vec<LooseCorner> = loose.iter().copied().flat_map(corners_of).collect();
        corners.par_sort_unstable_by_key(|corner| (corner.cell.to_array(), corner.face));
        let least = crease_deg.to_radians();
        let near = LooseCornerGrid {
            corners: &corners,
            reach,
            cosine: crate::geometry::numbers::portable_math::cos(least),
        };
        let normals_of = |face: &u32| {
            let mut own = normals(*face);
            let side = if view.facing[*face as usize] { 1.0 } else { -1.0 };
            for (normal, v) in own.iter_mut().zip(mesh.triangles[*face as usize]) {
                if open[v as usize] {
                    let position = mesh.positions[v as usize];
                    *normal = side
                        * near.normal(position, seen_normal(mesh, view, *face)).unwrap_or(*normal * side);
                }
            }
            own
        };
        let found: Vec<[DVec3; 3]> = loose.par_iter().map(normals_of).collect();
        let mut number = vec![NO_NORMALS; mesh.triangles.len()];
        for (i, face) in loose.iter().enumerate() {
            number[*face as usize] = i as u32;
        }
        Self { number, normals: found }
    }

    /// Corner normals of a face on its outer side, local space; none if it is not loose.
    #[inline]
    #[must_use]
    pub(crate) fn normals(&self, face: u32) -> Option<[DVec3; 3]> {
        let number = *self.number.get(face as usize)?;
        self.normals.get(number as usize).copied()
    }

    /// Whether a face has corners at open edges.
    #[inline]
    #[must_use]
    pub(crate) fn is_loose(&self, face: u32) -> bool {
        self.number.get(face as usize).is_some_and(|number| *number != NO_NORMALS)
    }

    /// Whether no face is loose.
    #[must_use]
    pub(crate) fn is_empty(&self) -> bool {
        self.normals.is_empty()
    }
}

/// Corners, sorted by grid cell.
struct LooseCornerGrid<'a> {
    corners: &'a [LooseCorner],
    reach: f64,
    cosine: f64,
}

impl LooseCornerGrid<'_> {
    /// Normal at a position of the surface that a face belongs to.
    fn normal(&self, position: DVec3, own: DVec3) -> Option<DVec3> {
        let cell = (position / self.reach).floor().as_ivec3();
        let unit = own.try_normalize()?;
        let mut sum = DVec3::ZERO;
        for (dx, dy) in (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (dx, dy))) {
            // Cells along z are consecutive.
            for dz in -1..=1 {
                let cell = cell.saturating_add(IVec3::new(dx, dy, dz));
                let first = self.corners.partition_point(|corner| corner.cell.to_array() < cell.to_array());
                let in_cell = self.corners[first..].iter().take_while(|corner| corner.cell == cell);
                for corner in in_cell.take(MAX_CORNERS_PER_CELL) {
                    let is_near = corner.position.distance_squared(position) <= self.reach * self.reach;
                    if is_near && corner.normal.dot(unit) >= self.cosine * corner.normal.length() {
                        sum += corner.normal;
                    }
                }
            }
        }
        sum.try_normalize()
    }
}

/// Normal of a face on its visible side; its length is twice the area.
fn seen_normal(mesh: &Mesh, view: &View, face: u32) -> DVec3 {
    let normal = mesh.area_vector(FaceId(face));
    if view.facing[face as usize] { normal } else { -normal }
}
