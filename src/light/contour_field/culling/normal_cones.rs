//! [`NormalCones`]: bounds of runs of edges, used by a view to skip whole runs that cannot contain its contour.
//!
//! 1. Edges are stored in spatial order, so a run covers a small patch of the surface.
//! 2. A ball bounds the points of a run, and a cone its normals.
//! 3. The distance of the ball and the angle of the cone bound how far from edge-on every point of the run is
//!    seen.
//!
//! Source: Shirman and Abi-Ezzi, "The cone of normals technique for fast processing of curved patches",
//! Computer Graphics Forum 12(3), 1993.

use crate::parallel::prelude::*;
use glam::DVec3;

use crate::light::tolerances;
use crate::mesh::Mesh;
use crate::surface::SmoothNormals;
use crate::surface::refine::edge_marks::EDGES_PER_RUN;
use crate::view::Frame;

/// Factor that raises lengths by more than their rounding error.
const LENGTH_MARGIN: f64 = 1.0 + tolerances::F64_MARGIN_SHARE;

/// Bounds of the rounded edges of a mesh, independent of the view.
#[derive(Debug)]
pub(crate) struct NormalCones {
    runs: Vec<Option<NormalCone>>,
}

/// Bounds of the rounded edges of one run.
#[derive(Debug, Clone, Copy)]
struct NormalCone {
    /// Ball around their ends.
    middle: DVec3,
    radius: f64,
    /// Cone around their normals: its axis, and the cosine and sine of its half angle.
    axis: DVec3,
    cosine: f64,
    sine: f64,
    /// Length of the longest edge.
    length: f64,
    /// Largest difference between the normals at both ends of an edge.
    turn: f64,
}

impl NormalCones {
    /// Computes the bounds of all runs of edges.
    #[must_use]
    pub(crate) fn new(mesh: &Mesh, smooth: &SmoothNormals) -> Self {
        let runs = mesh.edges.len().div_ceil(EDGES_PER_RUN);
        let runs = (0..runs)
            .into_par_iter()
            .with_min_len(1 << 8)
            .map(|run| NormalCone::of(mesh, smooth, run))
            .collect();
        Self { runs }
    }

    /// Whether no edge of a run matters for the contour: all are shorter than the root of `short` times their
    /// depth, or too far from edge-on.
    ///
    /// Too far means that the field cannot vanish over them, if it varies by at most `reach` times the turn
    /// of normal and line of sight.
    #[inline]
    pub(crate) fn is_passed(&self, run: usize, frame: &Frame, reach: f64, short: f64) -> bool {
        self.runs[run].is_none_or(|cone| cone.is_passed(frame, reach, short))
    }
}

impl NormalCone {
    fn of(mesh: &Mesh, smooth: &SmoothNormals, run: usize) -> Option<Self> {
        let edges = run * EDGES_PER_RUN..((run + 1) * EDGES_PER_RUN).min(mesh.edges.len());
        let rounded = || {
            let of_edge = |edge: usize| {
                let ends = smooth.across(mesh, edge).filter(|_| !smooth.straight.contains(edge))?;
                let at = ends.map(|v| mesh.positions[smooth.vertices[v as usize] as usize]);
                Some((at, ends.map(|v| smooth.normals[v as usize])))
            };
            edges.clone().filter_map(of_edge)
        };
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let mut sum = DVec3::ZERO;
        let (mut length, mut turn) = (-1f64, 0f64);
        for ([a, b], [normal_a, normal_b]) in rounded() {
            (low, high) = (low.min(a).min(b), high.max(a).max(b));
            sum += normal_a + normal_b;
            length = length.max(a.distance(b));
            turn = turn.max(normal_a.distance(normal_b));
        }
        if length < 0.0 {
            return None;
        }
        let middle = (low + high) / 2.0;
        let axis = sum.normalize_or_zero();
        let (mut radius, mut cosine) = (0f64, 1f64);
        for (ends, normals) in rounded() {
            radius = ends.iter().fold(radius, |most, p| most.max(p.distance(middle)));
            cosine = normals.iter().fold(cosine, |least, n| least.min(n.dot(axis)));
        }
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
        Some(Self {
            middle,
            radius: radius * LENGTH_MARGIN,
            axis,
            cosine,
            sine,
            length: length * LENGTH_MARGIN,
            turn,
        })
    }

    fn is_passed(&self, frame: &Frame, reach: f64, short: f64) -> bool {
        let mut to_eye = -frame.forward;
        // Angle between lines of sight from the ball and that of its centre.
        let (mut cosine, mut sine) = (1.0, 0.0);
        let mut turn = self.turn;
        let mut least_depth = 1.0;
        if frame.perspective {
            to_eye = frame.eye - self.middle;
            let far = to_eye.length();
            let near = far - self.radius;
            if near.is_nan() || near <= 0.0 {
                return false;
            }
            to_eye /= far;
            sine = self.radius / far;
            cosine = (1.0 - sine * sine).sqrt();
            // Unit vectors from two points to the eye differ by at most the distance between the points,
            // divided by that to the nearer one.
            turn += self.length / near;
            least_depth = frame.depth(self.middle) - self.radius;
            if least_depth < far * tolerances::MIN_DEPTH_OF_DISTANCE {
                least_depth = 0.0;
            }
        }
        if self.length * self.length * LENGTH_MARGIN <= short * least_depth * least_depth {
            return true;
        }
        let facing = self.axis.dot(to_eye);
        // Largest angle of normal and line of sight together from the axis and the line to the centre.
        let lean_cosine = self.cosine * cosine - self.sine * sine;
        let lean_sine = self.sine * cosine + self.cosine * sine;
        let across = (1.0 - facing * facing).max(0.0).sqrt();
        lean_cosine > 0.0
            && facing.abs() * lean_cosine - across * lean_sine > reach * turn + tolerances::FACING_MARGIN
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::dice::Dice;
    use crate::geometry::numbers::portable_math::{cos, sin};
    use crate::light::cuts_near_contours;
    use crate::mesh::Soup;
    use crate::scene::{Camera, Projection};

    /// Torus with dents, so it has folds as well.
    fn dented_torus(across: u32) -> Mesh {
        let mut dice = Dice::new(3);
        let mut soup = Soup::default();
        let around = |k: u32, of: u32| f64::from(k % of) / f64::from(of) * std::f64::consts::TAU;
        for i in 0..2 * across {
            for k in 0..across {
                let (u, v) = (around(i, 2 * across), around(k, across));
                let dent = 0.5 * (1.0 - 0.3 * cos(5.0 * u + 2.0 * v));
                let ring = 1.5 + dent * cos(v);
                let p = DVec3::new(ring * cos(u), ring * sin(u), dent * sin(v));
                soup.positions.push(p + dice.point(1e-4));
                let at = |i: u32, k: u32| i % (2 * across) * across + k % across;
                let corners = [at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)];
                soup.triangles
                    .extend([[corners[0], corners[1], corners[2]], [corners[0], corners[2], corners[3]]]);
            }
        }
        Mesh::build(soup)
    }

    #[test]
    fn normal_cones_skip_most_runs_and_keep_all_contour_cuts() {
        let mesh = dented_torus(100);
        let smooth = SmoothNormals::new(&mesh, |_| true, |edge| edge % 97 == 0);
        let cones = NormalCones::new(&mesh, &smooth);
        let mut dice = Dice::new(7);
        let mut passed = 0;
        for view in 0..24 {
            let eye = dice.point(1.0).normalize() * [1.2, 2.5, 4.0, 30.0][view % 4];
            let projection = match view % 3 {
                0 => Projection::Orthographic { height: 5.0 },
                _ => Projection::Perspective { fov_y_deg: 40.0 },
            };
            let (target, up) = (dice.point(0.2), DVec3::Z);
            let camera = Camera { eye, target, up, projection, width: 1e3, height: 800.0, near: None };
            let frame = Frame::new(&camera, mesh.origin);
            let [without, with] =
                [None, Some(&cones)].map(|cones| cuts_near_contours(&mesh, &smooth, cones, &frame));
            assert!(without == with, "{camera:?}");
            if view % 4 > 1 {
                let short = 0.0;
                passed +=
                    (0..cones.runs.len()).filter(|run| cones.is_passed(*run, &frame, 0.55, short)).count();
            }
        }
        assert!(passed * 10 > cones.runs.len() * 12 * 5, "{passed} of {}", cones.runs.len() * 12);
    }
}
