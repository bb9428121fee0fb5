//! Curved patches of machined components: patches between hard edges with enough curvature inside.
//!
//! 1. Faces of machined components are joined to patches across all edges that separate nothing.
//! 2. Patches with too many flat, coarse or elongated faces are excluded.
//! 3. A patch is curved if the angle defects at its inner vertices add up to a minimum.
//!
//! Source for curvature by angle defects: Meyer, Desbrun, Schröder and Barr, "Discrete differential-geometry
//! operators for triangulated 2-manifolds", 2002, section 4.

use std::sync::atomic::AtomicBool;
use std::sync::atomic::Ordering::Relaxed;

use crate::geometry::lists::disjoint_sets::DisjointSets;
use crate::parallel::prelude::*;

use super::component_classes::MIN_SAMPLE_EDGES;
use super::planar_regions::PlanarRegions;
use super::surface_class::SurfaceClass;
use crate::geometry::lists::group_sums::{summed, sums};
use crate::geometry::numbers::portable_math::acos;
use crate::mesh::{DihedralCosines, EdgeFaces, FaceId, Mesh, VertexRange, vertex_ranges};
use crate::parallel::task_size::MIN_TASK_ITEMS;
use crate::surface::tolerances;

/// Number of vertices per task, and number of tasks between two checks whether the sum is already sufficient.
const VERTICES_PER_BLOCK: usize = 1 << 15;
const BLOCKS_PER_ROUND: usize = 16;

/// Minimum total curvature of a patch that bends both ways, radians: 1/12 of a sphere's.
const MIN_TOTAL_CURVATURE_RAD: f64 = 1.0;
/// Maximum share of flat edges in a curved patch. Flat quads have a third.
const MAX_FLAT_EDGES: f64 = 0.45;
/// Maximum share of edges that turn by more than the second value (cosine of 15 degrees). A coarser patch of
/// a machined part has no unambiguous smooth shape and is drawn as its faces are.
const MAX_SHARP_TURN_EDGES: f64 = 0.1;
const MAX_SHARP_TURN_COSINE: f32 = 0.966;
/// Maximum share of planar area in a curved patch.
const MAX_PLANAR_AREA: f64 = 0.1;
/// Aspect ratio above which a face is elongated, and the maximum share of elongated faces by area. The
/// surface between the ends of such faces is unknown.
const MAX_FACE_ASPECT: f64 = 6.0;
const MAX_ELONGATED_AREA: f64 = 0.1;

/// Statistics of the edges inside one patch.
#[derive(Debug, Clone, Copy, Default)]
struct PatchEdgeStats {
    edges: u32,
    flat: u32,
    coarse: u32,
}

summed!(PatchEdgeStats: edges, flat, coarse);

impl PatchEdgeStats {
    /// Whether the edges allow a curved patch.
    fn may_be_free_form(&self) -> bool {
        self.edges >= MIN_SAMPLE_EDGES
            && f64::from(self.flat) <= MAX_FLAT_EDGES * f64::from(self.edges)
            && f64::from(self.coarse) <= MAX_SHARP_TURN_EDGES * f64::from(self.edges)
    }
}

/// Statistics of the faces of one patch.
#[derive(Debug, Clone, Copy, Default)]
struct PatchFaceStats {
    area: f64,
    in_flats: f64,
    in_long: f64,
}

summed!(PatchFaceStats: area, in_flats, in_long);

impl PatchFaceStats {
    /// Whether the faces allow a curved patch.
    fn may_be_free_form(&self) -> bool {
        self.in_flats <= MAX_PLANAR_AREA * self.area && self.in_long <= MAX_ELONGATED_AREA * self.area
    }
}

/// Marks the faces of machined components that lie in patches which bend both ways.
pub(crate) fn add_curved_patches(
    mesh: &Mesh,
    (turns, planes): (&DihedralCosines, &PlanarRegions),
    makes: &[SurfaceClass],
    parts: impl Fn(usize) -> bool + Sync,
    rounded: &mut [bool],
) {
    let machined = |face: u32| makes[face as usize] == SurfaceClass::Machined;
    let inner = |edge: usize| match mesh.edges.faces(edge) {
        EdgeFaces::Two { faces, same_way: false } if machined(faces[0]) && !parts(edge) => Some(faces),
        _ => None,
    };
    let edges = (0..mesh.edges.len()).into_par_iter().with_min_len(MIN_TASK_ITEMS);
    // Planar regions alone form no curved patch.
    if !edges.clone().any(|edge| !planes.flat.contains(edge) && inner(edge).is_some()) {
        return;
    }
    let groups = DisjointSets::new(mesh.triangles.len(), |join| {
        edges.clone().filter_map(inner).for_each(|[a, b]| join(a, b));
    });
    let patches = groups.numbered(|face| (!machined(face)).then_some(u32::MAX));
    let patch = |face: u32| patches.set_of_face[face as usize];
    let of_edges: Vec<PatchEdgeStats> = sums(patches.first.len(), mesh.edges.len(), |edge| {
        let [face, _] = inner(edge)?;
        let flat = u32::from(planes.flat.contains(edge));
        let coarse = u32::from(turns.of_two(edge) < MAX_SHARP_TURN_COSINE);
        Some((patch(face), PatchEdgeStats { edges: 1, flat, coarse }))
    });
    let mut asked: Vec<bool> = of_edges.iter().map(PatchEdgeStats::may_be_free_form).collect();
    if !asked.contains(&true) {
        return;
    }
    let asked_patch = |asked: &[bool], face: u32| {
        Some(patch(face)).filter(|patch| asked.get(*patch as usize) == Some(&true))
    };
    let of_faces: Vec<PatchFaceStats> = sums(patches.first.len(), mesh.triangles.len(), |face| {
        let face = face as u32;
        Some((asked_patch(&asked, face)?, of_face(mesh, planes, face)))
    });
    asked.iter_mut().zip(&of_faces).for_each(|(asked, of_faces)| *asked &= of_faces.may_be_free_form());
    if !asked.contains(&true) {
        return;
    }
    // Curvature is undefined at the border of a patch.
    let ends: Vec<AtomicBool> = (0..mesh.positions.len()).map(|_| AtomicBool::new(false)).collect();
    edges.filter(|edge| inner(*edge).is_none()).for_each(|edge| {
        mesh.edges.vertices[edge].iter().for_each(|vertex| ends[*vertex as usize].store(true, Relaxed));
    });
    let of_patch = |face: u32| asked_patch(&asked, face);
    let bent = bent(mesh, of_patch, |vertex| !ends[vertex].load(Relaxed), &asked);
    rounded.par_iter_mut().enumerate().with_min_len(MIN_TASK_ITEMS).for_each(|(face, rounded)| {
        *rounded |= bent.get(patch(face as u32) as usize) == Some(&true);
    });
}

/// Statistics of one face.
fn of_face(mesh: &Mesh, planes: &PlanarRegions, face: u32) -> PatchFaceStats {
    let area = mesh.area(FaceId(face));
    let in_flats = if planes.region_at(face).is_some() { area } else { 0.0 };
    let corners = mesh.corners(FaceId(face));
    let longest = (0..3).map(|k| corners[k].distance_squared(corners[(k + 1) % 3])).fold(0.0, f64::max);
    let in_long = if longest > MAX_FACE_ASPECT * 2.0 * area { area } else { 0.0 };
    PatchFaceStats { area, in_flats, in_long }
}

/// Which patches of `asked` reach the minimum total curvature, summed over their inner vertices.
///
/// Sums are nonnegative, so the summation stops as soon as all patches of `asked` have enough.
fn bent(
    mesh: &Mesh,
    of_patch: impl Fn(u32) -> Option<u32> + Sync,
    is_inner: impl Fn(usize) -> bool + Sync,
    asked: &[bool],
) -> Vec<bool> {
    let blocks = vertex_ranges(
        mesh.positions.len(),
        &mesh.triangles,
        mesh.positions.len().div_ceil(VERTICES_PER_BLOCK),
    );
    let mut curvature = vec![0.0; asked.len()];
    let mut open = asked.iter().filter(|asked| **asked).count();
    for some in blocks.chunks(BLOCKS_PER_ROUND) {
        let found: Vec<Vec<(u32, f64)>> = some
            .par_iter()
            .with_max_len(1)
            .map(|share| curvatures(mesh, share, &of_patch, &is_inner))
            .collect();
        for (patch, own) in found.into_iter().flatten() {
            let sum: &mut f64 = &mut curvature[patch as usize];
            open -= usize::from(*sum < MIN_TOTAL_CURVATURE_RAD && *sum + own >= MIN_TOTAL_CURVATURE_RAD);
            *sum += own;
        }
        if open == 0 {
            break;
        }
    }
    curvature.into_iter().map(|curvature| curvature >= MIN_TOTAL_CURVATURE_RAD).collect()
}

/// Absolute angle defects at the vertices of a block, summed in runs of one patch.
fn curvatures(
    mesh: &Mesh,
    share: &VertexRange,
    of_patch: impl Fn(u32) -> Option<u32>,
    is_inner: impl Fn(usize) -> bool,
) -> Vec<(u32, f64)> {
    // First patch at each vertex, if it is in question, and the sum of angles.
    let mut at: Vec<(Option<u32>, f64)> = vec![(None, 0.0); share.vertices.len()];
    for face in share.faces.iter().flat_map(Clone::clone) {
        let Some(patch) = of_patch(face as u32) else { continue };
        let corners = mesh.corners(FaceId(face as u32));
        for (k, vertex) in mesh.triangles[face].iter().map(|vertex| *vertex as usize).enumerate() {
            if share.vertices.contains(&vertex) && is_inner(vertex) {
                let [a, b] = [1, 2].map(|step| (corners[(k + step) % 3] - corners[k]).normalize_or_zero());
                let (first, angles) = &mut at[vertex - share.vertices.start];
                first.get_or_insert(patch);
                *angles += acos(a.dot(b).clamp(-1.0, 1.0));
            }
        }
    }
    let mut runs: Vec<(u32, f64)> = Vec::new();
    for (patch, angles) in at.into_iter().filter_map(|(patch, angles)| Some((patch?, angles))) {
        let own = ((std::f64::consts::TAU - angles).abs() - tolerances::ANGLE_ROUNDING_RAD).max(0.0);
        match runs.last_mut() {
            Some((last, sum)) if *last == patch => *sum += own,
            _ => runs.push((patch, own)),
        }
    }
    runs
}
