//! [`Layout`]: the place of everything that is written on a view.
//!
//! Each view has a [`Board`]: what is written on it, and an [`Occupancy`] of the paper that is taken, first by the lines of the view. One
//! kind after the other takes its place, from what is bound to the view to what may stand anywhere:
//!
//! 1. centre lines, circles of details, lines of cutting planes within the view;
//! 2. ends of cutting planes that fit near the view, lengths in rows, other lengths, diameters, the other ends;
//! 3. letters of details, the title, balloons.
//!
//! Each takes the first of its places that is clear. What is written reaches outside the view; the view is given that room on the sheet
//! ([`Layout::room`]), where rooms do not overlap. So nothing is written on another view, a table or a mark of the frame.

mod balloon_rings;
mod board;
mod cut_marks;
mod dimension_lines;
mod drawn_views;
mod letters;
pub(super) mod occupancy;
mod round_notes;

use glam::DVec2;
use kurbo::{Point, Rect, Vec2};

pub(super) use board::Board;
pub(super) use drawn_views::DrawnViews;

use super::arrange::{AROUND, ELEMENTS_CLEAR};
use super::centre;
use super::list::Item;
use super::measures::{Measures, Slanted};
use super::notes;
use super::plan::Plan;
use super::rows::{Side, Told};
use crate::error::Error;
use crate::shape::Cylinder;
use crate::text::Font;
use cut_marks::CutMark;
use occupancy::{Kind, Shape};

/// Clear paper around the place where a leader begins, mm.
const ANCHOR: f64 = 1.5;

/// What is to be written on the views.
pub(super) struct Layout<'a> {
    pub font: &'a Font,
    pub measures: &'a Measures,
    /// Whose centre lines are drawn.
    pub cylinders: &'a [Cylinder],
    /// What has balloons, and where it is seen, in units of the model to the right and down from the corner of the view.
    pub items: &'a [Item],
    pub anchors: &'a [Option<DVec2>],
    /// The scale of the sheet.
    pub scale: f64,
}

impl Layout<'_> {
    /// Writes on a view.
    ///
    /// # Errors
    /// If a text cannot be set.
    pub fn board(&self, view: usize, plan: &Plan, drawn: &DrawnViews) -> Result<Board, Error> {
        let mut board = Board::new(self.font);
        let sight = &plan.views[view].sight;
        let rect = sight.rect();
        for ([a, b], width) in drawn.chords(view, plan) {
            board.taken.take(Shape::line(a, b, width), Kind::Geometry);
        }
        let anchors: Vec<Option<Point>> = if plan.balloons == Some(view) {
            let anchor = |at: &Option<DVec2>| at.map(|at| sight.corner + Vec2::new(at.x, at.y) * sight.unit);
            self.anchors.iter().map(anchor).collect()
        } else {
            Vec::new()
        };
        // Leaders begin where no text is.
        for anchor in anchors.iter().flatten() {
            board.taken.take(Shape::disc(*anchor, ANCHOR), Kind::Geometry);
        }
        centre::centre_lines(plan, view, self.cylinders, &mut board);
        for circled in &plan.circled {
            if circled.of == view && circled.meets(sight) {
                letters::circle(sight.page(circled.at), circled.radius * sight.unit, &mut board);
            }
            if circled.shown == view {
                letters::circle(rect.center(), rect.width() / 2.0, &mut board);
            }
        }
        let mut marks = self.cut_marks(view, plan, &mut board);
        let told: Vec<&Told> =
            self.measures.lengths.iter().filter(|(of, _)| *of == view).map(|(_, told)| told).collect();
        let kept = |out: Vec2| -> Vec<f64> {
            told.iter()
                .filter(|told| told.side.outward().dot(out) > 0.7)
                .flat_map(|told| told.span())
                .collect()
        };
        let slanted: Vec<&Slanted> =
            self.measures.slanted.iter().filter(|(of, _)| *of == view).map(|(_, told)| told).collect();
        board.kept = dimension_lines::passing(rect, slanted.iter().copied());
        for mark in &mut marks {
            mark.place_near(&kept, &mut board)?;
        }
        for side in Side::ALL {
            let own: Vec<&Told> = told.iter().copied().filter(|told| told.side == side).collect();
            let open: Vec<f64> =
                marks.iter().filter_map(|mark| mark.open_at(side.is_across(), side.outward())).collect();
            dimension_lines::rows(rect, &own, &open, &mut board)?;
        }
        for (k, own) in slanted.iter().enumerate() {
            board.kept = dimension_lines::passing(rect, slanted.iter().skip(k + 1).copied());
            dimension_lines::slanted(rect, own, &mut board)?;
        }
        for (_, led) in self.measures.led.iter().filter(|(of, _)| *of == view) {
            round_notes::draw(rect, led, &mut board)?;
        }
        for mark in marks {
            mark.finish(&mut board)?;
        }
        for circled in plan.circled.iter().filter(|circled| circled.of == view && circled.meets(sight)) {
            let (centre, radius) = (sight.page(circled.at), circled.radius * sight.unit);
            letters::of_detail(&circled.label, centre, radius, &mut board)?;
        }
        if let Some(title) = notes::title(plan, view, self.scale) {
            letters::title(&title, rect, &mut board)?;
        }
        balloon_rings::draw(rect, self.items, &anchors, &mut board)?;
        Ok(board)
    }

    /// The planes that are marked on a view, those first whose arrows lie on none of the others.
    fn cut_marks(&self, view: usize, plan: &Plan, board: &mut Board) -> Vec<CutMark> {
        let sight = &plan.views[view].sight;
        let rect = sight.rect();
        let mut marks: Vec<CutMark> = Vec::new();
        for cut in plan.cuts.iter().filter(|cut| notes::crossed(plan, cut) == Some(view)) {
            let normal = cut.plane.normal();
            // Towards the eye of the section, on the page.
            let back = sight.page(plan.middle + normal) - sight.page(plan.middle);
            let back = back / back.hypot2().sqrt();
            let on = sight.page(plan.middle - normal * cut.plane.distance(plan.middle));
            marks.push(CutMark::new(&cut.label, on, back, rect));
        }
        marks.sort_by(|a, b| b.depth().total_cmp(&a.depth()));
        for mark in &marks {
            mark.take_inside(board);
        }
        marks
    }

    /// The room that a view needs for what is written on it, more than it has anyway, mm: on the left, above, on the right, below.
    pub fn room(board: &Board, rect: Rect) -> [f64; 4] {
        let Some(extents) = board.extents() else { return [0.0; 4] };
        let own = AROUND - ELEMENTS_CLEAR;
        let past = [rect.x0 - extents.x0, rect.y0 - extents.y0, extents.x1 - rect.x1, extents.y1 - rect.y1];
        past.map(|past| (past - own).max(0.0))
    }
}
