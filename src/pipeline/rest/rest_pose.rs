//! [`RestPose`]: rest positions of the vertices of a posed mesh, so that patterns laid through the model move
//! with it.

use crate::parallel::prelude::*;
use glam::DVec3;

use super::chain_anchors::Anchors;
use crate::chains::Anchor;
use crate::mesh::{Mesh, PartId};

/// Posed mesh with its rest positions.
pub(crate) struct RestPose<'a> {
    anchors: &'a Anchors,
    /// Rest positions in world space, one per vertex.
    places: Vec<DVec3>,
}

impl<'a> RestPose<'a> {
    /// `None` if every part is in its rest position.
    pub(crate) fn new(anchors: &'a Anchors, mesh: &Mesh) -> Option<Self> {
        if anchors.rests() {
            return None;
        }
        let mut parts = vec![None; mesh.positions.len()];
        for (face, part) in mesh.triangles.iter().zip(&mesh.face_part) {
            for vertex in face {
                if let Some(own) = parts.get_mut(*vertex as usize) {
                    own.get_or_insert(*part);
                }
            }
        }
        let rest = |(p, part): (&DVec3, Option<PartId>)| {
            let world = *p + mesh.origin;
            part.and_then(|part| anchors.at_rest(part, world)).unwrap_or(world)
        };
        Some(Self { anchors, places: mesh.positions.par_iter().zip(parts).map(rest).collect() })
    }

    /// The rest positions of a face's corners, world. `None` for invalid vertex numbers.
    pub(crate) fn corners(&self, triangle: [u32; 3]) -> Option<[DVec3; 3]> {
        let [a, b, c] = triangle.map(|vertex| self.places.get(vertex as usize).copied());
        Some([a?, b?, c?])
    }

    /// The anchor of a point on the posed surface of a part, world.
    pub(crate) fn anchor(&self, part: PartId, world: DVec3) -> Option<Anchor> {
        self.anchors.anchor_at(part, world)
    }
}
