//! [`AtRest`]: where the vertices of a posed mesh rest, so that what is laid through the model moves with it.

use crate::parallel::prelude::*;
use glam::DVec3;

use super::chain_anchors::Anchors;
use crate::chains::Anchor;
use crate::mesh::{Mesh, PartId};

/// A posed mesh as it rests.
pub(crate) struct AtRest<'a> {
    anchors: &'a Anchors,
    /// World places, one a vertex.
    places: Vec<DVec3>,
}

impl<'a> AtRest<'a> {
    /// None where all stands as it rests.
    pub fn new(anchors: &'a Anchors, mesh: &Mesh) -> Option<Self> {
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

    /// Where the corners of a face rest, world; `None` for numbers that are none.
    pub fn corners(&self, triangle: [u32; 3]) -> Option<[DVec3; 3]> {
        let [a, b, c] = triangle.map(|vertex| self.places.get(vertex as usize).copied());
        Some([a?, b?, c?])
    }

    /// Where on its part a point of the posed surface is, world.
    pub fn anchor(&self, part: PartId, world: DVec3) -> Option<Anchor> {
        self.anchors.place(part, world)
    }
}
