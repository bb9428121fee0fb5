//! [`common_area`]: by how much two triangles overlap in one plane.
//!
//! One is clipped by the sides of the other, after Sutherland and Hodgman, "Reentrant polygon clipping", CACM 17(1), 1974.

use glam::{DVec2, DVec3};

/// Planes whose normals lie at a smaller cosine are not compared.
const MIN_COSINE: f64 = 0.999;

/// The common area of two triangles, seen along the normal of the first, if it is wider than `contact` and their planes are no farther
/// apart all over it; else 0.
pub(crate) fn common_area(one: &[DVec3; 3], two: &[DVec3; 3], contact: f64) -> f64 {
    let [a, b, c] = *one;
    let normal = (b - a).cross(c - a).normalize_or_zero();
    let own = (two[1] - two[0]).cross(two[2] - two[0]);
    let lean = own.dot(normal);
    let Some(right) = (b - a).try_normalize().filter(|_| lean.abs() > MIN_COSINE * own.length()) else {
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
    // From a corner of it: where triangles only touch, nothing is left but what rounding makes.
    let corner = polygon.first().copied().unwrap_or_default();
    let area: f64 = polygon.iter().zip(next()).map(|(p, q)| (*p - corner).perp_dot(*q - corner)).sum();
    let around: f64 = polygon.iter().zip(next()).map(|(p, q)| p.distance(*q)).sum();
    // How far the plane of the second lies over a point of the first.
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
    fn triangles_that_touch_at_a_corner_or_along_an_edge_have_no_area_in_common() {
        let mut dice = Dice::new(5);
        for _ in 0..500 {
            // Parallelograms round one corner, turned and moved.
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
