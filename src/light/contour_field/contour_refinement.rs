//! Refinement of coarse rounded surfaces where the contour may pass, so that it is round on the page. The
//! rest of the model stays unchanged.
//!
//! Source: Hertzmann and Zorin 2000, section 4.3, for refinement near the contour alone.

use glam::DVec3;

use crate::light::tolerances;
use crate::mesh::Mesh;
use crate::surface::refine::mesh_splice::MeshCuts;
use crate::surface::refine::subdivision;
use crate::surface::{EdgeArc, SmoothNormals};
use crate::view::Frame;

/// Largest fall of the field between two ends of one sign, as a share of their turn. To vanish in between,
/// the field must fall from both ends, so each end accounts for half the turn. Arcs longer than their chords
/// add a little.
const MAX_FALL_PER_TURN: f64 = 0.55;
const MAX_FALL_PER_TURN_ROUNDED: f64 = MAX_FALL_PER_TURN * (1.0 + tolerances::F64_MARGIN_SHARE);

/// Cuts of a mesh near the contour of a view, made until no edge is farther from its arc than
/// [`tolerances::MAX_ARC_ERROR_PX`]. `None` where edges are short enough.
#[must_use]
pub(crate) fn cuts_near_contours(mesh: &Mesh, smooth: &SmoothNormals, frame: &Frame) -> Option<MeshCuts> {
    let px = frame.width.max(frame.height) / 1000.0;
    // Length on the page of a unit length at the end nearer to the eye, seen square on.
    let page = |[a, b]: [DVec3; 2]| {
        let depth = if frame.perspective { frame.depth(a).min(frame.depth(b)) } else { 1.0 };
        if depth > 0.0 { frame.scale / (px * depth) } else { 0.0 }
    };
    // Squares instead of quotients, because this runs for every edge of the model.
    let short = (tolerances::MIN_SPLIT_EDGE_PX * px / frame.scale).powi(2);
    let is_long = |a: DVec3, b: DVec3| {
        let depth = if frame.perspective { frame.depth(a).min(frame.depth(b)) } else { 1.0 };
        depth > 0.0 && a.distance_squared(b) > short * depth * depth
    };
    let want = |ends: [DVec3; 2], normals: [DVec3; 2]| {
        if frame.perspective && is_surely_turned(frame.eye, ends, normals) {
            return 0.0;
        }
        let to_eye = ends.map(|p| frame.to_eye(p));
        let facing = [0, 1].map(|k| normals[k].dot(to_eye[k]));
        // Between the ends, the field varies by at most the turn of normal and line of sight.
        let turn = normals[0].distance(normals[1]) + to_eye[0].distance(to_eye[1]);
        let nearest = facing[0].abs().min(facing[1].abs());
        if (facing[0] > 0.0) == (facing[1] > 0.0) && nearest > MAX_FALL_PER_TURN * turn {
            return 0.0;
        }
        EdgeArc::new(ends, normals).height().length() * page(ends) / tolerances::MAX_ARC_ERROR_PX
    };
    subdivision::cuts(mesh, smooth, is_long, want)
}

/// Whether the field is certainly too far from zero at both ends of an edge to vanish in between. It runs for
/// almost all edges, so it uses no root and no quotient.
#[inline]
fn is_surely_turned(eye: DVec3, [a, b]: [DVec3; 2], [normal_a, normal_b]: [DVec3; 2]) -> bool {
    let (to_eye_a, to_eye_b) = (eye - a, eye - b);
    let (facing_a, facing_b) = (normal_a.dot(to_eye_a), normal_b.dot(to_eye_b));
    let (far_a, far_b) = (to_eye_a.length_squared(), to_eye_b.length_squared());
    let nearer = far_a.min(far_b);
    // Unit vectors from two points to the eye differ by at most the distance between the points, divided by
    // that to the nearer one. The square of a sum is at most 5/4 of one square plus five times the other.
    // Everything is squared and multiplied by the square of the nearer distance.
    let most = 1.25 * normal_a.distance_squared(normal_b) * nearer + 5.0 * a.distance_squared(b);
    let most = MAX_FALL_PER_TURN_ROUNDED * MAX_FALL_PER_TURN_ROUNDED * most;
    (facing_a > 0.0) == (facing_b > 0.0)
        && facing_a * facing_a * nearer > most * far_a
        && facing_b * facing_b * nearer > most * far_b
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::dice::Dice;

    #[test]
    fn is_surely_turned_has_no_false_positives_and_few_false_negatives() {
        let mut dice = Dice::new(1);
        let (mut told, mut turned) = (0, 0);
        for k in 0..20_000 {
            let mut point = || dice.point(1.0);
            // From edges as long as their distance to short ones, and from very different normals to similar
            // ones.
            let (near, alike) = (0.1f64.powi(k % 4), 0.1f64.powi(k / 4 % 4));
            let (a, eye) = (point(), point() * 3.0);
            let ends = [a, a + point() * near];
            let normal = point().normalize_or_zero();
            let normals = [normal, (normal + point() * alike).normalize_or_zero()];
            let to_eye = ends.map(|p| (eye - p).normalize());
            let facing = [0, 1].map(|k| normals[k].dot(to_eye[k]));
            let turn = normals[0].distance(normals[1]) + to_eye[0].distance(to_eye[1]);
            let is_turned = facing[0] * facing[1] > 0.0
                && facing[0].abs().min(facing[1].abs()) > MAX_FALL_PER_TURN * turn;
            let is_told = is_surely_turned(eye, ends, normals);
            assert!(is_turned || !is_told, "{ends:?} {normals:?} from {eye}");
            told += u32::from(is_told);
            turned += u32::from(is_turned);
        }
        assert!(turned > 10_000 && f64::from(told) > 0.85 * f64::from(turned), "{told} of {turned}");
    }
}
