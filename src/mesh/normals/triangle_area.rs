//! Decides which triangles have an area, relative to the scale of their part. Others hide nothing and do not
//! count for its size.

use crate::parallel::prelude::*;
use glam::DVec3;

use crate::mesh::tolerances;
use crate::parallel::task_size::MIN_TASK_ITEMS;

/// Minimum scale of a part, as a share of its largest coordinate: double precision resolves about sixteen
/// digits.
const MIN_SCALE_OF_COORDINATE: f64 = 1.0 / 256.0;

/// Reference length for the tolerances of a part, from its box.
pub(crate) fn scale_of(low: DVec3, high: DVec3) -> f64 {
    let largest = low.abs().max(high.abs()).max_element();
    low.distance(high).max(MIN_SCALE_OF_COORDINATE * largest)
}

/// Whether the height of a triangle exceeds rounding at the scale of its part.
#[inline]
pub(crate) fn has_area(corners: [DVec3; 3], scale: f64) -> bool {
    area_vector(corners, scale).is_some()
}

/// Whether a triangle has an area at its own scale. Others do not count for the scale of their part.
#[inline]
pub(crate) fn has_own_area(corners: [DVec3; 3]) -> bool {
    has_area(corners, 0.0)
}

/// Normal of a triangle, with the length of twice its area; `None` if it has no area.
///
/// A triangle that does not count for the scale of its part may be larger or farther away, so its own scale
/// is used as well.
#[inline]
pub(crate) fn area_vector([a, b, c]: [DVec3; 3], scale: f64) -> Option<DVec3> {
    let (u, v, w) = (b - a, c - a, c - b);
    let cross = u.cross(v);
    let longest_squared = u.length_squared().max(v.length_squared()).max(w.length_squared());
    // Fast acceptance for most triangles, without a square root and without their exact scale. The square of
    // that scale is at most `own_squared`.
    let largest = a.abs().max(b.abs()).max(c.abs()).max_element();
    let own_squared =
        (3.0 * longest_squared).max(MIN_SCALE_OF_COORDINATE * MIN_SCALE_OF_COORDINATE * largest * largest);
    let share = tolerances::DEGENERATE_HEIGHT_OF_PART * tolerances::DEGENERATE_HEIGHT_OF_PART;
    let limit = tolerances::AREA_ROUNDING_FACTOR * share * longest_squared * own_squared.max(scale * scale);
    if limit > f64::MIN_POSITIVE && cross.length_squared() > limit {
        return Some(cross);
    }
    let longest = longest_squared.sqrt();
    let scale = scale.max(scale_of(a.min(b).min(c), a.max(b).max(c)));
    (cross.length() > tolerances::DEGENERATE_HEIGHT_OF_PART * scale * longest).then_some(cross)
}

/// Whether any face may have no area, for any assignment to parts. The box is that of all faces and wires.
///
/// The scale of a part is at most twice that of the whole, from its size or from its coordinates relative to
/// the origin.
pub(crate) fn may_have_flat_faces(
    positions: &[DVec3],
    triangles: &[[u32; 3]],
    (low, high): (DVec3, DVec3),
) -> bool {
    let scale = largest_scale(low, high);
    let is_flat = |t: &[u32; 3]| !has_area(t.map(|v| positions[v as usize]), scale);
    triangles.par_iter().with_min_len(MIN_TASK_ITEMS).any(is_flat)
}

/// Upper bound for the scale of every part, from the box of everything.
pub(crate) fn largest_scale(low: DVec3, high: DVec3) -> f64 {
    2.0 * scale_of(low, high)
}
