//! Coarse rounded surfaces get finer triangles where the contour may pass, so that it is round on
//! the page; the rest of the model stays as it is.
//!
//! The idea of refining near the contour alone is that of Hertzmann and Zorin 2000, section 4.3.

use glam::DVec3;

use crate::math::tolerance;
use crate::mesh::Mesh;
use crate::shape::refine;
use crate::shape::splice::Cuts;
use crate::shape::{EdgeArc, SmoothNormals};
use crate::view::Frame;

/// To vanish in between two values of one sign, the field has to fall from both: half of what the
/// ends turn is the most, and a little for arcs that are longer than their chords.
const REACH: f64 = 0.55;
const REACH_AND_ROUNDING: f64 = REACH * (1.0 + 1e-9);

/// What is cut of a mesh near the contour of a view until no edge is farther from its arc than
/// [`tolerance::ARC_PX`]; `None` where edges are short enough already.
#[must_use]
pub fn cuts_near_contours(mesh: &Mesh, smooth: &SmoothNormals, frame: &Frame) -> Option<Cuts> {
    let px = frame.width.max(frame.height) / 1000.0;
    // How long a world length is on the page where it is nearest to the eye, seen square on.
    let page = |[a, b]: [DVec3; 2]| {
        let depth = if frame.perspective { frame.depth(a).min(frame.depth(b)) } else { 1.0 };
        if depth > 0.0 { frame.scale / (px * depth) } else { 0.0 }
    };
    // Squares and no quotient: this is asked of every edge of the model.
    let short = (tolerance::SHORT_EDGE_PX * px / frame.scale).powi(2);
    let is_long = |a: DVec3, b: DVec3| {
        let depth = if frame.perspective { frame.depth(a).min(frame.depth(b)) } else { 1.0 };
        depth > 0.0 && a.distance_squared(b) > short * depth * depth
    };
    let want = |ends: [DVec3; 2], normals: [DVec3; 2]| {
        if frame.perspective && surely_turned(frame.eye, ends, normals) {
            return 0.0;
        }
        let to_eye = ends.map(|p| frame.to_eye(p));
        let facing = [0, 1].map(|k| normals[k].dot(to_eye[k]));
        // Between the ends the field varies by no more than normal and line of sight turn.
        let turn = normals[0].distance(normals[1]) + to_eye[0].distance(to_eye[1]);
        let nearest = facing[0].abs().min(facing[1].abs());
        if (facing[0] > 0.0) == (facing[1] > 0.0) && nearest > REACH * turn {
            return 0.0;
        }
        EdgeArc::new(ends, normals).height().length() * page(ends) / tolerance::ARC_PX
    };
    refine::cuts(mesh, smooth, is_long, want)
}

/// Whether the field is surely too far from zero at both ends of an edge to vanish in between: told with no more than four
/// roots, of almost all edges.
#[inline]
fn surely_turned(eye: DVec3, ends: [DVec3; 2], normals: [DVec3; 2]) -> bool {
    let to_eye = ends.map(|p| eye - p);
    let [first, second] = [0, 1].map(|k| normals[k].dot(to_eye[k]));
    let far = to_eye.map(DVec3::length);
    // Unit vectors from two points to the eye differ by no more than the way between them, seen from the nearer one.
    let sight = ends[0].distance(ends[1]) / far[0].min(far[1]);
    let most = REACH_AND_ROUNDING * (normals[0].distance(normals[1]) + sight);
    (first > 0.0) == (second > 0.0) && first.abs() > most * far[0] && second.abs() > most * far[1]
}
