//! Facing, averted and edge-on faces, decided once for all faces of a plane.
//!
//! 1. A face is edge-on if the sine of the angle between its plane and the line of sight is below
//!    [`EDGE_ON_SINE`](crate::mesh::tolerances::EDGE_ON_SINE). No part of it can be seen.
//! 2. Rounding turns a face by up to the rounding error divided by the face's height. Where the angle is
//!    smaller than that, the face is *unsure*.
//! 3. Connected unsure faces of one plane ([`carriers`](crate::mesh::normals::normal_carriers)) are decided together. They
//!    follow the widest sure face of the plane next to them.
//! 4. If there is none, they are edge-on. On a bent surface that continues all around them, each face keeps
//!    its own angle instead. The contour runs on one side of them or the other, and both are equally right.
//!
//! Edge-on faces count as averted. Pieces of faces that were cut to bend are exact, because their corners
//! were not rounded.

use crate::mesh::tolerances::EDGE_ON_SINE;
use crate::parallel::prelude::*;
use glam::DVec3;

use super::Frame;
use super::tolerances;
use crate::mesh::normals::normal_carriers::CoplanarSearch;
use crate::mesh::{FaceId, Mesh};
use crate::parallel::task_size::MIN_TASK_ITEMS;

/// Whether each face turns its outside to the eye, and the faces, ascending, for which this does not follow
/// from their own angle.
pub(crate) fn facing(mesh: &Mesh, frame: &Frame) -> (Vec<bool>, Vec<u32>) {
    let is_rounded = mesh.extents.is_rounded();
    let piece_start = mesh.first_piece.unwrap_or(mesh.triangles.len() as u32);
    let mut facing = vec![false; mesh.triangles.len()];
    let of_chunk = |(chunk, facing): (usize, &mut [bool])| {
        let mut unsure = Vec::new();
        for (face, facing) in ((chunk * MIN_TASK_ITEMS) as u32..).zip(facing) {
            let corners = mesh.corners(FaceId(face));
            *facing = frame.faces_eye(corners[0], corners[1], corners[2]);
            if is_rounded && face < piece_start {
                let rounding = mesh.extent(FaceId(face)).rounding;
                unsure.extend((rounding > 0.0 && is_unsure(frame, &corners, rounding)).then_some(face));
            }
        }
        unsure
    };
    let unsure: Vec<Vec<u32>> = facing.par_chunks_mut(MIN_TASK_ITEMS).enumerate().map(of_chunk).collect();
    let unsure = unsure.concat();
    for [face, carrier] in &mesh.carriers {
        facing[*face as usize] = facing[*carrier as usize];
    }
    if !is_rounded {
        return (facing, Vec::new());
    }
    let decided = decide(&CoplanarSearch::of(mesh), &unsure, &mut facing);
    let mut dependent_faces: Vec<u32> = mesh.carriers.iter().map(|[face, _]| *face).chain(decided).collect();
    dependent_faces.sort_unstable();
    dependent_faces.dedup();
    (facing, dependent_faces)
}

/// Decides each connected set of unsure faces (ascending) in one plane. Returns the faces that do not keep
/// their own angle.
fn decide(faces: &CoplanarSearch, unsure: &[u32], facing: &mut [bool]) -> Vec<u32> {
    let neighbours: Vec<Vec<u32>> = unsure.par_iter().map(|face| faces.neighbours_in_plane(*face)).collect();
    let mut is_seen = vec![false; unsure.len()];
    let mut dependent_faces = Vec::new();
    for first in 0..unsure.len() {
        let (mut plane, mut open) = (Vec::new(), vec![first]);
        let mut widest: Option<(f64, u32)> = None;
        while let Some(at) = open.pop() {
            if std::mem::replace(&mut is_seen[at], true) {
                continue;
            }
            plane.push(unsure[at]);
            for neighbour in &neighbours[at] {
                if let Ok(unsure_index) = unsure.binary_search(neighbour) {
                    open.push(unsure_index);
                    continue;
                }
                let height = faces.height_of(*neighbour);
                let is_wider = |(max_height, face): &(f64, u32)| {
                    height > *max_height || height == *max_height && neighbour < face
                };
                if widest.as_ref().is_none_or(is_wider) {
                    widest = Some((height, *neighbour));
                }
            }
        }
        if widest.is_none() && plane.iter().all(|face| faces.is_facet(*face)) {
            continue;
        }
        let decided = widest.is_some_and(|(_, sure)| facing[sure as usize]);
        plane.iter().for_each(|face| facing[*face as usize] = decided);
        dependent_faces.append(&mut plane);
    }
    dependent_faces
}

/// Whether rounding may have turned a triangle through the line of sight.
fn is_unsure(frame: &Frame, &[a, b, c]: &[DVec3; 3], rounding: f64) -> bool {
    let (u, v, w) = (b - a, c - a, c - b);
    let normal = u.cross(v);
    let to_eye = if frame.perspective { frame.eye - a } else { -frame.forward };
    let (area, eye_dot) = (normal.length_squared(), normal.dot(to_eye));
    let eye_distance2 = to_eye.length_squared();
    if eye_dot * eye_dot > tolerances::MAX_UNSURE_SINE * tolerances::MAX_UNSURE_SINE * area * eye_distance2 {
        return false;
    }
    let longest = u.length_squared().max(v.length_squared()).max(w.length_squared()).sqrt();
    let threshold = EDGE_ON_SINE * area.sqrt() + 2.0 * rounding * longest;
    eye_dot * eye_dot <= threshold * threshold * eye_distance2
}
