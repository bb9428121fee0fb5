//! [`rims`]: finds further cylinders around the axes of known ones, made of narrow facets that do not touch,
//! such as the tips and roots of gear teeth.
//!
//! 1. The axes of complete cylinders are collected, one per body and line.
//! 2. Each facet of the body is tested against the axis. It is a chord of a circle around it if its corners
//!    are equally far from the axis, and its normal passes through the axis.
//! 3. Chords of nearly equal radius that face the same way, outward or inward, form a cylinder.
//!
//! Lengths are in world units. Technical sheets use cylinders for diameters and centre lines.

use std::f64::consts::TAU;

use glam::DVec3;

use super::cylinder::Cylinder;
use crate::geometry::lists::disjoint_sets::DisjointSets;
use crate::geometry::numbers::portable_math::atan2;
use crate::mesh::components::bodies::body_of;
use crate::mesh::{Mesh, PartId};
use crate::surface::tolerances::{MAX_FACET_RADIUS_SPREAD, MAX_RIM_RADIUS_SPREAD};

/// Minimum arc of a cylinder whose axis is used, radians: nearly a full turn.
const MIN_AXIS_ARC_RAD: f64 = 5.8;

/// Maximum arc of a facet of a rim, radians. It excludes the sides of nuts.
const MAX_FACET_ARC_RAD: f64 = 0.45;

/// Minimum number of facets of a rim.
const MIN_RIM_FACETS: usize = 6;
/// Maximum number of triangles of a facet.
const MAX_FACET_TRIANGLES: usize = 24;

/// A facet seen along an axis: a chord of a circle around it.
struct RimChord {
    radius: f64,
    /// Difference between the largest and smallest distance of its corners from the axis.
    spread: f64,
    /// Whether its normal points to the axis, as inside a hole.
    is_hole: bool,
    /// Angle it subtends at the axis, radians.
    arc: f64,
    /// Start and end along the axis.
    ends: [f64; 2],
}

/// Finds the rims around the axes of complete `known` cylinders of the same body, except those that are
/// already known.
///
/// `normals` has one entry per face, zero for degenerate ones. `facets` joins the faces of each flat facet.
pub(crate) fn rims(
    mesh: &Mesh,
    normals: &[DVec3],
    facets: &DisjointSets,
    known: &[Cylinder],
) -> Vec<Cylinder> {
    let body = |part: PartId| body_of(&mesh.bodies, part);
    let mut axes: Vec<&Cylinder> = Vec::new();
    for cylinder in known.iter().filter(|cylinder| cylinder.arc > MIN_AXIS_ARC_RAD) {
        if !axes.iter().any(|other| body(other.part) == body(cylinder.part) && is_coaxial(other, cylinder)) {
            axes.push(cylinder);
        }
    }
    if axes.is_empty() {
        return Vec::new();
    }
    let mut faces_of: Vec<Vec<u32>> = vec![Vec::new(); mesh.triangles.len()];
    for face in 0..mesh.triangles.len() as u32 {
        faces_of[facets.representative(face) as usize].push(face);
    }
    let parts = mesh.face_part.iter().map(|part| part.index() + 1).max().unwrap_or_default();
    let mut of_body: Vec<Vec<&[u32]>> = vec![Vec::new(); parts];
    for own in faces_of.iter().filter(|own| (1..=MAX_FACET_TRIANGLES).contains(&own.len())) {
        of_body[mesh.body(own[0]).index()].push(own);
    }
    let mut found = Vec::new();
    for axis in axes {
        let facets = of_body[body(axis.part).index()].iter();
        let mut chords: Vec<RimChord> =
            facets.filter_map(|own| chord(mesh, own, normals[own[0] as usize], axis)).collect();
        chords.sort_by(|a, b| a.is_hole.cmp(&b.is_hole).then(a.radius.total_cmp(&b.radius)));
        let alike = |a: &RimChord, b: &RimChord| {
            a.is_hole == b.is_hole && b.radius - a.radius < MAX_RIM_RADIUS_SPREAD * b.radius
        };
        for own in chords.chunk_by(alike).filter(|own| own.len() >= MIN_RIM_FACETS) {
            let rim = rim_cylinder(own, axis.part, axis);
            let is_known = |other: &Cylinder| {
                body(other.part) == body(rim.part)
                    && is_coaxial(other, &rim)
                    && other.is_hole == rim.is_hole
                    && (other.radius - rim.radius).abs() < 5.0 * MAX_RIM_RADIUS_SPREAD * rim.radius
            };
            if !known.iter().chain(&found).any(is_known) {
                found.push(rim);
            }
        }
    }
    found
}

/// Whether two cylinders have the same axis line within tolerance.
fn is_coaxial(a: &Cylinder, b: &Cylinder) -> bool {
    let apart = a.point - b.point;
    a.axis.cross(b.axis).length() < MAX_RIM_RADIUS_SPREAD
        && (apart - a.axis * apart.dot(a.axis)).length()
            < 5.0 * MAX_RIM_RADIUS_SPREAD * a.radius.min(b.radius)
}

/// The chord that a facet forms around an axis; `None` if it is not one.
fn chord(mesh: &Mesh, faces: &[u32], normal: DVec3, about: &Cylinder) -> Option<RimChord> {
    if normal == DVec3::ZERO || normal.dot(about.axis).abs() > MAX_RIM_RADIUS_SPREAD {
        return None;
    }
    let across = normal.cross(about.axis);
    let (mut radii, mut sides) = ([f64::INFINITY, 0.0_f64], [f64::INFINITY, f64::NEG_INFINITY]);
    let mut ends = [f64::INFINITY, f64::NEG_INFINITY];
    let mut out = 0.0;
    for v in faces.iter().flat_map(|face| mesh.triangles[*face as usize]) {
        let p = mesh.positions[v as usize] + mesh.origin - about.point;
        let along = p.dot(about.axis);
        let flat = p - about.axis * along;
        let (radius, side) = (flat.length(), flat.dot(across));
        radii = [radii[0].min(radius), radii[1].max(radius)];
        if radii[1] - radii[0] > MAX_FACET_RADIUS_SPREAD * radii[1] {
            return None;
        }
        sides = [sides[0].min(side), sides[1].max(side)];
        ends = [ends[0].min(along), ends[1].max(along)];
        out = flat.dot(normal);
    }
    let (radius, half) = (radii[1], (sides[1] - sides[0]) / 2.0);
    let arc = 2.0 * atan2(half, out.abs());
    let is_chord =
        half > 0.0 && (sides[0] + sides[1]).abs() < MAX_RIM_RADIUS_SPREAD * radius && arc < MAX_FACET_ARC_RAD;
    is_chord.then_some(RimChord { radius, spread: radii[1] - radii[0], is_hole: out < 0.0, arc, ends })
}

/// The cylinder formed by chords around an axis.
fn rim_cylinder(chords: &[RimChord], part: PartId, about: &Cylinder) -> Cylinder {
    let ends = chords.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], chord| {
        [low.min(chord.ends[0]), high.max(chord.ends[1])]
    });
    let radius = chords.iter().map(|chord| chord.radius).sum::<f64>() / chords.len() as f64;
    let off = chords.iter().map(|chord| (chord.radius - radius).abs() + chord.spread);
    Cylinder {
        part,
        point: about.point,
        axis: about.axis,
        radius,
        spread: off.fold(about.spread, f64::max),
        ends,
        arc: chords.iter().map(|chord| chord.arc).sum::<f64>().min(TAU),
        is_hole: chords[0].is_hole,
    }
}
