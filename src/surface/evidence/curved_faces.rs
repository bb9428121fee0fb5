//! [`CurvedFaces`]: which faces belong to curved surfaces.
//!
//! 1. Where the file shades a component, its normals decide, with split edges and creases as borders.
//! 2. Elsewhere the normals of the shape decide. Their borders are creases, rims of planar regions, and kinks of
//!    constructed parts: edges where the surface ends on both sides instead of going on as a curve.
//! 3. Components that the file shades face by face are not curved.

use super::normal_evidence::NormalEvidence;
use super::smooth_patches::SmoothPatches;
use crate::mesh::{DihedralCosines, EdgeFaces, EdgeSet, Mesh};
use crate::parallel::prelude::*;
use crate::parallel::task_size::MIN_TASK_ITEMS;
use crate::surface::creases::low_angle::surface_trace::SurfaceTracer;
use crate::surface::normals::file_normals::file_normals;
use crate::surface::patches::planar_regions::PlanarRegions;
use crate::surface::patches::surface_class::{ComponentClasses, FileShading, MeshSource};
use crate::surface::{HardEdges, SmoothNormals};

/// Cosine (1 degree) below which an edge may be a kink.
const MAX_KINK_COSINE: f32 = 0.999_85;

/// Input of the decision.
pub(crate) struct CurvedFaces<'a> {
    pub mesh: &'a Mesh,
    pub turns: &'a DihedralCosines,
    pub planes: &'a PlanarRegions,
    pub classes: &'a ComponentClasses,
    pub evidence: &'a NormalEvidence,
    pub hard: &'a HardEdges,
}

impl CurvedFaces<'_> {
    /// Whether each face belongs to a curved surface, and the edges besides creases that separate surfaces.
    /// `rims` are those of planar regions and wide faces.
    pub(crate) fn find(&self, rims: &EdgeSet, crease_deg: f64) -> (Vec<bool>, EdgeSet) {
        let Self { mesh, evidence, hard, .. } = self;
        let shading = |face: u32| self.classes.class_of_face(face).shading;
        let is_shaded = |face: u32| shading(face) == FileShading::Curved;
        let is_bare = |face: u32| shading(face) == FileShading::None;
        let faces = (0..mesh.triangles.len() as u32).into_par_iter().with_min_len(MIN_TASK_ITEMS);
        let shaded = (!evidence.is_empty()).then(|| {
            let normals = |face: u32| evidence.is_believed(face).then(|| file_normals(mesh, face as usize));
            let parts = |edge: usize| evidence.split.contains(edge) || hard.is_hard(edge);
            SmoothPatches::new(mesh, is_shaded, normals, parts)
        });
        let is_any_bare = faces.clone().any(is_bare);
        // The faces of a scan turn at random.
        let is_made = |face: u32| {
            let class = self.classes.class_of_face(face);
            class.shading == FileShading::None && class.origin == MeshSource::Constructed
        };
        let kinks =
            if faces.clone().any(is_made) { self.kinks(is_made, crease_deg) } else { EdgeSet::default() };
        let borders = rims.union(&kinks);
        let bare = is_any_bare.then(|| {
            let parts = |edge: usize| hard.is_hard(edge) || borders.contains(edge);
            let smooth = SmoothNormals::without_straight_edges(mesh, is_bare, parts);
            let normals =
                |face: u32| smooth.corners_of(face).map(|ids| ids.map(|id| smooth.normals[id as usize]));
            SmoothPatches::new(mesh, is_bare, normals, parts)
        });
        let is_curved = |face: u32| {
            let patches = if is_shaded(face) { &shaded } else { &bare };
            patches.as_ref().is_some_and(|patches| patches.is_curved(face))
        };
        (faces.map(is_curved).collect(), borders.union(&evidence.split))
    }

    /// Edges between bare faces where the surface ends on both sides.
    fn kinks(&self, is_bare: impl Fn(u32) -> bool + Sync, crease_deg: f64) -> EdgeSet {
        let Self { mesh, turns, planes, hard, .. } = self;
        let walk = SurfaceTracer::new(mesh, (turns, &planes.flat), hard, crease_deg);
        EdgeSet::collect(mesh.edges.len(), |edge| {
            let EdgeFaces::Two { faces, .. } = mesh.edges.faces(edge) else { return false };
            turns.of_two(edge) < MAX_KINK_COSINE
                && faces.iter().all(|face| is_bare(*face))
                && !hard.is_hard(edge)
                && walk.ends_at(edge).is_some()
        })
    }
}
