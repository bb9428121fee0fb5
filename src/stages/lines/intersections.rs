//! Feature lines where surfaces pass through each other.
//!
//! All intersections of a large mesh take long to find, and most are out of sight. Where only
//! visible lines are drawn, a buffer of the faces in sight proposes those that may meet others;
//! from the pairs found among them the curves are followed over the mesh, so that every visible
//! curve is whole, its hidden parts included. Small meshes, and drawings with hidden
//! lines, get the full search, which no view changes.

use super::{FeatureLines, FeatureSegment, HiddenLines, LineKind, Role};
use crate::mesh::{FaceId, Mesh};
use crate::raster::{FaceBuffer, Screen, strangers};
use crate::shape::Origin;
use crate::trees::intersect::{IntersectionCurves, IntersectionInput, intersections_of_parts};
use crate::trees::trace::Tracer;
use crate::view::View;

/// Meshes with at most this many triangles are searched in full, which takes no longer.
pub const FULL_SEARCH_TRIANGLES: usize = 300_000;

/// Adds the intersection curves of all faces that have area; without hidden lines, at least those
/// that show in the view.
pub fn find(mesh: &Mesh, view: &View, hidden: HiddenLines, lines: &mut FeatureLines) {
    let curves =
        if is_searched_in_full(mesh, hidden) { all_curves(mesh) } else { visible_curves(mesh, view) };
    add(&curves, mesh, view, lines);
}

/// Whether [`all_curves`] are sought, and not those that show in a view.
#[must_use]
pub fn is_searched_in_full(mesh: &Mesh, hidden: HiddenLines) -> bool {
    hidden != HiddenLines::None || mesh.triangles.len() <= FULL_SEARCH_TRIANGLES
}

/// Adds curves of a mesh to the lines of a view.
pub(super) fn add(curves: &IntersectionCurves, mesh: &Mesh, view: &View, lines: &mut FeatureLines) {
    let first = (mesh.positions.len() + lines.points.len()) as u32;
    lines.points.extend_from_slice(&curves.points);
    lines.segments.extend(curves.segments.iter().map(|s| {
        let owner = owner(mesh, view, s.faces) as usize;
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

/// Of two faces that pass through each other the one to which the line belongs: the one that turns its
/// outside to the eye, of two such that of the smaller part, which is what sticks in the other. The order of
/// parts in the file does not matter.
fn owner(mesh: &Mesh, view: &View, [a, b]: [u32; 2]) -> u32 {
    let sides = [a, b].map(|face| view.facing[face as usize]);
    if sides[0] != sides[1] {
        return if sides[0] { a } else { b };
    }
    let [of_a, of_b] = [a, b].map(|face| mesh.extent(FaceId(face)));
    let corners = |face: u32| {
        let mut corners = mesh.triangles[face as usize];
        corners.sort_unstable();
        corners
    };
    // Of two parts in one place the place of the face decides: vertices are numbered by theirs.
    if of_a.precedence(of_b).then_with(|| corners(a).cmp(&corners(b))).is_le() { a } else { b }
}

/// All curves of a mesh.
#[must_use]
pub fn all_curves(mesh: &Mesh) -> IntersectionCurves {
    let active: Vec<bool> = if mesh.cleaning.degenerate == 0 {
        Vec::new()
    } else {
        (0..mesh.triangles.len()).map(|f| !mesh.is_degenerate(FaceId::from(f))).collect()
    };
    let input = IntersectionInput { positions: &mesh.positions, triangles: &mesh.triangles, active: &active };
    intersections_of_parts(&input, |face| mesh.extent(FaceId(face)).scale)
}

/// The curves of which something shows in a view, whole, and perhaps others.
#[must_use]
pub fn visible_curves(mesh: &Mesh, view: &View) -> IntersectionCurves {
    let buffer = FaceBuffer::new(&Screen::new(mesh, view));
    let active = strangers::find(mesh, &buffer);
    let tracer = Tracer::new(mesh);
    tracer.curves(&tracer.pairs_among(&active))
}
