//! Curved patches of machined components: patches between hard edges with enough curvature inside.
//!
//! 1. Faces of machined components are joined to patches across all edges that separate nothing.
//! 2. Patches with too many flat, coarse or elongated faces are excluded.
//! 3. A patch is curved if the angle defects at its inner vertices add up to a minimum.
//!
//! Source for curvature by angle defects: Meyer, Desbrun, Schröder and Barr, "Discrete differential-geometry
//! operators for triangulated 2-manifolds", 2002, section 4.

use std::ops::AddAssign;
use std::sync::atomic::AtomicBool;
use std::sync::atomic::Ordering::Relaxed;

use crate::parallel::prelude::*;

use super::component_classes::LEAST_EDGES;
use super::group_sums::sums;
use super::planar_regions::{Planes, area};
use super::surface_class::Make;
use crate::geometry::numbers::portable_math::acos;
use crate::mesh::components::disjoint_sets::Groups;
use crate::parallel::task_size::GRAIN;

use crate::mesh::{EdgeFaces, FaceId, Mesh, Share, Turns, shares};

/// Number of vertices per task, and number of tasks between two checks whether the sum is already sufficient.
const BLOCK: usize = 1 << 15;
const AT_ONCE: usize = 16;

/// Minimum total curvature of a patch that bends both ways, radians: 1/12 of a sphere's.
const FREE_FORM: f64 = 1.0;
/// Maximum angle defect, radians, that rounding causes at a vertex of a cylinder.
const ROUNDING: f64 = 2e-4;
/// Maximum share of flat edges in a curved patch. Flat quads have a third.
const MANY_FLAT: f64 = 0.45;
/// Maximum share of edges that turn by more than the second value (cosine of 15 degrees). A coarser patch of
/// a machined part has no unambiguous smooth shape and is drawn as its faces are.
const FEW_COARSE: f64 = 0.1;
const COARSE_COSINE: f32 = 0.966;
/// Maximum share of planar area in a curved patch.
const FEW_FLATS: f64 = 0.1;
/// Aspect ratio above which a face is elongated, and the maximum share of elongated faces by area. The
/// surface between the ends of such faces is unknown.
const LONG: f64 = 6.0;
const FEW_LONG: f64 = 0.1;

/// Statistics of the edges inside one patch.
#[derive(Debug, Clone, Copy, Default)]
struct EdgeCount {
    edges: u32,
    flat: u32,
    coarse: u32,
}

impl AddAssign<&EdgeCount> for EdgeCount {
    fn add_assign(&mut self, other: &Self) {
        self.edges += other.edges;
        self.flat += other.flat;
        self.coarse += other.coarse;
    }
}

impl EdgeCount {
    /// Whether the edges allow a curved patch.
    fn may_be_free_form(&self) -> bool {
        self.edges >= LEAST_EDGES
            && f64::from(self.flat) <= MANY_FLAT * f64::from(self.edges)
            && f64::from(self.coarse) <= FEW_COARSE * f64::from(self.edges)
    }
}

/// Statistics of the faces of one patch.
#[derive(Debug, Clone, Copy, Default)]
struct FaceCount {
    area: f64,
    in_flats: f64,
    in_long: f64,
}

impl AddAssign<&FaceCount> for FaceCount {
    fn add_assign(&mut self, other: &Self) {
        self.area += other.area;
        self.in_flats += other.in_flats;
        self.in_long += other.in_long;
    }
}

impl FaceCount {
    /// Whether the faces allow a curved patch.
    fn may_be_free_form(&self) -> bool {
        self.in_flats <= FEW_FLATS * self.area && self.in_long <= FEW_LONG * self.area
    }
}

/// Marks the faces of machined components that lie in patches which bend both ways.
pub(crate) fn add_free_forms(
    mesh: &Mesh,
    (turns, planes): (&Turns, &Planes),
    makes: &[Make],
    parts: impl Fn(usize) -> bool + Sync,
    rounded: &mut [bool],
) {
    let machined = |face: u32| makes[face as usize] == Make::Machined;
    let inner = |edge: usize| match mesh.edges.faces(edge) {
        EdgeFaces::Two { faces, same_way: false } if machined(faces[0]) && !parts(edge) => Some(faces),
        _ => None,
    };
    let edges = (0..mesh.edges.len()).into_par_iter().with_min_len(GRAIN);
    // Planar regions alone form no curved patch.
    if !edges.clone().any(|edge| !planes.flat.contains(edge) && inner(edge).is_some()) {
        return;
    }
    let groups = Groups::new(mesh.triangles.len(), |join| {
        edges.clone().filter_map(inner).for_each(|[a, b]| join(a, b));
    });
    let patches = groups.numbered(|face| (!machined(face)).then_some(u32::MAX));
    let patch = |face: u32| patches.of_face[face as usize];
    let of_edges: Vec<EdgeCount> = sums(patches.first.len(), mesh.edges.len(), |edge| {
        let [face, _] = inner(edge)?;
        let flat = u32::from(planes.flat.contains(edge));
        let coarse = u32::from(turns.of_two(edge) < COARSE_COSINE);
        Some((patch(face), EdgeCount { edges: 1, flat, coarse }))
    });
    let mut asked: Vec<bool> = of_edges.iter().map(EdgeCount::may_be_free_form).collect();
    if !asked.contains(&true) {
        return;
    }
    let asked_patch = |asked: &[bool], face: u32| {
        Some(patch(face)).filter(|patch| asked.get(*patch as usize) == Some(&true))
    };
    let of_faces: Vec<FaceCount> = sums(patches.first.len(), mesh.triangles.len(), |face| {
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
    rounded.par_iter_mut().enumerate().with_min_len(GRAIN).for_each(|(face, rounded)| {
        *rounded |= bent.get(patch(face as u32) as usize) == Some(&true);
    });
}

/// Statistics of one face.
fn of_face(mesh: &Mesh, planes: &Planes, face: u32) -> FaceCount {
    let area = area(mesh, face);
    let in_flats = if planes.of(face).is_some() { area } else { 0.0 };
    let corners = mesh.corners(FaceId(face));
    let longest = (0..3).map(|k| corners[k].distance_squared(corners[(k + 1) % 3])).fold(0.0, f64::max);
    let in_long = if longest > LONG * 2.0 * area { area } else { 0.0 };
    FaceCount { area, in_flats, in_long }
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
    let blocks = shares(mesh.positions.len(), &mesh.triangles, mesh.positions.len().div_ceil(BLOCK));
    let mut curvature = vec![0.0; asked.len()];
    let mut open = asked.iter().filter(|asked| **asked).count();
    for some in blocks.chunks(AT_ONCE) {
        let found: Vec<Vec<(u32, f64)>> = some
            .par_iter()
            .with_max_len(1)
            .map(|share| curvatures(mesh, share, &of_patch, &is_inner))
            .collect();
        for (patch, own) in found.into_iter().flatten() {
            let sum: &mut f64 = &mut curvature[patch as usize];
            open -= usize::from(*sum < FREE_FORM && *sum + own >= FREE_FORM);
            *sum += own;
        }
        if open == 0 {
            break;
        }
    }
    curvature.into_iter().map(|curvature| curvature >= FREE_FORM).collect()
}

/// Absolute angle defects at the vertices of a block, summed in runs of one patch.
fn curvatures(
    mesh: &Mesh,
    share: &Share,
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
        let own = ((std::f64::consts::TAU - angles).abs() - ROUNDING).max(0.0);
        match runs.last_mut() {
            Some((last, sum)) if *last == patch => *sum += own,
            _ => runs.push((patch, own)),
        }
    }
    runs
}
