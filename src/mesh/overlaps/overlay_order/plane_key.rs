//! [`OverlapCandidate`]s for an overlap: surfaces whose planes and boxes may meet.
//!
//! The key of a plane has three numbers: the squares of two coordinates of its normal, and its distance from
//! the middle of the model. Squares are equal for both sides of the plane. Rounding of the corners turns each
//! number into a range. Coplanar surfaces have overlapping keys.

use glam::DVec3;

use crate::geometry::space::bounds::Bounds;
use crate::geometry::space::triangles::{area_vector, longest_side_squared};
use crate::mesh::tolerances::MAX_OVERLAP_NORMAL_ERROR_RAD;
use crate::mesh::{FaceId, MaterialId, Mesh, PaintId};

/// Width of a cell in squared normal coordinates.
const NORMAL_CELL_WIDTH: f64 = 1.0 / 16.0;

/// Number of distance cells over the diagonal of the model.
const DISTANCE_CELLS_PER_DIAGONAL: f64 = 512.0;

/// Maximum number of distance cells of a plane. Surfaces with more are skipped.
const MAX_DISTANCE_CELLS: f64 = 8.0;

/// Range of a plane key in cell widths: squares of two normal coordinates, and distance from the middle.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PlaneKey {
    range: Bounds,
    /// False for slivers, whose plane is uncertain by more than [`MAX_OVERLAP_NORMAL_ERROR_RAD`] or
    /// [`MAX_DISTANCE_CELLS`].
    is_known: bool,
}

impl PlaneKey {
    /// Key of the plane of a face.
    pub(crate) fn of(mesh: &Mesh, face: u32) -> Self {
        let corners = mesh.corners(FaceId(face));
        // Each corner is accurate to half of the contact distance.
        let contact = mesh.extent(FaceId(face)).contact;
        let (across, longest) = (area_vector(corners), longest_side_squared(corners).sqrt());
        let area = across.length();
        let turn = 2.0 * contact * longest / area;
        let (normal, way) = (across / area, corners[0] - mesh.extents.middle);
        let reach = turn * (way.length() + longest) + 2.0 * contact;
        let squares = normal * normal / NORMAL_CELL_WIDTH;
        let step = (mesh.extents.diagonal / DISTANCE_CELLS_PER_DIAGONAL).max(f64::MIN_POSITIVE);
        let middle = DVec3::new(squares.x, squares.y, normal.dot(way).abs() / step);
        let reach = DVec3::new(2.0 * turn / NORMAL_CELL_WIDTH, 2.0 * turn / NORMAL_CELL_WIDTH, reach / step);
        let range @ Bounds { low, high } = Bounds { low: middle - reach, high: middle + reach };
        let is_known =
            turn <= MAX_OVERLAP_NORMAL_ERROR_RAD && high.z.floor() - low.z.floor() < MAX_DISTANCE_CELLS;
        Self { range, is_known }
    }

    /// Cells that the key may lie in; none if the plane is uncertain.
    pub(crate) fn cells(&self) -> impl Iterator<Item = [i64; 3]> + use<> {
        let (low, high) = (self.range.low.floor().as_i64vec3(), self.range.high.floor().as_i64vec3());
        let last = if self.is_known { high.x } else { low.x - 1 };
        let rows = (low.x..=last).flat_map(move |x| (low.y..=high.y).map(move |y| (x, y)));
        rows.flat_map(move |(x, y)| (low.z..=high.z).map(move |z| [x, y, z]))
    }
}

/// Surface in the sweep of one cell, with its box widened by the contact distance.
pub(crate) struct OverlapCandidate {
    pub(crate) around: Bounds,
    pub(crate) key: PlaneKey,
    pub(crate) colour: (MaterialId, PaintId),
    pub(crate) surface: u32,
}

impl OverlapCandidate {
    /// False only for surfaces of one colour, in different planes, or out of contact.
    #[inline]
    pub(crate) fn may_overlap(&self, other: &Self) -> bool {
        self.colour != other.colour
            && self.around.meets(&other.around)
            && self.key.range.meets(&other.key.range)
    }
}

/// The axis along which the candidates are most spread out.
pub(crate) fn widest_axis(own: &[OverlapCandidate]) -> usize {
    let size = Bounds::of(own.iter().map(|own| own.around.low)).size();
    (1..3).fold(0, |widest, axis| if size[axis] > size[widest] { axis } else { widest })
}
