//! [`ComponentStats`]: statistics of the faces and edges of a connected component, summed for its
//! classification.

use glam::Vec3;

use super::normal_validation::leaning;
use super::planar_regions::PlanarRegions;
use super::sliver_bends::{SliverFace, longest_side};
use crate::geometry::lists::group_sums::summed;
use crate::mesh::{DihedralCosines, EdgeFaces, FaceId, Mesh};

/// Cosine below which an edge is sharp: 60 degrees.
const MAX_SHARP_COSINE: f32 = 0.5;
/// Cosine above which an edge is nearly flat: one degree, ten times the limit of a flat edge. If turns are
/// noise, a tenth of the nearly flat edges are flat.
const MIN_NEARLY_FLAT_COSINE: f32 = 0.999_847_7;
/// Cosine above which a corner normal equals the face normal.
const MIN_OWN_NORMAL_COSINE: f32 = 0.9999;
/// Cosine (80 degrees) below which a corner normal contradicts its face.
const MAX_ASTRAY_COSINE: f32 = 0.17;

/// Statistics of one component.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct ComponentStats {
    pub faces: FaceStats,
    pub edges: EdgeStats,
    pub bends: SliverBends,
    /// Faces whose normals in the file all deviate by more than the surface turns. Counted only if many
    /// deviate at all.
    pub deviating_faces: u32,
}

/// Statistics of the faces of a component.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct FaceStats {
    pub all: u32,
    pub curved: u32,
    pub with_normals: u32,
    pub contradicting: u32,
    /// Faces whose normals in the file all deviate.
    pub deviating: u32,
    pub area: f64,
    pub in_flats: f64,
    pub level: f64,
    /// Sum of the longest sides of all faces, and of sliver faces.
    pub longest: f64,
    pub sliver_length: f64,
}

/// Statistics of the edges between two faces with area.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct EdgeStats {
    pub all: u32,
    pub flat: u32,
    pub nearly_flat: u32,
    pub sharp: u32,
}

/// Short sides where slivers bend, and the longest sides of these slivers, counted once per side.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct SliverBends {
    pub all: u32,
    pub longest: f64,
}

summed!(ComponentStats: faces, edges, bends, deviating_faces);
summed!(FaceStats: all, curved, with_normals, contradicting, deviating, area, in_flats, level, longest, sliver_length);
summed!(EdgeStats: all, flat, nearly_flat, sharp);
summed!(SliverBends: all, longest);

/// Statistics of an edge between two faces with area, with one of its faces.
#[inline]
pub(crate) fn of_edge(
    mesh: &Mesh,
    turns: &DihedralCosines,
    planes: &PlanarRegions,
    edge: usize,
) -> Option<(u32, EdgeStats)> {
    let cosine = turns.of_two(edge);
    let EdgeFaces::Two { faces, .. } = mesh.edges.faces(edge) else { return None };
    // The cosine is zero next to a face without area.
    if cosine == 0.0 && faces.iter().any(|f| mesh.face_normals[*f as usize] == [0.0; 3]) {
        return None;
    }
    let flat = u32::from(planes.flat.contains(edge));
    let nearly_flat = u32::from(cosine > MIN_NEARLY_FLAT_COSINE);
    let sharp = u32::from(cosine < MAX_SHARP_COSINE);
    Some((faces[0], EdgeStats { all: 1, flat, nearly_flat, sharp }))
}

/// Statistics of a face.
#[inline]
pub(crate) fn of_face(mesh: &Mesh, planes: &PlanarRegions, face: u32) -> FaceStats {
    let area = mesh.area(FaceId(face));
    let in_flats = if planes.region_at(face).is_some() { area } else { 0.0 };
    let level = if planes.is_level(face) { area } else { 0.0 };
    let longest = longest_side(mesh, face);
    let slender = if SliverFace::is_sliver(area, longest) { longest } else { 0.0 };
    let mut count =
        FaceStats { all: 1, area, in_flats, level, longest, sliver_length: slender, ..FaceStats::default() };
    if let Some(ids) = mesh.corner_normals.get(face as usize) {
        let own = Vec3::from_array(mesh.face_normals[face as usize]);
        let normals = ids.map(|id| mesh.normals.get(id as usize));
        let leaves = |n: &[f32; 3]| Vec3::from_array(*n).dot(own).abs() < MIN_OWN_NORMAL_COSINE;
        count.with_normals = u32::from(normals.iter().all(Option::is_some));
        count.curved = u32::from(normals.iter().flatten().any(|n| leaves(n)));
        let strays = |n: &[f32; 3]| Vec3::from_array(*n).dot(own).abs() < MAX_ASTRAY_COSINE;
        count.contradicting = u32::from(normals.iter().flatten().any(|n| strays(n)));
        count.deviating = u32::from(leaning(own, normals).is_some());
    }
    count
}

/// Deviation of the file normals from a face as a cosine, if all of them deviate.
pub(crate) fn leaning_at(mesh: &Mesh, face: u32) -> Option<f32> {
    let ids = mesh.corner_normals.get(face as usize)?;
    leaning(Vec3::from_array(mesh.face_normals[face as usize]), ids.map(|id| mesh.normals.get(id as usize)))
}
