//! Refinement of coarse rounded surfaces where the contour may pass, so that it is round on the page. The
//! rest of the model stays unchanged.
//!
//! Edges are split until their arcs rise by no more than the tolerance of the drawn curve. Coarser pieces would
//! show: contours near cusps change their course and get notches.
//!
//! Source: Hertzmann and Zorin 2000, section 4.3, for refinement near the contour alone.

use glam::DVec3;

use crate::light::contour_field::culling::edge_on_margin::EdgeOnMargin;
use crate::light::tolerances;
use crate::mesh::Mesh;
use crate::surface::refine::edge_arc::MAX_RISE_OF_LENGTH;
use crate::surface::refine::mesh_splice::MeshCuts;
use crate::surface::refine::subdivision;
use crate::surface::rims::rim_cuts::rim_cuts;
use crate::surface::{EdgeArc, EvenRuns, SmoothNormals};
use crate::view::Frame;

/// Largest fall of the field between two ends of one sign, as a share of their turn. To vanish in between,
/// the field must fall from both ends, so each end accounts for half the turn. Arcs longer than their chords
/// add a little.
const MAX_FALL_PER_TURN: f64 = 0.55;
const MAX_FALL_PER_TURN_ROUNDED: f64 = MAX_FALL_PER_TURN * (1.0 + tolerances::F64_MARGIN_SHARE);

/// Cuts of a mesh along its rims (lines between surfaces, and `even` runs), made until no edge is farther from
/// its arc than `tolerance` (user units of the page). `None` where edges are short enough.
#[must_use]
pub(crate) fn cuts_along_rims(
    mesh: &Mesh,
    smooth: &SmoothNormals,
    even: &EvenRuns,
    frame: &Frame,
    tolerance: f64,
) -> Option<MeshCuts> {
    let rise_limit = |at: DVec3| {
        let depth = if frame.perspective { frame.depth(at) } else { 1.0 };
        if depth > 0.0 { tolerance * depth / frame.scale } else { f64::INFINITY }
    };
    rim_cuts(mesh, smooth, even, rise_limit)
}

/// Cuts of a mesh near the contour of a view, made until no edge is farther from its arc than `tolerance` (user
/// units of the page). `None` where edges are short enough.
#[must_use]
pub(crate) fn cuts_near_contours(
    mesh: &Mesh,
    smooth: &SmoothNormals,
    frame: &Frame,
    tolerance: f64,
) -> Option<MeshCuts> {
    // Length on the page of a unit length at the end nearer to the eye, seen square on, in tolerances.
    let page = |[a, b]: [DVec3; 2]| {
        let depth = if frame.perspective { frame.depth(a).min(frame.depth(b)) } else { 1.0 };
        if depth > 0.0 { frame.scale / (tolerance * depth) } else { 0.0 }
    };
    // The arcs of shorter edges are within the tolerance. Squares instead of quotients, because this runs for every
    // edge of the model.
    let short = (tolerance / (MAX_RISE_OF_LENGTH * frame.scale)).powi(2);
    let is_long = |a: DVec3, b: DVec3| {
        let depth = if frame.perspective { frame.depth(a).min(frame.depth(b)) } else { 1.0 };
        depth > 0.0 && a.distance_squared(b) > short * depth * depth
    };
    let want = |ends: [DVec3; 2], normals: [DVec3; 2]| {
        let to_eye = ends.map(|p| frame.to_eye(p));
        let facing = [0, 1].map(|k| normals[k].dot(to_eye[k]));
        // Between the ends, the field varies by at most the turn of normal and line of sight.
        let turn = normals[0].distance(normals[1]) + to_eye[0].distance(to_eye[1]);
        let nearest = facing[0].abs().min(facing[1].abs());
        if (facing[0] > 0.0) == (facing[1] > 0.0) && nearest > MAX_FALL_PER_TURN * turn {
            return 0.0;
        }
        EdgeArc::new(ends, normals).height().length() * page(ends)
    };
    let turned = EdgeOnMargin::of(mesh, smooth, frame, MAX_FALL_PER_TURN_ROUNDED);
    let may = |ends: [u32; 2], squared: f64| !turned.cannot_vanish(ends, squared);
    subdivision::cuts(mesh, smooth, is_long, may, want)
}
