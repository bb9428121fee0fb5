//! [`common_area`]: overlap of two coplanar triangles.
//!
//! One triangle is clipped by the sides of the other, after Sutherland and Hodgman, "Reentrant polygon
//! clipping", CACM 17(1), 1974.

use crate::geometry::space::triangles::{area_vector, unit_normal};
use glam::{DVec2, DVec3};

/// Minimum cosine between the normals of coplanar triangles.
const MIN_COPLANAR_COSINE: f64 = 0.999;

/// Common area of two triangles, seen along the normal of the first. It is 0 unless the overlap is wider than
/// `contact` and the planes are within `contact` all over it.
pub(crate) fn common_area(one: &[DVec3; 3], two: &[DVec3; 3], contact: f64) -> f64 {
    let [a, b, _] = *one;
    let (normal, own) = (unit_normal(*one), area_vector(*two));
    let lean = own.dot(normal);
    let Some(right) = (b - a).try_normalize().filter(|_| lean.abs() > MIN_COPLANAR_COSINE * own.length())
    else {
        return 0.0;
    };
    let up = normal.cross(right);
    let flat = |p: DVec3| DVec2::new((p - a).dot(right), (p - a).dot(up));
    let corners = one.map(flat);
    let mut polygon = two.map(flat).to_vec();
    for k in 0..3 {
        let (from, to) = (corners[k], corners[(k + 1) % 3]);
        polygon = left_of(&polygon, from, to - from);
    }
    let next = || polygon.iter().cycle().skip(1);
    // Relative to a corner: for triangles that only touch, nothing but rounding remains.
    let corner = polygon.first().copied().unwrap_or_default();
    let area: f64 = polygon.iter().zip(next()).map(|(p, q)| (*p - corner).perp_dot(*q - corner)).sum();
    let around: f64 = polygon.iter().zip(next()).map(|(p, q)| p.distance(*q)).sum();
    // Height of the second plane over a point of the first.
    let height = |p: &DVec2| own.dot(two[0] - (a + right * p.x + up * p.y)) / lean;
    let is_common = polygon.len() > 2
        && area.abs() > contact * around
        && polygon.iter().all(|p| height(p).abs() <= contact);
    if is_common { area.abs() / 2.0 } else { 0.0 }
}

/// The part of a convex polygon to the left of a line.
fn left_of(polygon: &[DVec2], from: DVec2, way: DVec2) -> Vec<DVec2> {
    let side = |p: &DVec2| way.perp_dot(*p - from);
    let mut left = Vec::with_capacity(polygon.len() + 1);
    for (p, q) in polygon.iter().zip(polygon.iter().cycle().skip(1)) {
        let (at_p, at_q) = (side(p), side(q));
        if at_p >= 0.0 {
            left.push(*p);
        }
        if at_p.partial_cmp(&0.0) != at_q.partial_cmp(&0.0) && at_p * at_q < 0.0 {
            left.push(p.lerp(*q, at_p / (at_p - at_q)));
        }
    }
    left
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::dice::Dice;

    #[test]
    fn triangles_that_touch_at_corners_or_edges_have_no_common_area() {
        let mut dice = Dice::new(5);
        for _ in 0..500 {
            // Parallelograms around one corner, rotated and moved.
            let axes = [dice.point(1.0), dice.point(1.0), dice.point(1.0)];
            let [x, y] = [axes[0].normalize(), axes[0].cross(axes[1]).normalize()];
            let at = |u: f64, v: f64| axes[2] * 5.0 + x * u + y * v;
            let one = [at(0.0, 0.0), at(1.0, 0.0), at(0.0, 2.0)];
            for two in
                [[at(0.0, 0.0), at(-1.0, 0.0), at(0.0, -2.0)], [at(0.0, 0.0), at(1.0, 0.0), at(0.0, -2.0)]]
            {
                for k in 0..3 {
                    let turned = [two[k], two[(k + 1) % 3], two[(k + 2) % 3]];
                    assert_eq!(
                        [common_area(&one, &turned, 1e-6), common_area(&turned, &one, 1e-6)],
                        [0.0; 2]
                    );
                }
            }
            assert!(common_area(&one, &[at(0.1, 0.1), at(-1.0, 0.0), at(0.0, -2.0)], 1e-6) > 0.0);
        }
    }
}
