//! [`centre_lines`]: axes of cylinders, as lines where they are seen from the side and as crosses where they
//! are seen end-on.
//!
//! Source: ISO 128-2, line type 04.1.

use kurbo::{Point, Vec2};

use super::Board;
use crate::page::sheet::arrangement::view_arrangement::Stands;
use crate::page::sheet::arrangement::view_plan::Plan;
use crate::page::sheet::canvas::paper_occupancy::{Kind, Shape};
use crate::page::sheet::canvas::sheet_canvas::{CHAIN, NARROW, way};
use crate::page::sheet::view::sheet_view::Sight;
use crate::surface::Cylinder;

/// Overshoot of centre lines at both ends, mm.
const BEYOND: f64 = 2.5;

/// Cylinders with a smaller radius on paper get no centre line; shorter lines are drawn solid, mm.
const SMALLEST: f64 = 0.7;
const UNBROKEN: f64 = 9.0;

/// Lines and crosses closer than this are merged, mm.
const SAME: f64 = 0.05;

/// Draws the centre lines of a side view or a section.
pub(crate) fn centre_lines(plan: &Plan, number: usize, found: &[Cylinder], board: &mut Board) {
    let placed = &plan.views[number];
    let section = plan.cut_of(number);
    if !matches!(placed.stands, Stands::Beside(_)) && section.is_none() {
        return;
    }
    let kept: Vec<Cylinder> = found.iter().filter_map(|cylinder| plan.left_of(cylinder, section)).collect();
    view(&placed.sight, &kept, board);
}

fn view(sight: &Sight, found: &[Cylinder], board: &mut Board) {
    let forward = sight.axes()[2];
    let mut crosses: Vec<(Point, f64)> = Vec::new();
    let mut lines: Vec<[Point; 2]> = Vec::new();
    for cylinder in found {
        let radius = cylinder.radius * sight.unit;
        let towards = cylinder.axis.dot(forward).abs();
        if radius < SMALLEST {
            continue;
        }
        if towards > 1.0 - 1e-6 {
            let at = sight.page(cylinder.point);
            match crosses.iter_mut().find(|(known, _)| (*known - at).hypot2() < SAME * SAME) {
                Some((_, reach)) => *reach = reach.max(radius),
                None => crosses.push((at, radius)),
            }
        } else if towards < 1e-6 {
            let [a, b] = cylinder.ends.map(|end| sight.page(cylinder.point + cylinder.axis * end));
            add(&mut lines, [a, b]);
        }
    }
    for (at, radius) in crosses {
        for out in [Vec2::new(1.0, 0.0), Vec2::new(0.0, 1.0), Vec2::new(-1.0, 0.0), Vec2::new(0.0, -1.0)] {
            let reach = radius + BEYOND;
            // Long dashes meet in the centre.
            let dash: &[f64] = if 2.0 * reach < UNBROKEN { &[] } else { &CHAIN };
            board.ink.dashed(way(&[at, at + out * reach]), NARROW, dash, CHAIN[0] / 2.0);
            board.taken.take(Shape::line(at, at + out * reach, NARROW), Kind::Geometry);
        }
    }
    for [a, b] in lines {
        let along = (b - a) / (b - a).hypot2().sqrt();
        let (a, b) = (a - along * BEYOND, b + along * BEYOND);
        let dash: &[f64] = if (b - a).hypot2() < UNBROKEN * UNBROKEN { &[] } else { &CHAIN };
        board.ink.path(way(&[a, b]), NARROW, dash);
        board.taken.take(Shape::line(a, b, NARROW), Kind::Geometry);
    }
}

/// Adds a line, or extends a collinear one that it continues.
fn add(lines: &mut Vec<[Point; 2]>, new: [Point; 2]) {
    let [mut a, mut b] = new;
    if (b - a).hypot2() < SAME * SAME {
        return;
    }
    loop {
        let along = (b - a) / (b - a).hypot2().sqrt();
        let aside = |p: Point| (p - a).cross(along).abs();
        let place = |p: Point| (p - a).dot(along);
        let goes_on = |[c, d]: &[Point; 2]| {
            let (low, high) = (place(*c).min(place(*d)), place(*c).max(place(*d)));
            aside(*c) < SAME && aside(*d) < SAME && low <= place(b) + 2.0 * BEYOND && high >= -2.0 * BEYOND
        };
        let Some(k) = lines.iter().position(goes_on) else { break };
        let [c, d] = lines.swap_remove(k);
        let mut ends = [a, b, c, d];
        ends.sort_by(|p, q| place(*p).total_cmp(&place(*q)));
        (a, b) = (ends[0], ends[3]);
    }
    lines.push([a, b]);
}
