//! [`SmoothPatches`]: which surfaces are curved by the normals at their corners.
//!
//! 1. Faces are joined to patches across all edges that separate nothing.
//! 2. A patch is curved if its normals vary on enough of its area.
//! 3. A patch is too coarse if the arcs over its edges rise too far for its size: averaged normals make no
//!    ball of a cube.

use glam::DVec3;

use crate::geometry::lists::disjoint_sets::{DisjointSets, NumberedSets};
use crate::geometry::lists::group_sums::{summed, sums};
use crate::mesh::edges::triangle_sides::sides;
use crate::mesh::{EdgeFaces, FaceId, Mesh, VertexEdges};
use crate::parallel::prelude::*;
use crate::parallel::task_size::MIN_TASK_ITEMS;
use crate::surface::EdgeArc;

/// Cosine (2 degrees) below which the normals of a face vary.
const MAX_EVEN_COSINE: f64 = 0.9994;
/// Minimum share of the area of a curved patch on which normals vary.
const MIN_VARYING_AREA: f64 = 0.05;
/// Maximum rise of an arc, as a share of the square root of the area of its patch. The arcs of a hexagonal
/// tube as long as wide have 0.05, those over the edges of a cube whose normals are averaged 0.061.
const MAX_RISE: f64 = 0.06;
/// Maximum share of the area of a patch whose arcs rise further.
const MAX_COARSE_AREA: f64 = 0.1;

/// Patches of a mesh.
pub(crate) struct SmoothPatches {
    patch_of_face: Vec<u32>,
    is_curved: Vec<bool>,
    is_coarse: Vec<bool>,
}

/// Areas of a patch: all, with varying normals, and with arcs that rise too far.
#[derive(Debug, Clone, Copy, Default)]
struct PatchAreas {
    all: f64,
    varying: f64,
    coarse: f64,
}

summed!(PatchAreas: all, varying, coarse);

impl SmoothPatches {
    /// The patches of the faces that satisfy `is_asked`. Edges with `parts` separate them. `normals` are those
    /// at the corners of a face, toward its front; `None` where they are unknown.
    pub(crate) fn new(
        mesh: &Mesh,
        is_asked: impl Fn(u32) -> bool + Sync,
        normals: impl Fn(u32) -> Option<[DVec3; 3]> + Sync,
        parts: impl Fn(usize) -> bool + Sync,
    ) -> Self {
        let joined = |edge: usize| match mesh.edges.faces(edge) {
            EdgeFaces::Two { faces, same_way: false } if !parts(edge) => {
                Some(faces).filter(|faces| faces.iter().all(|face| is_asked(*face)))
            }
            _ => None,
        };
        let edges = (0..mesh.edges.len()).into_par_iter().with_min_len(MIN_TASK_ITEMS);
        let groups = DisjointSets::new(mesh.triangles.len(), |join| {
            edges.filter_map(joined).for_each(|[a, b]| join(a, b));
        });
        let NumberedSets { set_of_face, first } =
            groups.numbered(|face| (!is_asked(face)).then_some(u32::MAX));
        let patch = |face: usize| Some(set_of_face[face]).filter(|patch| *patch != u32::MAX);
        let varying = |face: usize| normals(face as u32).filter(|normals| vary(*normals));
        let mut areas: Vec<PatchAreas> = sums(first.len(), mesh.triangles.len(), |face| {
            let (patch, all) = (patch(face)?, mesh.area(FaceId(face as u32)));
            let varying = if varying(face).is_some() { all } else { 0.0 };
            Some((patch, PatchAreas { all, varying, coarse: 0.0 }))
        });
        let at = VertexEdges::of(&mesh.edges, mesh.positions.len());
        let coarse: Vec<PatchAreas> = sums(first.len(), mesh.triangles.len(), |face| {
            let (patch, normals) = (patch(face)?, varying(face)?);
            let most = MAX_RISE * areas[patch as usize].all.sqrt();
            let rises = |k: usize| {
                let [a, b] = sides(mesh.triangles[face])[k];
                let ends = [a, b].map(|v| mesh.positions[v as usize]);
                EdgeArc::new(ends, [normals[k], normals[(k + 1) % 3]]).height().length() > most
                    && at.between(a, b).is_some_and(|edge| joined(edge).is_some())
            };
            let coarse = mesh.area(FaceId(face as u32));
            (0..3).any(rises).then(|| (patch, PatchAreas { coarse, ..PatchAreas::default() }))
        });
        areas.iter_mut().zip(&coarse).for_each(|(areas, coarse)| *areas += coarse);
        Self {
            patch_of_face: set_of_face,
            is_curved: areas.iter().map(|areas| areas.varying > MIN_VARYING_AREA * areas.all).collect(),
            is_coarse: areas.iter().map(|areas| areas.coarse > MAX_COARSE_AREA * areas.all).collect(),
        }
    }

    /// Whether a face lies in a curved patch that is not too coarse.
    pub(crate) fn is_curved(&self, face: u32) -> bool {
        self.patch(face).is_some_and(|patch| self.is_curved[patch] && !self.is_coarse[patch])
    }

    /// Whether a face lies in a patch that is too coarse.
    pub(crate) fn is_coarse(&self, face: u32) -> bool {
        self.patch(face).is_some_and(|patch| self.is_coarse[patch])
    }

    fn patch(&self, face: u32) -> Option<usize> {
        let patch = self.patch_of_face[face as usize];
        (patch != u32::MAX).then_some(patch as usize)
    }
}

/// Whether three unit normals differ.
fn vary([a, b, c]: [DVec3; 3]) -> bool {
    a.dot(b).min(b.dot(c)).min(c.dot(a)) < MAX_EVEN_COSINE
}
