//! Ripple edges: contour edges where a few faces turn away from the camera, but the smooth surface does not.
//!
//! 1. From an edge of the mesh contour, the connected faces that turn the same way are visited.
//! 2. If the smooth contour passes them, or they reach a crease where the next surface turns away too, the
//!    edge is a real contour.
//! 3. If they end without either, they are a ripple of the mesh.

use crate::parallel::prelude::*;

use crate::lines::{FeatureSegment, Role};
use crate::mesh::{EdgeFaces, Mesh};
use crate::surface::SmoothNormals;
use crate::view::View;

/// Maximum number of faces in a ripple.
const MAX_RIPPLE_FACES: usize = 32;

/// Marks the ripple edges among the mesh contours. `facing` is n·v, one per smooth vertex.
pub(crate) fn mark_ripples(
    mesh: &Mesh,
    view: &View,
    smooth: &SmoothNormals,
    facing: &[f64],
    segments: &mut [FeatureSegment],
) {
    let surface = RippleTest { mesh, view, smooth, facing };
    segments.par_iter_mut().with_min_len(1 << 7).with_max_len(1 << 8).for_each(|segment| {
        let hosts = segment.hosts;
        if let Role::MeshContour { convex, fold } = &mut segment.role {
            // On a convex edge the camera sees the outside of the facing face; on a concave one the inside of
            // the averted face. The surface turns away in the other face.
            let beyond = hosts.into_iter().find(|face| view.facing[*face as usize] != *convex);
            *fold = beyond.is_some_and(|face| surface.is_ripple(face));
        }
    });
}

struct RippleTest<'a> {
    mesh: &'a Mesh,
    view: &'a View,
    smooth: &'a SmoothNormals,
    facing: &'a [f64],
}

impl RippleTest<'_> {
    /// Whether the connected faces with the same orientation end before the smooth surface turns.
    fn is_ripple(&self, first: u32) -> bool {
        let side = self.view.facing[first as usize];
        let mut faces = vec![first];
        let mut done = 0;
        while let Some(&face) = faces.get(done) {
            done += 1;
            let Some(corners) = self.smooth.corners_of(face) else { return false };
            if corners.iter().any(|v| (self.facing[*v as usize] >= 0.0) == side) || done > MAX_RIPPLE_FACES {
                return false;
            }
            let triangle = self.mesh.triangles[face as usize];
            for k in 0..3 {
                let (a, b) = (triangle[k], triangle[(k + 1) % 3]);
                let Some(edge) = self.mesh.edges.between(a, b) else {
                    continue;
                };
                let EdgeFaces::Two { faces: pair, same_way } = self.mesh.edges.faces(edge) else { continue };
                let next = if pair[0] == face { pair[1] } else { pair[0] };
                let turns_so = (self.view.facing[next as usize] == side) != same_way;
                if self.smooth.across(self.mesh, edge).is_none() {
                    // The surface across the crease turns away too, so the contour is real.
                    if turns_so {
                        return false;
                    }
                } else if turns_so && !faces.contains(&next) {
                    faces.push(next);
                }
            }
        }
        true
    }
}
