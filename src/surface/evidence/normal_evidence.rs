//! [`NormalEvidence`]: edges that the normals of a file split or smooth.
//!
//! 1. The normals of a component say something if enough of its faces are curved by them.
//! 2. Of such a component the normals are believed face by face.
//! 3. An edge between two believed faces is *split* if their normals differ there, and *soft* if they agree
//!    although the faces turn. Nothing is soft on a patch that is too coarse to be curved.

use glam::Vec3;

use super::smooth_patches::SmoothPatches;
use crate::geometry::numbers::portable_math::acos;
use crate::mesh::{DihedralCosines, EdgeFaces, EdgeSet, Mesh, VertexEdges};
use crate::parallel::prelude::*;
use crate::parallel::task_size::MIN_TASK_ITEMS;
use crate::surface::normals::file_normals::{file_cosines, file_normals};
use crate::surface::patches::normal_validation::{leaning, leans};

/// Cosine (80 degrees) below which a corner normal contradicts its face.
const MAX_ASTRAY_COSINE: f32 = 0.17;
/// Minimum angle (20 degrees) between two normals that differ. A crease that fades out differs by half as much
/// in the middle of its last edge.
const MIN_SPLIT_RAD: f64 = 0.349;
/// Largest difference of the normals at a soft edge, as a share of the turn of its faces.
const MAX_SOFT_SHARE: f64 = 0.5;
/// Cosine (0.5 degrees) above which an edge does not turn.
const MAX_TURNING_COSINE: f32 = 0.999_96;

/// Edges that the normals of a file split or smooth. Empty where they say nothing.
#[derive(Debug, Clone, Default)]
pub(crate) struct NormalEvidence {
    /// Whether the normals of each face are believed; empty if none are.
    believed: Vec<bool>,
    /// Edges where the normals of two believed faces differ.
    pub split: EdgeSet,
    /// Edges where two believed faces turn, and their normals do not.
    pub soft: EdgeSet,
}

impl NormalEvidence {
    /// Reads the normals of the faces that satisfy `may`.
    pub(crate) fn new(mesh: &Mesh, turns: &DihedralCosines, may: impl Fn(u32) -> bool + Sync) -> Self {
        if mesh.corner_normals.is_empty() {
            return Self::default();
        }
        let edges = VertexEdges::of(&mesh.edges, mesh.positions.len());
        let fits = |face: u32| may(face) && fits(mesh, (turns, &edges), face);
        let faces = (0..mesh.triangles.len() as u32).into_par_iter().with_min_len(MIN_TASK_ITEMS);
        let believed: Vec<bool> = faces.map(fits).collect();
        if !believed.contains(&true) {
            return Self::default();
        }
        // Angles between the normals of both faces, in the middle of an edge and at most, and that of the faces.
        let angles = |edge: usize| {
            let EdgeFaces::Two { faces, .. } = mesh.edges.faces(edge) else { return None };
            let cosine = turns.of_two(edge);
            if cosine >= MAX_TURNING_COSINE || !faces.iter().all(|face| believed[*face as usize]) {
                return None;
            }
            let angle = |cosine: f32| acos(f64::from(cosine.clamp(-1.0, 1.0)));
            let [a, b] = file_cosines(mesh, edge, faces)?.map(angle);
            Some(EdgeAngles { middle: (a + b) / 2.0, most: a.max(b), faces: angle(cosine) })
        };
        let edges = mesh.edges.len();
        let split = EdgeSet::collect(edges, |edge| angles(edge).is_some_and(|a| a.middle >= MIN_SPLIT_RAD));
        let normals = |face: u32| believed[face as usize].then(|| file_normals(mesh, face as usize));
        let patches = SmoothPatches::new(mesh, &may, normals, |edge| split.contains(edge));
        let soft = EdgeSet::collect(edges, |edge| {
            angles(edge).is_some_and(|a| a.middle < MIN_SPLIT_RAD && a.most < MAX_SOFT_SHARE * a.faces)
                && !patches.is_coarse(mesh.edges.faces(edge).list()[0])
        });
        Self { believed, split, soft }
    }

    /// Whether no normal is believed.
    pub(crate) fn is_empty(&self) -> bool {
        self.believed.is_empty()
    }

    /// Whether the normals of a face are believed.
    #[inline]
    pub(crate) fn is_believed(&self, face: u32) -> bool {
        self.believed.get(face as usize) == Some(&true)
    }
}

/// Whether the normals of a face can be those of a surface through it: none contradicts the face, and they do
/// not all lean.
fn fits(mesh: &Mesh, around: (&DihedralCosines, &VertexEdges), face: u32) -> bool {
    let own = Vec3::from_array(mesh.face_normals[face as usize]);
    let Some(ids) = mesh.corner_normals.get(face as usize) else { return false };
    let normals = ids.map(|id| mesh.normals.get(id as usize));
    let is_astray = |normal: Option<&[f32; 3]>| {
        normal.is_none_or(|n| Vec3::from_array(*n).dot(own).abs() < MAX_ASTRAY_COSINE)
    };
    !normals.into_iter().any(is_astray)
        && leaning(own, normals).is_none_or(|cosine| !leans(mesh, around, face, cosine))
}

/// Angles at an edge, radians.
struct EdgeAngles {
    /// Mean of the angles between the normals of both faces at its ends.
    middle: f64,
    /// Larger of these two.
    most: f64,
    /// Turn of the faces.
    faces: f64,
}
