//! Parts that moved as a whole: one similarity carries most of the changed marks of each part.

use std::collections::BTreeMap;
use std::sync::Arc;

use kurbo::Shape as _;

use super::cause_sentences::MovedPart;
use super::motion;
use super::whole_motion;
use crate::diff::findings::finding::{Finding, Verdict};
use crate::diff::shapes::picture::{Picture, Shape, ShapeKind};
use crate::diff::tolerances;

/// Least share of a part's unequal marks that the motion must carry.
const MIN_CARRIED_SHARE: f64 = 0.5;
/// A part with at least this share in its old place did not move.
const MIN_STAYED_SHARE: f64 = 0.9;
/// Largest residual of a shift as a share of its length. Parts that come closer to the camera grow a little.
const SHIFT_RESIDUAL_SHARE: f64 = 0.1;
/// Least value of that residual in px.
const MIN_RESIDUAL_PX: f64 = 0.06;
/// Greatest value of that residual in px.
const MAX_RESIDUAL_PX: f64 = 1.0;
/// Most parts examined.
const MAX_PARTS: usize = 200;

/// Parts with more than one changed mark, and their motions.
pub(crate) fn find_moved_parts(
    pictures: [&Picture; 2],
    rest: &[Vec<usize>; 2],
    findings: &[Finding],
) -> Vec<MovedPart> {
    let mut counts: BTreeMap<&Arc<str>, usize> = BTreeMap::new();
    for finding in findings {
        let elsewhere =
            !matches!(finding.verdict, Verdict::Restyled | Verdict::Relabelled | Verdict::Restacked);
        if let Some(part) = finding.label.part.as_ref().filter(|_| elsewhere) {
            *counts.entry(part).or_default() += 1;
        }
    }
    let parts = counts.into_iter().filter(|(_, count)| *count > 1).take(MAX_PARTS);
    parts.filter_map(|(part, _)| mover(pictures, rest, part)).collect()
}

/// The motion of one part; `None` if it did not move as a whole.
fn mover(pictures: [&Picture; 2], rest: &[Vec<usize>; 2], part: &Arc<str>) -> Option<MovedPart> {
    let is_own = |shape: &&Shape| shape.kind != ShapeKind::Clip && shape.label.part.as_ref() == Some(part);
    let shapes = [0, 1].map(|side: usize| -> Vec<&Shape> {
        rest[side].iter().filter_map(|index| pictures[side].shapes.get(*index)).filter(is_own).collect()
    });
    // A part whose marks mostly stayed did not move.
    for side in 0..2 {
        let all: Vec<&Shape> = pictures[side].shapes.iter().filter(is_own).collect();
        let of = |shape: &&Shape| shape.path.perimeter(tolerances::MAX_COMPARED_LENGTH_ERROR_PX);
        let length = |shapes: &[&Shape]| shapes.iter().map(of).sum::<f64>();
        let few = shapes[side].len() * 2 < all.len() || shapes[side].is_empty();
        // If the longer lines stayed, only a detail such as a hole or a boss moved.
        if few || length(&shapes[side]) * 2.0 < length(&all) {
            return None;
        }
    }
    let marks = whole_motion::marks([&shapes[0], &shapes[1]], 0.02);
    let places = marks.boxes();
    let between = kurbo::Affine::translate(places[1].center() - places[0].center());
    let way = (places[1].center() - places[0].center()).hypot();
    let reach = (SHIFT_RESIDUAL_SHARE * way).clamp(MIN_RESIDUAL_PX, MAX_RESIDUAL_PX);
    let shift = motion::find(&marks, &[between], reach, false);
    let found = match shift {
        Some(shift) if shift.share >= MIN_CARRIED_SHARE => shift,
        _ => motion::find(&marks, &[between], reach, true)?,
    };
    // Lines that are only cut differently by a moving occluder did not move, although a motion along
    // themselves fits as well.
    let stays = motion::static_share(&marks, reach);
    if stays >= MIN_STAYED_SHARE || found.share <= stays {
        return None;
    }
    let ways = found.corner_displacements(places[0]);
    let goes = ways.iter().any(|way| way.hypot() > MIN_RESIDUAL_PX);
    (goes && found.share >= MIN_CARRIED_SHARE).then(|| MovedPart {
        part: Arc::clone(part),
        motion: found,
        places,
    })
}
