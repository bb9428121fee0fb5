//! Intersection lines: feature lines where surfaces pass through each other.
//!
//! A full search of a large mesh is slow, and most intersections are hidden. There are three ways:
//!
//! 1. If only visible lines are drawn and some faces are known to be hidden, the other faces are searched.
//! 2. Small meshes, and drawings with hidden lines, get the full search, which does not depend on the view.
//! 3. In large meshes a buffer of visible faces proposes candidates. From the pairs among them the curves are
//!    followed over the mesh, so that every visible curve is complete, including its hidden parts.

use crate::parallel::prelude::*;

use super::facet_contacts;
use crate::lines::prepared_surface::RefinedSurface;
use crate::lines::{FeatureLines, FeatureSegment, HiddenLines, LineKind};
use crate::mesh::intersect::cache::intersection_cache::{FaceHosts, IntersectionCache};
use crate::mesh::intersect::curve_tracer::CurveTracer;
use crate::mesh::intersect::intersection_curves::{
    IntersectionCurves, IntersectionInput, IntersectionSegment, intersections_of_parts,
};
use crate::mesh::intersect::triangle_pair::PairTolerance;
use crate::mesh::{FaceId, Mesh, PartId};
use crate::parallel::task_size::MIN_TASK_ITEMS;
use crate::view::View;
use crate::view::raster::{FaceBuffer, PixelGrid, intersecting_candidates};

/// Maximum number of triangles for the full search, which is fast enough for these.
pub(crate) const MAX_FULL_SEARCH_TRIANGLES: usize = 300_000;

/// Intersection curves of all faces with area; without hidden lines, at least those visible in the view.
#[must_use]
pub(crate) fn find(mesh: &Mesh, view: &View, hidden: HiddenLines) -> IntersectionCurves {
    if is_searched_in_full(mesh, hidden) { all_curves(mesh) } else { visible_curves(mesh, view) }
}

/// Whether [`all_curves`] is used, and not only the curves visible in a view.
#[must_use]
pub(crate) fn is_searched_in_full(mesh: &Mesh, hidden: HiddenLines) -> bool {
    hidden != HiddenLines::None || mesh.triangles.len() <= MAX_FULL_SEARCH_TRIANGLES
}

/// Adds curves to the lines of a view. The direction and order of their segments do not depend on the order
/// of parts.
pub(crate) fn add(curves: &IntersectionCurves, mesh: &Mesh, view: &View, lines: &mut FeatureLines) {
    let first = (mesh.positions.len() + lines.points.len()) as u32;
    lines.points.extend_from_slice(&curves.points);
    let ranks = mesh.extents.ranks();
    let rank = |face: u32| ranks[mesh.face_part[face as usize].index()];
    let mut segments: Vec<IntersectionSegment> = curves.segments.clone();
    segments.par_iter_mut().with_min_len(MIN_TASK_ITEMS).for_each(|segment| {
        let [a, b] = segment.faces;
        if (rank(b), b) < (rank(a), a) {
            segment.faces.reverse();
            segment.ends.reverse();
        }
    });
    segments.par_sort_unstable_by_key(|segment| (segment.faces.map(rank), segment.faces));
    lines.segments.extend(segments.iter().map(|s| {
        let ends = s.ends.map(|end| first + end);
        FeatureSegment::on_face(mesh, owner(view, s.faces), s.faces, LineKind::Intersection, ends)
    }));
}

/// Face that the line belongs to, given the face of the smaller part first: the one with its outside to the
/// camera, or the first if both have.
fn owner(view: &View, [a, b]: [u32; 2]) -> u32 {
    if view.facing[b as usize] && !view.facing[a as usize] { b } else { a }
}

/// All intersection curves of a mesh.
#[must_use]
pub(crate) fn all_curves(mesh: &Mesh) -> IntersectionCurves {
    curves_among(mesh, &active(mesh))
}

/// Intersection curves between faces that are not `out_of_sight`: every visible segment of [`all_curves`].
#[must_use]
pub(crate) fn curves_in_sight(mesh: &Mesh, mut out_of_sight: Vec<bool>) -> IntersectionCurves {
    out_of_sight.par_iter_mut().enumerate().with_min_len(MIN_TASK_ITEMS).for_each(|(face, out)| {
        *out = !*out && !mesh.is_degenerate(FaceId(face as u32));
    });
    curves_among(mesh, &out_of_sight)
}

/// Intersection curves between active faces.
fn curves_among(mesh: &Mesh, active: &[bool]) -> IntersectionCurves {
    let curves = intersections_of_parts(&input(mesh, active, &mesh.face_bodies()), tolerance(mesh));
    facet_contacts::remove_contacts(curves, mesh)
}

/// Tolerance of each face in the search of intersections.
fn tolerance(mesh: &Mesh) -> impl Fn(u32) -> PairTolerance + Sync + '_ {
    |face| PairTolerance::of_part(mesh.extent(FaceId(face)))
}

/// Search of all curves of a mesh, to be reused for refined meshes in [`curves_of_finer`].
#[must_use]
pub(crate) fn search(mesh: &Mesh) -> IntersectionCache {
    let active = active(mesh);
    IntersectionCache::new(&input(mesh, &active, &mesh.face_bodies()), tolerance(mesh))
}

/// All curves of a refined surface, from a [`search`] of the original mesh. The result is that of
/// [`all_curves`].
#[must_use]
pub(crate) fn curves_of_finer(search: &IntersectionCache, finer: &RefinedSurface) -> IntersectionCurves {
    let mesh = &finer.surface.mesh;
    let active = active(mesh);
    let hosts = FaceHosts { faces: &finer.hosts, kept_count: finer.kept_count };
    let bodies = mesh.face_bodies();
    let input = input(mesh, &active, &bodies);
    facet_contacts::remove_contacts(search.refined_curves(&input, hosts, tolerance(mesh)), mesh)
}

/// Whether each face has area; empty if all have.
fn active(mesh: &Mesh) -> Vec<bool> {
    if mesh.cleaning.degenerate == 0 {
        return Vec::new();
    }
    (0..mesh.triangles.len()).map(|f| !mesh.is_degenerate(FaceId::from(f))).collect()
}

fn input<'a>(mesh: &'a Mesh, active: &'a [bool], bodies: &'a [PartId]) -> IntersectionInput<'a> {
    IntersectionInput { positions: &mesh.positions, triangles: &mesh.triangles, active, bodies }
}

/// All curves with a visible part, complete, and possibly others.
#[must_use]
pub(crate) fn visible_curves(mesh: &Mesh, view: &View) -> IntersectionCurves {
    let buffer = FaceBuffer::new(&PixelGrid::new(mesh, view));
    let active = intersecting_candidates::find(mesh, &buffer);
    let tracer = CurveTracer::new(mesh);
    facet_contacts::remove_contacts(tracer.curves(&tracer.pairs_among(&active)), mesh)
}
