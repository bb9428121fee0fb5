//! Thin folds: contours of folds that are thinner than a pen stroke, in the image and in space.
//!
//! A face much longer than wide that turns from the eye gives one contour out to its tip and one back, and
//! the surface continues on both sides. Only the nearer of the two is visible, and it looks like a splinter.
//! Where both lie within one pen stroke and no line continues from them, neither shows anything useful.

use glam::{DVec2, DVec3};

use crate::lines::{FeatureLines, LineKind, NO_FACE, Role};
use crate::mesh::{FaceId, Mesh};
use crate::view::View;
use crate::visibility::projection::image_segments::ImageSegment;
use crate::visibility::tolerances;

/// Smallest ratio of length to width of a thin fold.
const MIN_ASPECT: f64 = 3.0;

/// Smallest cosine (26 degrees) between a fold and a line that continues it.
const MIN_CONTINUATION_COSINE: f64 = 0.9;

/// Two sides of a fold and the vertex where they meet.
struct ThinFold {
    /// Image segments of the sides.
    sides: [u32; 2],
    tip: u32,
    /// Other end of each side.
    feet: [u32; 2],
    /// Vector from the tip to the feet, in the image.
    along: DVec2,
}

/// Finds the feature segments that are sides of thin folds, ascending.
pub(crate) fn find_thin_folds(
    mesh: &Mesh,
    view: &View,
    lines: &FeatureLines,
    segments: &[ImageSegment],
) -> Vec<u32> {
    let shortest = MIN_ASPECT * tolerances::THIN_FOLD_PX * view.frame.px();
    let is_side = |s: &ImageSegment| {
        lines.segments[s.source as usize].kind == LineKind::Contour
            && s.role == Role::Line
            && s.cut == [false; 2]
            && !s.hosts.contains(&NO_FACE)
            && s.length() >= shortest
    };
    let mut ends: Vec<(u32, u32)> = Vec::new();
    for (id, segment) in segments.iter().enumerate().filter(|(_, s)| is_side(s)) {
        ends.extend(segment.ends.map(|end| (end, id as u32)));
    }
    ends.sort_unstable();
    let pairs = ends.chunk_by(|a, b| a.0 == b.0).filter(|ends| ends.len() == 2);
    let of_pair =
        |ends: &[(u32, u32)]| thin_fold(mesh, view, lines, segments, [ends[0].1, ends[1].1], ends[0].0);
    let folds: Vec<ThinFold> = pairs.filter_map(of_pair).collect();
    let goes_on = continued(&folds, lines, segments);
    let isolated_folds = folds.iter().zip(goes_on).filter(|(_, goes_on)| !goes_on);
    let sides = isolated_folds.flat_map(|(needle, _)| needle.sides.map(|id| segments[id as usize].source));
    let mut found: Vec<u32> = sides.filter(|source| lines.segments[*source as usize].smooth).collect();
    found.sort_unstable();
    found.dedup();
    found
}

/// Whether a line continues from each fold: another line ends at its tip, or a contour leaves one of its feet
/// towards the tip.
///
/// In the second case the three contours are one line that doubles back.
fn continued(folds: &[ThinFold], lines: &FeatureLines, segments: &[ImageSegment]) -> Vec<bool> {
    let mut goes_on = vec![false; folds.len()];
    let mut fold_vertices: Vec<(u32, u32)> = Vec::new();
    for (current_fold, id) in folds.iter().zip(0..) {
        fold_vertices.extend(
            [current_fold.tip, current_fold.feet[0], current_fold.feet[1]].map(|vertex| (vertex, id)),
        );
    }
    fold_vertices.sort_unstable();
    if fold_vertices.is_empty() {
        return goes_on;
    }
    for (segment, id) in segments.iter().zip(0..) {
        for (k, end) in segment.ends.iter().enumerate() {
            let first = fold_vertices.partition_point(|(vertex, _)| vertex < end);
            for (_, of) in fold_vertices[first..].iter().take_while(|(vertex, _)| vertex == end) {
                let matched_fold = &folds[*of as usize];
                if matched_fold.sides.contains(&id) {
                    continue;
                }
                let ends = [segment.a, segment.b].map(DVec3::truncate);
                let (side_direction, tip_direction) = (ends[1 - k] - ends[k], -matched_fold.along);
                let is_contour = lines.segments[segment.source as usize].kind == LineKind::Contour;
                // A shorter line is the base of the fold.
                let same_way = MIN_ASPECT * side_direction.length() > tip_direction.length()
                    && side_direction.dot(tip_direction)
                        > MIN_CONTINUATION_COSINE * side_direction.length() * tip_direction.length();
                goes_on[*of as usize] |= *end == matched_fold.tip || (is_contour && same_way);
            }
        }
    }
    goes_on
}

/// Thin fold of two contours that end in one vertex, if they are the sides of a fold within one pen stroke.
fn thin_fold(
    mesh: &Mesh,
    view: &View,
    lines: &FeatureLines,
    segments: &[ImageSegment],
    sides: [u32; 2],
    tip: u32,
) -> Option<ThinFold> {
    let (frame, px) = (&view.frame, view.frame.px());
    let pair = sides.map(|id| &segments[id as usize]);
    let foot_end = pair.map(|s| usize::from(s.ends[0] == tip));
    let along = [0, 1].map(|k| {
        let ends = [pair[k].a, pair[k].b].map(DVec3::truncate);
        ends[foot_end[k]] - ends[1 - foot_end[k]]
    });
    let lengths = along.map(DVec2::length);
    let across = along[0].perp_dot(along[1]).abs();
    if along[0].dot(along[1]) <= 0.0 || across > tolerances::THIN_FOLD_PX * px * lengths[0].max(lengths[1]) {
        return None;
    }
    let feet = [0, 1].map(|k| pair[k].ends[foot_end[k]]);
    let [p, q] = feet.map(|foot| lines.position(mesh, foot));
    let base = p.distance(q) / frame.px_at(frame.depth(p).min(frame.depth(q))) * px;
    let is_slender =
        base <= tolerances::THIN_FOLD_BASE_PX * px && MIN_ASPECT * base <= lengths[0].min(lengths[1]);
    // A spike has two ridges as sides, and no back.
    let folds = || is_ridge(mesh, lines, pair[0]) != is_ridge(mesh, lines, pair[1]);
    (is_slender && folds()).then_some(ThinFold { sides, tip, feet, along: along[0] })
}

/// Whether the second face at an edge falls away behind the outer side of the first.
fn is_ridge(mesh: &Mesh, lines: &FeatureLines, segment: &ImageSegment) -> bool {
    let [first, second] = segment.hosts;
    let apex = mesh.apex(second, segment.ends).unwrap_or(mesh.triangles[first as usize][0]);
    let offset = mesh.positions[apex as usize] - lines.position(mesh, segment.ends[0]);
    mesh.area_vector(FaceId(first)).dot(offset) < 0.0
}
