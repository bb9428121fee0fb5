//! Which triangles have an area, by the scale of their part: the others hide nothing and do not count in its size.

use crate::parallel::prelude::*;
use glam::DVec3;

use crate::geometry::numbers::tolerance;
use crate::parallel::task_size::GRAIN;

/// Coordinates are known to some sixteen digits: no part is measured by less than this share of its largest
/// coordinate.
const SCALE_OF_LARGEST: f64 = 1.0 / 256.0;

/// The length that the tolerances of a part are fractions of, by its box.
pub(crate) fn scale_of(low: DVec3, high: DVec3) -> f64 {
    let largest = low.abs().max(high.abs()).max_element();
    low.distance(high).max(SCALE_OF_LARGEST * largest)
}

/// Whether a triangle has an area: whether it is higher than rounding, by the scale of its part.
#[inline]
pub(crate) fn has_area(corners: [DVec3; 3], scale: f64) -> bool {
    area_vector(corners, scale).is_some()
}

/// Whether a triangle has an area by its own scale alone: those without do not count in the scale of their part.
#[inline]
pub(crate) fn has_own_area(corners: [DVec3; 3]) -> bool {
    has_area(corners, 0.0)
}

/// Twice the area of a triangle along its normal; none where it has no area.
///
/// What does not count in the scale of its part may be larger than that, or farther away: its own scale counts as well.
#[inline]
pub(crate) fn area_vector([a, b, c]: [DVec3; 3], scale: f64) -> Option<DVec3> {
    let (u, v, w) = (b - a, c - a, c - b);
    let cross = u.cross(v);
    let longest_squared = u.length_squared().max(v.length_squared()).max(w.length_squared());
    // Most triangles are so high that neither a root nor their own scale, whose square is at most this, need be known.
    let largest = a.abs().max(b.abs()).max(c.abs()).max_element();
    let own_squared = (3.0 * longest_squared).max(SCALE_OF_LARGEST * SCALE_OF_LARGEST * largest * largest);
    let share = tolerance::DEGENERATE_HEIGHT_OF_PART * tolerance::DEGENERATE_HEIGHT_OF_PART;
    let limit = (1.0 + 1e-9) * share * longest_squared * own_squared.max(scale * scale);
    if limit > f64::MIN_POSITIVE && cross.length_squared() > limit {
        return Some(cross);
    }
    let longest = longest_squared.sqrt();
    let scale = scale.max(scale_of(a.min(b).min(c), a.max(b).max(c)));
    (cross.length() > tolerance::DEGENERATE_HEIGHT_OF_PART * scale * longest).then_some(cross)
}

/// Whether a face may have no area, whichever part it is of: the box is that of all faces and wires.
///
/// A part is measured by at most twice the scale of the whole: by its size, or by its coordinates relative to the origin of
/// the mesh.
pub(crate) fn may_have_flat_faces(
    positions: &[DVec3],
    triangles: &[[u32; 3]],
    (low, high): (DVec3, DVec3),
) -> bool {
    let scale = largest_scale(low, high);
    let is_flat = |t: &[u32; 3]| !has_area(t.map(|v| positions[v as usize]), scale);
    triangles.par_iter().with_min_len(GRAIN).any(is_flat)
}

/// A scale that no part exceeds, by the box of all.
pub(crate) fn largest_scale(low: DVec3, high: DVec3) -> f64 {
    2.0 * scale_of(low, high)
}
