//! Folds: edges along which a few faces turn from the eye while the smooth surface does not.
//!
//! The faces beyond an edge of the polyhedron's contour are walked through as long as they turn the
//! same way. Where the contour of the smooth surface is among them, the edge stands for it, as it does
//! where they reach a crease beyond which the other surface turns so too; where they come to an end
//! without either, they are a ripple of the mesh.

use crate::parallel::prelude::*;

use crate::lines::{FeatureSegment, Role};
use crate::mesh::{EdgeFaces, Mesh};
use crate::surface::SmoothNormals;
use crate::view::View;

/// Faces walked through; what turns away for more is no ripple.
const MOST_FACES: usize = 32;

/// Tells the folds among the witnesses. `facing` is n·v, one per smooth vertex.
pub(crate) fn tell(
    mesh: &Mesh,
    view: &View,
    smooth: &SmoothNormals,
    facing: &[f64],
    segments: &mut [FeatureSegment],
) {
    let surface = FoldedSurface { mesh, view, smooth, facing };
    segments.par_iter_mut().with_min_len(1 << 7).with_max_len(1 << 8).for_each(|segment| {
        let hosts = segment.hosts;
        if let Role::Witness { convex, fold } = &mut segment.role {
            // On a convex edge the eye sees the outside of the facing face, on a hollow one the inside
            // of the averted one; the surface turns from it in the other.
            let beyond = hosts.into_iter().find(|face| view.facing[*face as usize] != *convex);
            *fold = beyond.is_some_and(|face| surface.is_ripple(face));
        }
    });
}

struct FoldedSurface<'a> {
    mesh: &'a Mesh,
    view: &'a View,
    smooth: &'a SmoothNormals,
    facing: &'a [f64],
}

impl FoldedSurface<'_> {
    /// Whether the faces around one that turn as it does end before the smooth surface turns so.
    fn is_ripple(&self, first: u32) -> bool {
        let side = self.view.facing[first as usize];
        let mut faces = vec![first];
        let mut done = 0;
        while let Some(&face) = faces.get(done) {
            done += 1;
            let Some(corners) = self.smooth.corners_of(face) else { return false };
            if corners.iter().any(|v| (self.facing[*v as usize] >= 0.0) == side) || done > MOST_FACES {
                return false;
            }
            let triangle = self.mesh.triangles[face as usize];
            for k in 0..3 {
                let (a, b) = (triangle[k], triangle[(k + 1) % 3]);
                let Ok(edge) = self.mesh.edges.vertices.binary_search(&[a.min(b), a.max(b)]) else {
                    continue;
                };
                let EdgeFaces::Two { faces: pair, same_way } = self.mesh.edges.faces(edge) else { continue };
                let next = if pair[0] == face { pair[1] } else { pair[0] };
                let turns_so = (self.view.facing[next as usize] == side) != same_way;
                if self.smooth.across(self.mesh, edge).is_none() {
                    // What lies beyond a crease turns so as well: the surface is seen no more there.
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
