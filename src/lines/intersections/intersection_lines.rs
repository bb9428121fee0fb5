//! Feature lines where surfaces pass through each other.
//!
//! All intersections of a large mesh take long to find, and most are out of sight. Where only
//! visible lines are drawn and it is known which faces surely are out of sight, the others alone are
//! searched. Else small meshes, and drawings with hidden lines, get the full search, which no view changes; in
//! large ones a buffer of the faces in sight proposes those that may meet others, and
//! from the pairs found among them the curves are followed over the mesh, so that every visible
//! curve is whole, its hidden parts included.

use crate::parallel::prelude::*;

use super::facet_contacts;
use crate::lines::prepared_surface::Finer;
use crate::lines::{FeatureLines, FeatureSegment, HiddenLines, LineKind, Role};
use crate::mesh::intersect::curve_tracer::Tracer;
use crate::mesh::intersect::intersection_cache::{Hosts, PairSearch};
use crate::mesh::intersect::intersection_curves::{
    IntersectionCurves, IntersectionInput, IntersectionSegment, intersections_of_parts,
};
use crate::mesh::intersect::triangle_pair::PairTolerance;
use crate::mesh::{FaceId, Mesh, PartId};
use crate::parallel::task_size::GRAIN;
use crate::surface::Origin;
use crate::view::View;
use crate::view::raster::{FaceBuffer, Screen, intersecting_candidates};

/// Meshes with at most this many triangles are searched in full, which takes no longer.
pub const FULL_SEARCH_TRIANGLES: usize = 300_000;

/// The intersection curves of all faces that have area; without hidden lines, at least those that show in the view.
#[must_use]
pub fn find(mesh: &Mesh, view: &View, hidden: HiddenLines) -> IntersectionCurves {
    if is_searched_in_full(mesh, hidden) { all_curves(mesh) } else { visible_curves(mesh, view) }
}

/// Whether [`all_curves`] are sought, and not those that show in a view.
#[must_use]
pub fn is_searched_in_full(mesh: &Mesh, hidden: HiddenLines) -> bool {
    hidden != HiddenLines::None || mesh.triangles.len() <= FULL_SEARCH_TRIANGLES
}

/// Adds curves of a mesh to the lines of a view: their segments run the same way and come in the same order for any order of
/// parts in the file.
pub(crate) fn add(curves: &IntersectionCurves, mesh: &Mesh, view: &View, lines: &mut FeatureLines) {
    let first = (mesh.positions.len() + lines.points.len()) as u32;
    lines.points.extend_from_slice(&curves.points);
    let ranks = mesh.extents.ranks();
    let rank = |face: u32| ranks[mesh.face_part[face as usize].index()];
    let mut segments: Vec<IntersectionSegment> = curves.segments.clone();
    segments.par_iter_mut().with_min_len(GRAIN).for_each(|segment| {
        let [a, b] = segment.faces;
        if (rank(b), b) < (rank(a), a) {
            segment.faces.reverse();
            segment.ends.reverse();
        }
    });
    segments.par_sort_unstable_by_key(|segment| (segment.faces.map(rank), segment.faces));
    lines.segments.extend(segments.iter().map(|s| {
        let owner = owner(view, s.faces) as usize;
        FeatureSegment {
            ends: s.ends.map(|end| first + end),
            hosts: s.faces,
            kind: LineKind::Intersection,
            both_seen: true,
            smooth: false,
            origin: Origin::default(),
            role: Role::Line,
            strength: 180.0,
            part: mesh.face_part[owner],
            material: mesh.face_material[owner],
        }
    }));
}

/// The face that a line belongs to, of two faces that pass through each other, that of the smaller part first: the one that turns its
/// outside to the eye; if both do, the first, which sticks in the other.
fn owner(view: &View, [a, b]: [u32; 2]) -> u32 {
    if view.facing[b as usize] && !view.facing[a as usize] { b } else { a }
}

/// All curves of a mesh.
#[must_use]
pub fn all_curves(mesh: &Mesh) -> IntersectionCurves {
    let active = active(mesh);
    let tolerance = |face| PairTolerance::of_part(mesh.extent(FaceId(face)));
    facet_contacts::without(
        intersections_of_parts(&input(mesh, &active, &mesh.face_bodies()), tolerance),
        mesh,
    )
}

/// The curves of a mesh between faces that are not `out_of_sight`: of [`all_curves`] every segment of which something shows.
#[must_use]
pub fn curves_in_sight(mesh: &Mesh, mut out_of_sight: Vec<bool>) -> IntersectionCurves {
    out_of_sight.par_iter_mut().enumerate().with_min_len(GRAIN).for_each(|(face, out)| {
        *out = !*out && !mesh.is_degenerate(FaceId(face as u32));
    });
    let active = out_of_sight;
    let tolerance = |face| PairTolerance::of_part(mesh.extent(FaceId(face)));
    facet_contacts::without(
        intersections_of_parts(&input(mesh, &active, &mesh.face_bodies()), tolerance),
        mesh,
    )
}

/// All curves of a mesh, so that those of finer meshes made of it are found sooner: [`curves_of_finer`].
#[must_use]
pub fn search(mesh: &Mesh) -> PairSearch {
    let active = active(mesh);
    PairSearch::new(&input(mesh, &active, &mesh.face_bodies()), |face| {
        PairTolerance::of_part(mesh.extent(FaceId(face)))
    })
}

/// All curves of a surface some of whose faces were cut, with the help of a [`search`] of the mesh it was made of:
/// those that [`all_curves`] finds.
#[must_use]
pub fn curves_of_finer(search: &PairSearch, finer: &Finer) -> IntersectionCurves {
    let mesh = &finer.surface.mesh;
    let active = active(mesh);
    let hosts = Hosts { faces: &finer.hosts, kept: finer.kept };
    let tolerance = |face| PairTolerance::of_part(mesh.extent(FaceId(face)));
    facet_contacts::without(
        search.curves_of_finer(&input(mesh, &active, &mesh.face_bodies()), hosts, tolerance),
        mesh,
    )
}

/// Which faces have area; empty if all have.
fn active(mesh: &Mesh) -> Vec<bool> {
    if mesh.cleaning.degenerate == 0 {
        return Vec::new();
    }
    (0..mesh.triangles.len()).map(|f| !mesh.is_degenerate(FaceId::from(f))).collect()
}

fn input<'a>(mesh: &'a Mesh, active: &'a [bool], bodies: &'a [PartId]) -> IntersectionInput<'a> {
    IntersectionInput { positions: &mesh.positions, triangles: &mesh.triangles, active, bodies }
}

/// The curves of which something shows in a view, whole, and perhaps others.
#[must_use]
pub fn visible_curves(mesh: &Mesh, view: &View) -> IntersectionCurves {
    let buffer = FaceBuffer::new(&Screen::new(mesh, view));
    let active = intersecting_candidates::find(mesh, &buffer);
    let tracer = Tracer::new(mesh);
    facet_contacts::without(tracer.curves(&tracer.pairs_among(&active)), mesh)
}
