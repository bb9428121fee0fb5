//! The annotations of a view: places for dimensions, section marks, letters, titles and balloons.
//!
//! Each view has an `AnnotationBoard` with the paper that is occupied, first by the lines of the view. The
//! kinds take their places one after another, from the most to the least constrained, each the first free
//! one of its candidates:
//!
//! 1. Centre lines, circles of details, section lines within the view.
//! 2. Ends of section lines near the view, dimensions in rows, slanted dimensions, diameters, the other
//!    ends.
//! 3. Letters of details, the title of the view, balloons.
//!
//! Annotations reach outside the view. The sheet reserves that margin, so margins never overlap another
//! view or a table.
//!
//! Files, in reading order: `view_drawings`, `centre_lines`, `section_marks`, `dimension_lines`,
//! `dimension_style`, `diameter_leaders`, `detail_labels`, `balloon_rings`.

mod balloon_rings;
mod centre_lines;
mod detail_labels;
mod diameter_leaders;
mod dimension_lines;
mod dimension_style;
mod section_marks;
mod view_drawings;

use glam::DVec2;
use kurbo::{Point, Rect, Vec2};

use crate::page::sheet::canvas::annotation_board::AnnotationBoard;
pub(crate) use view_drawings::ViewDrawings;

use super::arrangement::titles_and_notes;
use crate::error::Error;
use crate::page::sheet::arrangement::view_arrangement::{ANNOTATION_MARGIN_MM, VIEW_MARGIN_MM};
use crate::page::sheet::arrangement::view_plan::ViewPlan;
use crate::page::sheet::canvas::paper_occupancy::{ConvexShape, OccupantKind};
use crate::page::sheet::dimensions::dimension_set::{DimensionSet, SlantedLength};
use crate::page::sheet::parts_list::parts_list_items::PartsListItem;
use crate::page::sheet::view::view_side::{SideLength, ViewSide};
use crate::surface::Cylinder;
use crate::text::Font;
use section_marks::SectionMark;

/// Radius of the free paper around the start of a leader, mm.
const ANCHOR_RADIUS_MM: f64 = 1.5;

/// The annotations of all views.
pub(crate) struct Annotations<'a> {
    pub font: &'a Font,
    pub measures: &'a DimensionSet,
    /// Cylinders with centre lines.
    pub cylinders: &'a [Cylinder],
    /// Items with balloons. Each anchor is relative to the corner of the view, in model units, x right and y
    /// down.
    pub items: &'a [PartsListItem],
    pub anchors: &'a [Option<DVec2>],
    /// The scale of the sheet.
    pub scale: f64,
}

impl Annotations<'_> {
    /// Places all annotations of a view.
    ///
    /// # Errors
    /// Returns an error if a text cannot be set.
    pub(crate) fn board(
        &self,
        view: usize,
        plan: &ViewPlan,
        drawings: &ViewDrawings,
    ) -> Result<AnnotationBoard, Error> {
        let mut board = AnnotationBoard::new(self.font);
        let sheet_view = &plan.views[view].sight;
        let rect = sheet_view.rect();
        for ([a, b], width) in drawings.chords(view, plan) {
            board.taken.take(ConvexShape::line(a, b, width), OccupantKind::Geometry);
        }
        let anchors: Vec<Option<Point>> = if plan.balloons == Some(view) {
            let anchor = |offset: &Option<DVec2>| {
                offset.map(|at| sheet_view.corner + Vec2::new(at.x, at.y) * sheet_view.mm_per_unit)
            };
            self.anchors.iter().map(anchor).collect()
        } else {
            Vec::new()
        };
        // Texts must not cover the start of a leader.
        for anchor in anchors.iter().flatten() {
            board.taken.take(ConvexShape::disc(*anchor, ANCHOR_RADIUS_MM), OccupantKind::Geometry);
        }
        centre_lines::centre_lines(plan, view, self.cylinders, &mut board);
        for circled in &plan.circled {
            if circled.source_view == view && circled.meets(sheet_view) {
                detail_labels::draw_circle(
                    sheet_view.to_page(circled.at),
                    circled.radius * sheet_view.mm_per_unit,
                    &mut board,
                );
            }
            if circled.detail_view == view {
                detail_labels::draw_circle(rect.center(), rect.width() / 2.0, &mut board);
            }
        }
        let mut marks = self.cut_marks(view, plan, &mut board);
        let side_lengths: Vec<&SideLength> = self
            .measures
            .lengths
            .iter()
            .filter(|(view_index, _)| *view_index == view)
            .map(|(_, told)| told)
            .collect();
        let crossings_on_side = |direction: Vec2| -> Vec<f64> {
            side_lengths
                .iter()
                .filter(|side_length| side_length.side.outward().dot(direction) > 0.7)
                .flat_map(|told| told.span())
                .collect()
        };
        let slanted: Vec<&SlantedLength> = self
            .measures
            .slanted
            .iter()
            .filter(|(shown_in, _)| *shown_in == view)
            .map(|(_, told)| told)
            .collect();
        board.reserved = dimension_lines::extension_line_paper(rect, slanted.iter().copied());
        for mark in &mut marks {
            mark.place_near(&crossings_on_side, &mut board)?;
        }
        for side in ViewSide::ALL {
            let lengths_of_side: Vec<&SideLength> =
                side_lengths.iter().copied().filter(|told| told.side == side).collect();
            let section_crossings: Vec<f64> = marks
                .iter()
                .filter_map(|mark| mark.open_crossing(side.is_across(), side.outward()))
                .collect();
            dimension_lines::draw_rows(rect, &lengths_of_side, &section_crossings, &mut board)?;
        }
        for (k, slanted_length) in slanted.iter().enumerate() {
            board.reserved = dimension_lines::extension_line_paper(rect, slanted.iter().skip(k + 1).copied());
            dimension_lines::draw_slanted(rect, slanted_length, &mut board)?;
        }
        for (_, diameter_leader) in self.measures.diameters.iter().filter(|(of, _)| *of == view) {
            diameter_leaders::draw_diameter(rect, diameter_leader, &mut board)?;
        }
        for mark in marks {
            mark.finish(&mut board)?;
        }
        for circled in
            plan.circled.iter().filter(|circled| circled.source_view == view && circled.meets(sheet_view))
        {
            let (centre, radius) = (sheet_view.to_page(circled.at), circled.radius * sheet_view.mm_per_unit);
            detail_labels::draw_detail_label(&circled.label, centre, radius, &mut board)?;
        }
        if let Some(title) = titles_and_notes::view_title(plan, view, self.scale) {
            detail_labels::draw_title(&title, rect, &mut board)?;
        }
        balloon_rings::draw_balloons(rect, self.items, &anchors, &mut board)?;
        Ok(board)
    }

    /// The section marks of a view, ordered so that no arrow lies on a mark placed later.
    fn cut_marks(&self, view: usize, plan: &ViewPlan, board: &mut AnnotationBoard) -> Vec<SectionMark> {
        let sheet_view = &plan.views[view].sight;
        let rect = sheet_view.rect();
        let mut marks: Vec<SectionMark> = Vec::new();
        for cut in plan.cuts.iter().filter(|cut| titles_and_notes::edge_on_view(plan, cut) == Some(view)) {
            let normal = cut.plane.normal();
            // Towards the viewer of the section, on the page.
            let viewing_direction =
                sheet_view.to_page(plan.middle + normal) - sheet_view.to_page(plan.middle);
            let unit_direction = viewing_direction / viewing_direction.hypot2().sqrt();
            let point_on_line = sheet_view.to_page(plan.middle - normal * cut.plane.distance(plan.middle));
            marks.push(SectionMark::new(&cut.label, point_on_line, unit_direction, rect));
        }
        marks.sort_by(|a, b| b.depth().total_cmp(&a.depth()));
        for mark in &marks {
            mark.take_inside(board);
        }
        marks
    }

    /// The extra margins that annotations need outside the regular margin: left, above, right, below, mm.
    pub(crate) fn room(board: &AnnotationBoard, rect: Rect) -> [f64; 4] {
        let Some(extents) = board.extents() else { return [0.0; 4] };
        let existing_margin = VIEW_MARGIN_MM - ANNOTATION_MARGIN_MM;
        let overhangs =
            [rect.x0 - extents.x0, rect.y0 - extents.y0, extents.x1 - rect.x1, extents.y1 - rect.y1];
        overhangs.map(|past| (past - existing_margin).max(0.0))
    }
}
