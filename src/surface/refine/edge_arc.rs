//! [`EdgeArc`]: cubic arc of a curved surface over an edge of its mesh.
//!
//! The arc depends only on the positions and normals of the two ends, so both adjacent faces agree. Its
//! handles have the length of those of a circular arc with the same turn, so spheres and cylinders come out
//! round.
//!
//! Source: Vlachos, Peters, Boyd and Mitchell, "Curved PN triangles", I3D 2001, section 3. There, handles are
//! always a third of the edge.

use glam::DVec3;

use crate::mesh::Mesh;
use crate::surface::SmoothNormals;

/// Maximum sine of the angle between the arc and its edge. Arcs over a hexagon need 0.5; steeper normals do not
/// fit any surface through the ends.
pub(crate) const MAX_TANGENT_SINE: f64 = 0.55;

/// Largest height of an arc, as a fraction of its edge: the height of a symmetric arc with
/// [`MAX_TANGENT_SINE`], rounded up.
pub(crate) const MAX_RISE_OF_LENGTH: f64 = 0.15;

/// Cubic Bézier curve over an edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct EdgeArc {
    ends: [DVec3; 2],
    normals: [DVec3; 2],
    /// Vectors from the ends to their control points.
    handles: [DVec3; 2],
}

impl EdgeArc {
    /// The arc between two points with unit normals.
    #[must_use]
    pub(crate) fn new(ends: [DVec3; 2], normals: [DVec3; 2]) -> Self {
        let chord = ends[1] - ends[0];
        let length = chord.length();
        let along = chord.normalize_or_zero();
        let tangents = normals.map(|n| {
            let rise = n.dot(along);
            let across = (rise * (along * rise - n)).normalize_or_zero();
            let rise = rise.abs().min(MAX_TANGENT_SINE);
            along * (1.0 - rise * rise).sqrt() + across * rise
        });
        Self { ends, normals, handles: handles(length, tangents) }
    }

    /// The arc between two points with unit tangents, both in the direction from the first to the second. It
    /// has no normals.
    #[must_use]
    pub(crate) fn with_tangents(ends: [DVec3; 2], tangents: [DVec3; 2]) -> Self {
        let length = ends[0].distance(ends[1]);
        Self { ends, normals: [DVec3::ZERO; 2], handles: handles(length, tangents) }
    }

    /// The arc between two points that leaves its chord as the mean of `others` leave theirs. It has no normals.
    #[must_use]
    pub(crate) fn beside(ends: [DVec3; 2], others: &[Self]) -> Self {
        let third = |ends: [DVec3; 2]| (ends[1] - ends[0]) / 3.0;
        let mean = |of: &dyn Fn(&Self) -> DVec3| others.iter().map(of).sum::<DVec3>() / others.len() as f64;
        let handles = [
            third(ends) + mean(&|other| other.handles[0] - third(other.ends)),
            mean(&|other| other.handles[1] + third(other.ends)) - third(ends),
        ];
        Self { ends, normals: [DVec3::ZERO; 2], handles }
    }

    /// Whether the arc leaves its chord at both ends by the same angle, as that of a circle does. `max_ratio` is
    /// the largest ratio of the two.
    #[must_use]
    pub(crate) fn is_even(&self, max_ratio: f64) -> bool {
        let along = (self.ends[1] - self.ends[0]).normalize_or_zero();
        let [a, b] = self.handles.map(|handle| handle.cross(along).length() / handle.length());
        a.max(b) <= max_ratio * a.min(b)
    }

    /// The same curve from its end to its start.
    #[must_use]
    pub(crate) fn reversed(&self) -> Self {
        let swap = |[a, b]: [DVec3; 2]| [b, a];
        Self { ends: swap(self.ends), normals: swap(self.normals), handles: swap(self.handles) }
    }

    /// The same curve as two arcs, without normals.
    #[must_use]
    pub(crate) fn halves(&self) -> [Self; 2] {
        let [from, to] = self.ends;
        let [p, q] = [from + self.handles[0], to + self.handles[1]];
        let (first, middle, last) = ((from + p) / 2.0, (p + q) / 2.0, (q + to) / 2.0);
        let at = self.at(0.5);
        let half = |ends: [DVec3; 2], controls: [DVec3; 2]| Self {
            ends,
            normals: [DVec3::ZERO; 2],
            handles: [controls[0] - ends[0], controls[1] - ends[1]],
        };
        [half([from, at], [first, (first + middle) / 2.0]), half([at, to], [(middle + last) / 2.0, last])]
    }

    fn middle_direction(&self) -> DVec3 {
        (self.ends[1] - self.ends[0]) * 2.0 - self.handles[0] + self.handles[1]
    }

    /// The arc between two smooth vertices. It is the edge itself if the edge is straight or separates
    /// surfaces.
    ///
    /// Pass the smaller id first, so that both faces at the edge get bit-identical points.
    #[must_use]
    pub(crate) fn over(mesh: &Mesh, smooth: &SmoothNormals, between: [u32; 2]) -> Self {
        let vertices = between.map(|v| smooth.vertices[v as usize]);
        let ends = vertices.map(|v| mesh.positions[v as usize]);
        let normals = between.map(|v| smooth.normals[v as usize]);
        if !smooth.separating_edges.is_empty() || !smooth.straight.is_empty() {
            let edge = mesh.edges.between(vertices[0], vertices[1]);
            if edge
                .is_some_and(|edge| smooth.separating_edges.contains(edge) || smooth.straight.contains(edge))
            {
                let third = (ends[1] - ends[0]) / 3.0;
                return Self { ends, normals, handles: [third, -third] };
            }
        }
        Self::new(ends, normals)
    }

    /// The point at parameter `t`, 0 to 1.
    #[must_use]
    pub(crate) fn at(&self, t: f64) -> DVec3 {
        let s = 1.0 - t;
        let controls = [self.ends[0] + self.handles[0], self.ends[1] + self.handles[1]];
        self.ends[0] * (s * s * s)
            + controls[0] * (3.0 * s * s * t)
            + controls[1] * (3.0 * s * t * t)
            + self.ends[1] * (t * t * t)
    }

    /// Vector from the middle of the edge to the middle of the arc.
    #[must_use]
    pub(crate) fn height(&self) -> DVec3 {
        (self.handles[0] + self.handles[1]) * 0.375
    }

    /// Unit normal in the middle: mean of the end normals, perpendicular to the curve.
    #[must_use]
    pub(crate) fn middle_normal(&self) -> DVec3 {
        let along = self.middle_direction();
        let sum = self.normals[0] + self.normals[1];
        (sum - along * (sum.dot(along) / along.length_squared().max(f64::MIN_POSITIVE))).normalize_or_zero()
    }
}

/// Vectors from the ends of an arc to its control points, as those of a circle with the same turn.
fn handles(length: f64, tangents: [DVec3; 2]) -> [DVec3; 2] {
    let turn = tangents[0].dot(tangents[1]).clamp(-1.0, 1.0);
    let half = ((1.0 + turn) / 2.0).sqrt();
    let reach = length * 2.0 / (3.0 * (1.0 + half));
    [tangents[0] * reach, -tangents[1] * reach]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::numbers::portable_math::{cos, sin};

    #[test]
    fn edge_arcs_of_a_circle_stay_on_the_circle() {
        for turn in [0.01, 0.3, 0.7, 1.1] {
            let at = |a: f64| DVec3::new(cos(a), sin(a), 0.0);
            let arc = EdgeArc::new([at(0.2), at(0.2 + turn)], [at(0.2), at(0.2 + turn)]);
            let middle = arc.at(0.5);
            assert!((middle.length() - 1.0).abs() < 1e-12, "{turn}: {middle}");
            assert!(arc.middle_normal().distance(middle) < 1e-9);
            for k in 0..=10 {
                let off = (arc.at(f64::from(k) / 10.0).length() - 1.0).abs();
                assert!(off < 4e-3 * turn.powi(6), "{turn}: {off}");
            }
        }
    }

    #[test]
    fn the_steepest_edge_arc_has_the_largest_height() {
        for slope in 0..=20 {
            let slope = f64::from(slope) / 10.0;
            let normals = [-slope, slope].map(|x| DVec3::new(x, 1.0, 0.0).normalize());
            let height = EdgeArc::new([DVec3::ZERO, DVec3::X], normals).height().length();
            assert!(height < MAX_RISE_OF_LENGTH, "{slope}: {height}");
            assert!(slope < 1.0 || height > MAX_RISE_OF_LENGTH * 0.999, "{slope}: {height}");
        }
    }

    #[test]
    fn s_shaped_edge_arcs_have_no_height() {
        let n = DVec3::new(0.3, 1.0, 0.0).normalize();
        let arc = EdgeArc::new([DVec3::ZERO, DVec3::X], [n, n]);
        assert!(arc.height().length() < 1e-12);
    }
}
