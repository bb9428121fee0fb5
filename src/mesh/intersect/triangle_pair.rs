//! [`cross`]: intersection of two triangles, decided by exact predicates.
//!
//! 1. Each triangle is clipped to the intersection line of both planes, which gives two intervals.
//! 2. Their overlap is the common segment.
//! 3. Each end stores which edge pierces which triangle, so that neighbouring segments join by identity.
//!
//! Source: T. Möller, "A fast triangle-triangle intersection test", Journal of Graphics Tools 2(2), 1997. The
//! signs here come from exact predicates.

use glam::DVec3;
use robust::{Coord3D, orient3d};

use crate::geometry::space::triangles::weight_sum;
use crate::mesh::PartMetrics;
use crate::mesh::tolerances::{self, OVERLAP_OF_PART, OVERLAP_OF_ROUNDING, PARALLEL_SINE, PLANE_OF_PART};

/// Tolerances for the intersection of two triangles, world units.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PairTolerance {
    /// Maximum distance of a vertex that counts as in the plane.
    pub plane: f64,
    /// Maximum length of an overlap that counts as a point.
    pub overlap: f64,
    /// Maximum displacement of each vertex by rounding.
    pub rounding: f64,
}

impl PairTolerance {
    /// Tolerance for triangles with exact coordinates of a part with this scale.
    #[inline]
    #[must_use]
    pub(crate) fn of_exact(scale: f64) -> Self {
        Self { plane: PLANE_OF_PART * scale, overlap: OVERLAP_OF_PART * scale, rounding: 0.0 }
    }

    /// Tolerance for triangles of a part.
    #[inline]
    #[must_use]
    pub(crate) fn of_part(part: &PartMetrics) -> Self {
        let exact = Self::of_exact(part.scale);
        let overlap = exact.overlap.max(OVERLAP_OF_ROUNDING * part.rounding);
        Self { overlap, rounding: part.rounding, ..exact }
    }

    /// Tolerance for triangles of two parts: the larger of both.
    #[inline]
    #[must_use]
    pub(crate) fn and(self, other: Self) -> Self {
        Self {
            plane: self.plane.max(other.plane),
            overlap: self.overlap.max(other.overlap),
            rounding: self.rounding.max(other.rounding),
        }
    }
}

/// Triangle with its corners in mesh order.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Triangle {
    /// Vertices of the mesh.
    pub vertices: [u32; 3],
    /// Their positions.
    pub corners: [DVec3; 3],
    /// Normal with the length of twice the area.
    pub normal: DVec3,
    /// Whether the normal is accurate enough for a rejection without exact arithmetic.
    trusted: bool,
}

impl Triangle {
    /// The triangle of three vertices.
    #[inline]
    #[must_use]
    pub(crate) fn new(positions: &[DVec3], vertices: [u32; 3]) -> Self {
        let corners = vertices.map(|v| positions[v as usize]);
        let (e1, e2) = (corners[1] - corners[0], corners[2] - corners[0]);
        let normal = e1.cross(e2);
        // The rounding error of normal·(q − corner) is below 12 ε |e1||e2| times the distance to q. If the
        // sine of the corner is above 1/100, this is below 1200 ε of that distance, well inside the plane
        // tolerance.
        let min_squared_length =
            tolerances::MIN_TRUSTED_SINE_SQUARED * e1.length_squared() * e2.length_squared();
        let trusted = normal.length_squared() > min_squared_length;
        Self { vertices, corners, normal, trusted }
    }

    /// Whether all points are certainly on one side of the plane or in it. False if exactly two of them may
    /// be in the plane.
    #[inline]
    #[must_use]
    pub(crate) fn has_on_one_side(&self, points: &[DVec3; 3]) -> bool {
        let [a, b, c] = points.map(|p| self.normal.dot(p - self.corners[0]));
        let is_on_one = a.min(b).min(c) >= 0.0 || a.max(b).max(c) <= 0.0;
        let [x, y, z] = [a.abs(), b.abs(), c.abs()];
        let middle = x.min(y).max(x.max(y).min(z));
        self.trusted & is_on_one & (middle > tolerances::MAX_PLANE_DISTANCE_OF_FARTHEST * x.max(y).max(z))
    }

    /// Signed distances of points from the plane; zero within the tolerance. `None` if the points are
    /// certainly not on both sides, unless exactly two of them are in the plane.
    #[inline]
    fn distances(
        &self,
        points: &[DVec3; 3],
        normal_length: f64,
        tolerance: PairTolerance,
    ) -> Option<[f64; 3]> {
        let [a, b, c] = self.corners;
        let reach = |offset: DVec3| offset.x.abs() + offset.y.abs() + offset.z.abs();
        let size = reach(b - a) + reach(c - a);
        let (mut is_zero, mut below, mut above) = ([false; 3], false, false);
        for (is_zero, point) in is_zero.iter_mut().zip(points) {
            let from_corner = *point - a;
            let about = self.normal.dot(from_corner);
            // Exceeds the error of every determinant of these points, so that smaller values count as zero
            // either way.
            let far = size + reach(from_corner);
            let error = tolerances::DETERMINANT_ROUNDING * (far * far * far);
            // Where surfaces coincide, most corners are in the other plane, and exact predicates would be
            // slow. Most other corners are on one side.
            *is_zero = about.abs() + error < far_tolerance(far, normal_length, tolerance) && {
                let max_plane_offset = self.plane_tolerance(*point, normal_length, tolerance) * normal_length;
                about.abs() + error < tolerances::PLANE_ROUNDING_FACTOR * max_plane_offset
            };
            below |= !*is_zero && about <= error;
            above |= !*is_zero && about >= -error;
        }
        if !(below && above) && is_zero.iter().filter(|is_zero| **is_zero).count() != 2 {
            return None;
        }
        let mut distances = [0.0; 3];
        for ((distance, point), is_zero) in distances.iter_mut().zip(points).zip(is_zero) {
            if !is_zero {
                *distance = self.distance(*point, normal_length, tolerance);
            }
        }
        Some(distances)
    }

    fn distance(&self, point: DVec3, normal_length: f64, tolerance: PairTolerance) -> f64 {
        let [a, b, c] = self.corners;
        let (a, b, c) = (coordinates(a), coordinates(b), coordinates(c));
        let distance = -orient3d(a, b, c, coordinates(point)) / normal_length;
        let local_tolerance = self.plane_tolerance(point, normal_length, tolerance);
        if distance.abs() < local_tolerance { 0.0 } else { distance }
    }

    /// Maximum distance from the plane of the triangle for a point that counts as in it.
    ///
    /// Rounding moves the point like each corner. It moves the plane at the point by the sum over the
    /// corners, weighted by the barycentric coordinates of the point. Far from a narrow triangle the plane is
    /// therefore unknown.
    #[inline]
    fn plane_tolerance(&self, point: DVec3, normal_length: f64, tolerance: PairTolerance) -> f64 {
        if tolerance.rounding == 0.0 {
            return tolerance.plane;
        }
        let weights = weight_sum(self.corners, self.normal, point) / (normal_length * normal_length);
        tolerance.plane.max(tolerance.rounding * (1.0 + weights))
    }
}

/// Upper bound for [`Triangle::plane_tolerance`] times the length of the normal, if no corner is farther than
/// `far` from the point. Each of the three weights is then at most the square of `far`.
#[inline]
fn far_tolerance(far: f64, normal_length: f64, tolerance: PairTolerance) -> f64 {
    let of_rounding = tolerance.rounding * (normal_length + 3.0 * far * far);
    (tolerance.plane * normal_length).max(of_rounding)
}

fn coordinates(p: DVec3) -> Coord3D<f64> {
    Coord3D { x: p.x, y: p.y, z: p.z }
}

/// Part of a triangle that meets the other plane: an edge (lesser vertex first), or a vertex (twice).
pub(crate) type Feature = [u32; 2];

/// Point where the border of one triangle meets the other triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Piercing {
    /// The edge or vertex that pierces.
    pub feature: Feature,
    /// The point, bit-identical for every triangle with the feature.
    pub point: DVec3,
}

/// End of the common part of two triangles: a piercing by the border of the first, of the second, or (within
/// the tolerance) of both.
pub(crate) type SegmentEnd = [Option<Piercing>; 2];

/// Common part of two triangles. Its ends are ordered along the cross product of their normals.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum PairIntersection {
    /// A segment.
    Segment([SegmentEnd; 2]),
    /// A segment that is too short to count; both ends are one point. Segments of neighbours may end there.
    Point([SegmentEnd; 2]),
    /// An edge of one triangle that lies in the other. The surfaces cross there if the next triangle at the
    /// edge is on the other side.
    Touch(Touch),
    /// Collinear edges of both triangles. The surfaces cross there if their triangles alternate around the
    /// line.
    Along(Along),
}

impl PairIntersection {
    /// First and last end.
    #[must_use]
    pub(crate) fn ends(&self) -> [SegmentEnd; 2] {
        match self {
            Self::Segment(ends) | Self::Point(ends) => *ends,
            Self::Touch(touch) => touch.ends,
            Self::Along(along) => along.ends,
        }
    }
}

/// Edge of one triangle in the plane of the other, clipped to the other triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Touch {
    /// First and last end along the cross product of the normals.
    pub ends: [SegmentEnd; 2],
    /// The edge, lesser vertex first.
    pub edge: Feature,
    /// Whether the edge belongs to the second triangle.
    pub is_of_second: bool,
    /// Whether the triangle with the edge is on the side of the other one's normal.
    pub is_above: bool,
}

/// Overlap of two collinear edges, one of each triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Along {
    /// First and last end along the cross product of the normals.
    pub ends: [SegmentEnd; 2],
    /// The edges of both triangles, lesser vertex first.
    pub edges: [Feature; 2],
    /// Unit vectors from the line into each triangle, perpendicular to the line.
    pub away: [DVec3; 2],
}

/// Common part of two triangles without common vertices that strictly pass through each other.
///
/// Coplanar triangles have no common part; neither have triangles that touch the other plane with a vertex
/// only.
#[must_use]
pub(crate) fn cross(a: &Triangle, b: &Triangle, tolerance: PairTolerance) -> Option<PairIntersection> {
    if a.has_on_one_side(&b.corners) || b.has_on_one_side(&a.corners) {
        return None;
    }
    cross_unrejected(a, b, tolerance)
}

/// Same, for triangles that [`Triangle::has_on_one_side`] does not reject.
pub(crate) fn cross_unrejected(
    a: &Triangle,
    b: &Triangle,
    tolerance: PairTolerance,
) -> Option<PairIntersection> {
    let (a_length, b_length) = (a.normal.length(), b.normal.length());
    if !(a_length > 0.0 && b_length > 0.0) {
        return None;
    }
    let b_distances = a.distances(&b.corners, a_length, tolerance)?;
    let b_edge = edge_in_plane(b_distances);
    let b_crossings = crossings(b, b_distances, b_edge)?;
    let a_distances = b.distances(&a.corners, b_length, tolerance)?;
    let a_edge = edge_in_plane(a_distances);
    let a_crossings = crossings(a, a_distances, a_edge)?;
    let along = (a.normal / a_length).cross(b.normal / b_length);
    let sine = along.length();
    if sine <= PARALLEL_SINE {
        return None;
    }
    let direction = along / sine;
    let ordered = |[p, q]: [Piercing; 2]| {
        let with_parameter = |piercing: Piercing| (direction.dot(piercing.point - a.corners[0]), piercing);
        let (p, q) = (with_parameter(p), with_parameter(q));
        if p.0 <= q.0 { [p, q] } else { [q, p] }
    };
    let [a_first, a_last] = ordered(a_crossings);
    let [b_first, b_last] = ordered(b_crossings);
    let length = a_last.0.min(b_last.0) - a_first.0.max(b_first.0);
    let end = |a: (f64, Piercing), b: (f64, Piercing), a_is_inner: bool| {
        let meet = (a.0 - b.0).abs() <= tolerance.overlap;
        [(meet || a_is_inner).then_some(a.1), (meet || !a_is_inner).then_some(b.1)]
    };
    let ends = [end(a_first, b_first, a_first.0 >= b_first.0), end(a_last, b_last, a_last.0 <= b_last.0)];
    let edge = |triangle: &Triangle, third: usize| {
        let [v, w] = [triangle.vertices[(third + 1) % 3], triangle.vertices[(third + 2) % 3]];
        [v.min(w), v.max(w)]
    };
    if let (Some(a_third), Some(b_third)) = (a_edge, b_edge) {
        let away = |face: &Triangle, third: usize| {
            let to_third = face.corners[third] - face.corners[(third + 1) % 3];
            (to_third - direction * to_third.dot(direction)).normalize_or_zero()
        };
        let (edges, away) = ([edge(a, a_third), edge(b, b_third)], [away(a, a_third), away(b, b_third)]);
        return (length > tolerance.overlap).then_some(PairIntersection::Along(Along { ends, edges, away }));
    }
    let touch = match (a_edge, b_edge) {
        (Some(side), _) => Some((a, a_distances, side, false)),
        (_, Some(side)) => Some((b, b_distances, side, true)),
        _ => None,
    };
    if let Some((flat_triangle, distances, third, is_of_second)) = touch {
        let touch =
            Touch { ends, edge: edge(flat_triangle, third), is_of_second, is_above: distances[third] > 0.0 };
        return (length > tolerance.overlap).then_some(PairIntersection::Touch(touch));
    }
    if length > tolerance.overlap {
        Some(PairIntersection::Segment(ends))
    } else if length >= -tolerance.overlap {
        Some(PairIntersection::Point(ends))
    } else {
        None
    }
}

/// The corner opposite the edge that lies in a plane, from the distances of the corners; `None` if not
/// exactly two are zero.
fn edge_in_plane(distances: [f64; 3]) -> Option<usize> {
    let third = distances.iter().position(|d| *d != 0.0)?;
    (distances.iter().filter(|d| **d == 0.0).count() == 2).then_some(third)
}

/// The two points where the border of a triangle crosses a plane, from the distances of its corners.
///
/// If `third` is given, the opposite edge lies in the plane and its ends are returned. Otherwise `None`,
/// unless corners are on both sides.
fn crossings(triangle: &Triangle, distances: [f64; 3], third: Option<usize>) -> Option<[Piercing; 2]> {
    if let Some(third) = third {
        let at = |k: usize| Piercing { feature: [triangle.vertices[k]; 2], point: triangle.corners[k] };
        return Some([at((third + 1) % 3), at((third + 2) % 3)]);
    }
    let below = distances.iter().any(|&d| d < 0.0);
    let above = distances.iter().any(|&d| d > 0.0);
    if !(below && above) {
        return None;
    }
    // With corners on both sides, two edges are crossed, or one edge and a vertex.
    let mut found = [None; 2];
    let mut slots = found.iter_mut();
    for i in 0..3 {
        let j = (i + 1) % 3;
        let (vertex_i, vertex_j) = (triangle.vertices[i], triangle.vertices[j]);
        let piercing = if distances[i] == 0.0 {
            Piercing { feature: [vertex_i, vertex_i], point: triangle.corners[i] }
        } else if (distances[i] < 0.0) != (distances[j] < 0.0) && distances[j] != 0.0 {
            let (i, j) = if vertex_i < vertex_j { (i, j) } else { (j, i) };
            let t = distances[i] / (distances[i] - distances[j]);
            let point = triangle.corners[i] + t * (triangle.corners[j] - triangle.corners[i]);
            Piercing { feature: [vertex_i.min(vertex_j), vertex_i.max(vertex_j)], point }
        } else {
            continue;
        };
        if let Some(slot) = slots.next() {
            *slot = Some(piercing);
        }
    }
    match found {
        [Some(p), Some(q)] => Some([p, q]),
        _ => None,
    }
}

#[cfg(test)]
mod tests;
