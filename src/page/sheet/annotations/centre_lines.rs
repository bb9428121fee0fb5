//! [`centre_lines`]: axes of cylinders, as lines where they are seen from the side and as crosses where they
//! are seen end-on.
//!
//! Source: ISO 128-2, line type 04.1.

use kurbo::{Point, Vec2};

use crate::geometry::plane::polyline_path::polyline;
use crate::page::sheet::arrangement::view_arrangement::ViewPlacement;
use crate::page::sheet::arrangement::view_plan::ViewPlan;
use crate::page::sheet::canvas::annotation_board::AnnotationBoard;
use crate::page::sheet::canvas::paper_occupancy::{ConvexShape, OccupantKind};
use crate::page::sheet::canvas::sheet_canvas::{CHAIN_DASH_MM, THIN_LINE_MM};
use crate::page::sheet::view::sheet_view::SheetView;
use crate::page::tolerances;
use crate::surface::Cylinder;

/// Overshoot of centre lines at both ends, mm.
const OVERSHOOT_MM: f64 = 2.5;

/// Cylinders with a smaller radius on paper get no centre line; shorter lines are drawn solid, mm.
const MIN_RADIUS_MM: f64 = 0.7;
const MIN_DASHED_LENGTH_MM: f64 = 9.0;

/// Lines and crosses closer than this are merged, mm.
const MERGE_DISTANCE_MM: f64 = 0.05;

/// Draws the centre lines of a side view or a section.
pub(crate) fn centre_lines(plan: &ViewPlan, number: usize, found: &[Cylinder], board: &mut AnnotationBoard) {
    let placed = &plan.views[number];
    let section = plan.section_of(number);
    if !matches!(placed.placement, ViewPlacement::Projected(_)) && section.is_none() {
        return;
    }
    let kept: Vec<Cylinder> =
        found.iter().filter_map(|cylinder| plan.remaining_cylinder(cylinder, section)).collect();
    draw_axes(&placed.sight, &kept, board);
}

fn draw_axes(sight: &SheetView, found: &[Cylinder], board: &mut AnnotationBoard) {
    let forward = sight.axes()[2];
    let mut crosses: Vec<(Point, f64)> = Vec::new();
    let mut lines: Vec<[Point; 2]> = Vec::new();
    for cylinder in found {
        let radius = cylinder.radius * sight.mm_per_unit;
        let towards = cylinder.axis.dot(forward).abs();
        if radius < MIN_RADIUS_MM {
            continue;
        }
        if towards > tolerances::MIN_END_ON_COSINE {
            let at = sight.to_page(cylinder.point);
            match crosses
                .iter_mut()
                .find(|(known, _)| (*known - at).hypot2() < MERGE_DISTANCE_MM * MERGE_DISTANCE_MM)
            {
                Some((_, reach)) => *reach = reach.max(radius),
                None => crosses.push((at, radius)),
            }
        } else if towards < tolerances::MAX_SIDE_ON_COSINE {
            let [a, b] = cylinder.ends.map(|end| sight.to_page(cylinder.point + cylinder.axis * end));
            add_or_extend(&mut lines, [a, b]);
        }
    }
    for (at, radius) in crosses {
        for out in [Vec2::new(1.0, 0.0), Vec2::new(0.0, 1.0), Vec2::new(-1.0, 0.0), Vec2::new(0.0, -1.0)] {
            let reach = radius + OVERSHOOT_MM;
            // Long dashes meet in the centre.
            let dash: &[f64] = if 2.0 * reach < MIN_DASHED_LENGTH_MM { &[] } else { &CHAIN_DASH_MM };
            board.ink.dashed(polyline(&[at, at + out * reach]), THIN_LINE_MM, dash, CHAIN_DASH_MM[0] / 2.0);
            board.taken.take(ConvexShape::line(at, at + out * reach, THIN_LINE_MM), OccupantKind::Geometry);
        }
    }
    for [a, b] in lines {
        let along = (b - a) / (b - a).hypot2().sqrt();
        let (a, b) = (a - along * OVERSHOOT_MM, b + along * OVERSHOOT_MM);
        let dash: &[f64] =
            if (b - a).hypot2() < MIN_DASHED_LENGTH_MM * MIN_DASHED_LENGTH_MM { &[] } else { &CHAIN_DASH_MM };
        board.ink.path(polyline(&[a, b]), THIN_LINE_MM, dash);
        board.taken.take(ConvexShape::line(a, b, THIN_LINE_MM), OccupantKind::Geometry);
    }
}

/// Adds a line, or extends a collinear one that it continues.
fn add_or_extend(lines: &mut Vec<[Point; 2]>, new: [Point; 2]) {
    let [mut a, mut b] = new;
    if (b - a).hypot2() < MERGE_DISTANCE_MM * MERGE_DISTANCE_MM {
        return;
    }
    loop {
        let along = (b - a) / (b - a).hypot2().sqrt();
        let aside = |p: Point| (p - a).cross(along).abs();
        let place = |p: Point| (p - a).dot(along);
        let goes_on = |[c, d]: &[Point; 2]| {
            let (low, high) = (place(*c).min(place(*d)), place(*c).max(place(*d)));
            aside(*c) < MERGE_DISTANCE_MM
                && aside(*d) < MERGE_DISTANCE_MM
                && low <= place(b) + 2.0 * OVERSHOOT_MM
                && high >= -2.0 * OVERSHOOT_MM
        };
        let Some(k) = lines.iter().position(goes_on) else { break };
        let [c, d] = lines.swap_remove(k);
        let mut ends = [a, b, c, d];
        ends.sort_by(|p, q| place(*p).total_cmp(&place(*q)));
        (a, b) = (ends[0], ends[3]);
    }
    lines.push([a, b]);
}
