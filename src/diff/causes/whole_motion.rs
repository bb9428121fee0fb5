//! Motion of the whole drawing: the page grew, or all marks were shifted or rotated.

use std::sync::Arc;

use kurbo::{Affine, BezPath, PathEl, Point, Vec2};
use rustc_hash::{FxHashMap, FxHashSet};

use super::motion::{self, Motion, MotionInput};
use crate::diff::curves::chain::flatten;
use crate::diff::curves::region_area::size;
use crate::diff::findings::finding::{Finding, FindingBox, FindingBoxKey, Verdict};
use crate::diff::shapes::label::Label;
use crate::diff::shapes::picture::{Picture, Shape, ShapeKind};
use crate::diff::tolerances;

/// Fewest marks for a motion of the whole drawing.
const MIN_MARKS: usize = 3;
/// Least share of marks without an equal.
const MIN_CHANGED_SHARE: f64 = 0.6;
/// Least share of these marks that the motion must carry.
const MIN_CARRIED_SHARE: f64 = 0.7;

/// A motion of the whole drawing. Shapes with equals stay.
pub(crate) struct WholeMotion {
    pub motion: Motion,
    /// The old drawing after the motion: with unchanged line widths, and with scaled ones.
    pub carried: [Picture; 2],
    /// Residuals above this, in px, are reported.
    pub reach: f64,
}

/// Motion that carries the shapes without an equal, if most shapes have none.
pub(crate) fn whole(
    pictures: [&Picture; 2],
    unequal_shapes: &[Vec<usize>; 2],
    tolerance: f64,
) -> Option<WholeMotion> {
    let shape_count = |side: usize| pictures[side].shapes.len();
    let has_many_changes = |side: usize| {
        unequal_shapes[side].len() >= MIN_MARKS
            && unequal_shapes[side].len() as f64 >= MIN_CHANGED_SHARE * (shape_count(side) as f64 - 1.0)
    };
    if !(has_many_changes(0) && has_many_changes(1)) {
        return None;
    }
    let [before, after] = pictures;
    let changed_shapes = [0, 1].map(|side: usize| -> Vec<&Shape> {
        let unequal_on_side =
            unequal_shapes[side].iter().filter_map(|index| pictures[side].shapes.get(*index));
        // The paper has the size of the page, independent of the marks.
        unequal_on_side
            .filter(|shape| shape.kind != ShapeKind::Clip && shape.label.layer.as_ref() != "paper")
            .collect()
    });
    let marks = marks([&changed_shapes[0], &changed_shapes[1]], tolerance);
    let page_size = after.width.max(after.height);
    let page_growth = page_size / before.width.max(before.height);
    let boxes = marks.boxes();
    let box_growth = boxes[1].width().max(boxes[1].height()) / boxes[0].width().max(boxes[0].height());
    let box_motion = Affine::translate(boxes[1].center().to_vec2())
        * Affine::scale(box_growth)
        * Affine::translate(-boxes[0].center().to_vec2());
    let reach = tolerance * 2.0;
    let fits = [reach, reach.max(tolerances::MAX_REDRAW_OFFSET_OF_PAGE * page_size)].into_iter();
    let (motion, used_tolerance) = fits
        .filter_map(|reach| {
            let found = motion::find(&marks, &[Affine::scale(page_growth), box_motion], reach, true)?;
            (found.share >= MIN_CARRIED_SHARE).then_some((found, reach))
        })
        .next()?;
    let corner_shifts = motion.corner_displacements(boxes[0]);
    if corner_shifts.iter().all(|displacement| displacement.hypot() <= 2.0 * used_tolerance) {
        return None;
    }
    let carried = [1.0, motion.scale()]
        .map(|width_factor| carried(before, &unequal_shapes[0], &motion, width_factor, after));
    Some(WholeMotion { motion, carried, reach: used_tolerance * motion.scale().max(1.0) })
}

/// Common shift of all findings, if every one is a shift by the same amount and they make up most of the
/// drawing.
pub(crate) fn common_shift(
    findings: &mut [Finding],
    before: &Picture,
    unequal_indices: &[usize],
    tolerance: f64,
) -> Option<Motion> {
    if (unequal_indices.len() as f64) < MIN_CHANGED_SHARE * (before.shapes.len() as f64 - 1.0) {
        return None;
    }
    let shifts: Option<Vec<Vec2>> = findings
        .iter()
        .map(|f| {
            f.shift
                .filter(|_| f.verdict == Verdict::Moved && f.changes.is_empty())
                .map(|[x, y]| Vec2::new(x, y))
        })
        .collect();
    let shifts =
        shifts.filter(|shifts| shifts.len() >= MIN_MARKS && shifts.len() * 2 >= unequal_indices.len())?;
    let parts = findings.iter().map(|f| &f.label.part).collect::<FxHashSet<_>>().len();
    let mean = shifts.iter().fold(Vec2::ZERO, |sum, shift| sum + *shift) / shifts.len() as f64;
    let is_uniform =
        shifts.iter().all(|shift| (*shift - mean).hypot() <= 2.0 * tolerance + 0.02 * mean.hypot());
    if !is_uniform || parts < 2 {
        return None;
    }
    findings.iter_mut().for_each(|finding| finding.follows_motion = true);
    Some(Motion { affine: Affine::translate(mean), share: 1.0 })
}

/// Input for fitting motions to these shapes.
pub(crate) fn marks<'a>(shapes: [&[&'a Shape]; 2], tolerance: f64) -> MotionInput<'a> {
    let lines = shapes.map(|shapes| {
        let polylines =
            shapes.iter().flat_map(|shape| flatten(&shape.path, tolerance, shape.kind != ShapeKind::Line));
        polylines.map(|(points, _)| points).collect()
    });
    // Corresponding paths have the same label and kind and the same number of elements, in file order.
    type Key<'k> = (ShapeKind, &'k Label, usize);
    let key = |shape: &&'a Shape| -> Key<'a> { (shape.kind, &*shape.label, shape.path.elements().len()) };
    let mut waiting: FxHashMap<Key, Vec<&'a BezPath>> = FxHashMap::default();
    for shape in shapes[1].iter().rev() {
        waiting.entry(key(shape)).or_default().push(&shape.path);
    }
    let take_equal_path = |shape: &&'a Shape| Some([&shape.path, waiting.get_mut(&key(shape))?.pop()?]);
    let mut equal_paths: Vec<[&BezPath; 2]> = shapes[0].iter().filter_map(take_equal_path).collect();
    // Long paths first, because they determine a motion better.
    equal_paths.sort_by_key(|[old, _]| std::cmp::Reverse(old.elements().len()));
    MotionInput { path_pairs: equal_paths, lines }
}

/// A picture whose unequal shapes are moved, with line widths scaled by `width_factor`.
fn carried(
    picture: &Picture,
    unequal_indices: &[usize],
    motion: &Motion,
    width_factor: f64,
    after: &Picture,
) -> Picture {
    let mut shapes = picture.shapes.to_vec();
    for index in unequal_indices {
        let Some(shape) = shapes.get_mut(*index) else { continue };
        shape.path = motion.affine * &shape.path;
        shape.outline = shape.outline.as_ref().map(|outline| motion.affine * outline);
        shape.ink.width *= width_factor;
        shape.ink.dash.iter_mut().for_each(|length| *length *= width_factor);
    }
    Picture {
        width: after.width,
        height: after.height,
        step_px: picture.step_px * motion.scale().max(1.0),
        shapes: Arc::from(shapes),
        ..picture.clone()
    }
}

/// A finding for each carried shape that was not removed.
pub(crate) fn findings(
    before: &Picture,
    unequal_indices: &[usize],
    motion: &Motion,
    remaining_findings: &[Finding],
) -> Vec<Finding> {
    let is_translation = (motion.scale() - 1.0).abs() < tolerances::MAX_SHIFT_GROWTH_SHARE
        && motion.turn().abs() < tolerances::MAX_SHIFT_TURN_DEG;
    let removed_boxes: FxHashSet<(FindingBoxKey, &Label)> = remaining_findings
        .iter()
        .filter(|f| f.verdict == Verdict::Removed)
        .map(|f| (f.place.key(), &f.label))
        .collect();
    let mut motion_findings = Vec::new();
    for shape in unequal_indices.iter().filter_map(|index| before.shapes.get(*index)) {
        let moved_path = motion.affine * &shape.path;
        let moved_box = moved_path.control_box().union(shape.path.control_box());
        let key = FindingBox::of(moved_path.control_box()).key();
        if shape.kind == ShapeKind::Clip || removed_boxes.contains(&(key, &*shape.label)) {
            continue;
        }
        let mut distances: Vec<f64> =
            ends(&shape.path).into_iter().map(|p| motion.displacement(p).hypot()).collect();
        distances.sort_by(f64::total_cmp);
        let largest = distances.last().copied().unwrap_or_default();
        let displacement_of_centre = motion.displacement(shape.path.control_box().center());
        motion_findings.push(Finding {
            size: size(shape),
            largest,
            p95: distances
                .get((distances.len() * 95 / 100).min(distances.len().saturating_sub(1)))
                .copied()
                .unwrap_or(largest),
            shift: is_translation.then_some([displacement_of_centre.x, displacement_of_centre.y]),
            removed_path: shape.path.clone(),
            follows_motion: true,
            added_path: moved_path,
            ..Finding::of_shape(Verdict::Moved, shape, Vec::new(), moved_box)
        });
    }
    motion_findings
}

/// All points of a path except control points.
fn ends(path: &BezPath) -> Vec<Point> {
    let end_point = |element: &PathEl| match *element {
        PathEl::MoveTo(p) | PathEl::LineTo(p) | PathEl::QuadTo(_, p) | PathEl::CurveTo(_, _, p) => Some(p),
        PathEl::ClosePath => None,
    };
    path.elements().iter().filter_map(end_point).collect()
}
