//! Areas, normals and barycentric coordinates of triangles in space, and distances from them.

use glam::DVec3;

/// Normal of a triangle, with the length of twice its area.
#[inline]
pub(crate) fn area_vector([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a)
}

/// Area of a triangle.
#[inline]
pub(crate) fn area(corners: [DVec3; 3]) -> f64 {
    area_vector(corners).length() / 2.0
}

/// Unit normal of a triangle; zero without an area.
#[inline]
pub(crate) fn unit_normal(corners: [DVec3; 3]) -> DVec3 {
    area_vector(corners).normalize_or_zero()
}

/// Square of the longest side.
#[inline]
pub(crate) fn longest_side_squared([a, b, c]: [DVec3; 3]) -> f64 {
    a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a))
}

/// Smallest height of a triangle: its distance from a line.
pub(crate) fn height(corners: &[DVec3; 3]) -> f64 {
    let longest = longest_side_squared(*corners);
    if longest > 0.0 { area_vector(*corners).length() / longest.sqrt() } else { 0.0 }
}

/// Sum of the absolute barycentric coordinates of a point, times the squared length of the area vector.
#[inline]
pub(crate) fn weight_sum([a, b, c]: [DVec3; 3], normal: DVec3, point: DVec3) -> f64 {
    let weight = |p: DVec3, q: DVec3| (p - point).cross(q - point).dot(normal).abs();
    weight(a, b) + weight(b, c) + weight(c, a)
}

/// Barycentric coordinates of a point in the plane of a triangle. Without an area, those of the first corner.
pub(crate) fn weights([a, b, c]: [DVec3; 3], at: DVec3) -> [f64; 3] {
    let normal = area_vector([a, b, c]);
    let whole = normal.length_squared();
    let part = |p: DVec3, q: DVec3| (p - at).cross(q - at).dot(normal) / whole;
    if whole > 0.0 { [part(b, c), part(c, a), part(a, b)] } else { [1.0, 0.0, 0.0] }
}

/// The point of a triangle with the given barycentric coordinates.
#[inline]
pub(crate) fn on(corners: &[DVec3; 3], weights: DVec3) -> DVec3 {
    corners[0] * weights.x + corners[1] * weights.y + corners[2] * weights.z
}

/// Squared distance of a point from a triangle.
pub(crate) fn squared_distance(point: DVec3, corners: &[DVec3; 3]) -> f64 {
    (on(corners, nearest_weights(point, corners)) - point).length_squared()
}

/// Distance along a ray to a triangle, if between 0 and `reach`, in lengths of `direction`.
///
/// Source: Möller and Trumbore, "Fast, minimum storage ray/triangle intersection", 1997.
#[inline]
pub(crate) fn ray_hit([a, b, c]: &[DVec3; 3], start: DVec3, direction: DVec3, reach: f64) -> Option<f64> {
    let (u, v) = (*b - *a, *c - *a);
    let across = direction.cross(v);
    let volume = u.dot(across);
    if volume == 0.0 {
        return None;
    }
    let from = start - *a;
    let s = from.dot(across) / volume;
    let turned = from.cross(u);
    let t = direction.dot(turned) / volume;
    let at = v.dot(turned) / volume;
    (s >= 0.0 && t >= 0.0 && s + t <= 1.0 && at > 0.0 && at < reach).then_some(at)
}

/// Barycentric weights of the nearest point on a triangle, by its Voronoi regions.
///
/// Source: Ericson, "Real-Time Collision Detection", 5.1.5.
pub(crate) fn nearest_weights(point: DVec3, [a, b, c]: &[DVec3; 3]) -> DVec3 {
    let (ab, ac, ap) = (b - a, c - a, point - a);
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return DVec3::X;
    }
    let bp = point - b;
    let (d3, d4) = (ab.dot(bp), ac.dot(bp));
    if d3 >= 0.0 && d4 <= d3 {
        return DVec3::Y;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        let t = d1 / (d1 - d3);
        return DVec3::new(1.0 - t, t, 0.0);
    }
    let cp = point - c;
    let (d5, d6) = (ab.dot(cp), ac.dot(cp));
    if d6 >= 0.0 && d5 <= d6 {
        return DVec3::Z;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        let t = d2 / (d2 - d6);
        return DVec3::new(1.0 - t, 0.0, t);
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        let t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return DVec3::new(0.0, 1.0 - t, t);
    }
    let whole = va + vb + vc;
    let weights = DVec3::new(va, vb, vc) / whole;
    if weights.is_finite() { weights } else { DVec3::X }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distance_from_a_triangle_is_exact() {
        let triangle = [DVec3::ZERO, DVec3::X, DVec3::Y];
        for (p, wanted) in [
            (DVec3::new(0.2, 0.2, -3.0), 3.0),
            (DVec3::new(0.5, -2.0, 0.0), 2.0),
            (DVec3::new(4.0, -4.0, 0.0), 5.0),
            (DVec3::new(1.0, 1.0, 0.0), 0.5_f64.sqrt()),
            (DVec3::new(0.3, 0.3, 0.0), 0.0),
        ] {
            assert!((squared_distance(p, &triangle).sqrt() - wanted).abs() < 1e-12, "{p}");
        }
    }
    #[test]
    fn weights_are_barycentric_coordinates() {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let found = weights(corners, DVec3::new(0.25, 0.5, 0.0));
        assert!((DVec3::from_array(found) - DVec3::new(0.25, 0.25, 0.5)).length() < 1e-12);
    }
}
