//! Which faces are seen edge-on, decided once for all faces of a plane.
//!
//! 1. A face is edge-on if the angle between its plane and the line of sight is below
//!    [`EDGE_ON_SINE`](tolerance::EDGE_ON_SINE): nothing of it can be seen.
//! 2. Rounding turns a face by up to the rounding divided by its height. Where the angle is smaller than that, the face is *unsure*.
//! 3. An unsure face follows the widest face of its plane that is connected with it ([`carriers`](crate::mesh::carriers)).
//! 4. If that one is unsure as well, or there is none, it is edge-on.
//!
//! Edge-on faces count as averted.

use glam::DVec3;
use rayon::prelude::*;

use super::Frame;
use crate::math::grain::GRAIN;
use crate::math::tolerance;
use crate::mesh::carriers::Faces;
use crate::mesh::{FaceId, Mesh};

/// Beyond an angle with this sine no face is unsure; narrow faces that rounding may turn by more have a carrier in the mesh, or none.
const MAX_UNSURE_SINE: f64 = 1e-2;

/// Whether each face turns its outside to the eye, and the faces, ascending, for which this does not follow from their own angle.
pub(super) fn facing(mesh: &Mesh, frame: &Frame) -> (Vec<bool>, Vec<u32>) {
    let corners = |face: u32| mesh.corners(FaceId(face));
    let own = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| mesh.positions[v as usize]);
        frame.faces_eye(a, b, c)
    };
    let mut facing: Vec<bool> = mesh.triangles.par_iter().with_min_len(GRAIN).map(own).collect();
    for [face, carrier] in &mesh.carriers {
        facing[*face as usize] = facing[*carrier as usize];
    }
    if !mesh.extents.is_rounded() {
        return (facing, Vec::new());
    }
    let is_unsure = |face: u32| {
        let rounding = mesh.extent(FaceId(face)).rounding;
        rounding > 0.0 && is_unsure(frame, &corners(face), rounding)
    };
    let faces = (0..mesh.triangles.len() as u32).into_par_iter().with_min_len(GRAIN);
    let unsure: Vec<u32> = faces.filter(|face| is_unsure(*face)).collect();
    let planes = Faces::of(mesh);
    let decide = |face: &u32| {
        let carrier = planes.widest(*face).filter(|carrier| !is_unsure(*carrier));
        carrier.is_some_and(|carrier| facing[carrier as usize])
    };
    let decided: Vec<bool> = unsure.par_iter().map(decide).collect();
    for (face, faces_eye) in unsure.iter().zip(decided) {
        facing[*face as usize] = faces_eye;
    }
    let mut others: Vec<u32> = mesh.carriers.iter().map(|[face, _]| *face).chain(unsure).collect();
    others.sort_unstable();
    others.dedup();
    (facing, others)
}

/// Whether rounding may have turned a triangle through the line of sight.
fn is_unsure(frame: &Frame, &[a, b, c]: &[DVec3; 3], rounding: f64) -> bool {
    let (u, v, w) = (b - a, c - a, c - b);
    let normal = u.cross(v);
    let to_eye = if frame.perspective { frame.eye - a } else { -frame.forward };
    let (area, away) = (normal.length_squared(), normal.dot(to_eye));
    let far = to_eye.length_squared();
    if away * away > MAX_UNSURE_SINE * MAX_UNSURE_SINE * area * far {
        return false;
    }
    let longest = u.length_squared().max(v.length_squared()).max(w.length_squared()).sqrt();
    let least = tolerance::EDGE_ON_SINE * area.sqrt() + 2.0 * rounding * longest;
    away * away <= least * least * far
}
