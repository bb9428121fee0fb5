//! [`SheetLayout`]: positions and scale of all views of a sheet, with places for their annotations.
//!
//! 1. The views are arranged at the largest scale that fits, and their annotations are placed.
//! 2. Annotations that reach outside a view widen its margin, and the views are arranged again.
//! 3. Once everything fits, a view inside a ring of balloons is enlarged as far as the ring allows.

use glam::DVec2;
use kurbo::{Point, Rect};

use super::annotations::{Annotations, ViewDrawings};
use crate::drawing::PlacedDrawing;
use crate::error::Error;
use crate::mesh::Mesh;
use crate::page::page_source::PageSource;
use crate::page::sheet::arrangement::view_arrangement::{PlacedView, arrange_views};
use crate::page::sheet::arrangement::view_plan::{ViewPlan, read_scale};
use crate::page::sheet::canvas::annotation_board::AnnotationBoard;
use crate::page::sheet::dimensions::dimension_set::DimensionSet;
use crate::page::sheet::dimensions::hole_dimensions::{HoleDimension, find_hole_dimensions, whole_cylinders};
use crate::page::sheet::dimensions::requested_dimensions::add_requested;
use crate::page::sheet::keys::sheet_keys::SheetPage;
use crate::page::sheet::part_balloons::balloon_anchors::find_anchors;
use crate::page::sheet::parts_list::parts_list_items::PartsListItem;
use crate::page::tolerances::LENGTH_ROUNDING_MM;
use crate::pipeline::Renderer;
use crate::surface::Cylinder;
use crate::text::Font;

/// Maximum number of layout rounds: annotations change the scale, and the scale changes the room of
/// annotations.
const MAX_LAYOUT_ROUNDS: usize = 60;

/// Enlargements that are tried for a view inside a ring of balloons.
const RING_ENLARGEMENTS: [f64; 6] = [4.0, 3.0, 2.4, 1.9, 1.5, 1.25];

/// A sheet whose views have their final positions.
pub(crate) struct SettledLayout {
    pub scale: f64,
    /// The drawings of the views, and their warnings.
    pub views: (Vec<PlacedDrawing>, Vec<String>),
    pub boards: Vec<AnnotationBoard>,
    /// Anchors of the balloons, one per item of the parts list; `None` if no part of the item is visible.
    pub anchors: Vec<Option<DVec2>>,
}

/// Data that stays the same while the views are arranged repeatedly.
pub(crate) struct SheetLayout<'a> {
    sheet: &'a SheetPage,
    overall: bool,
    /// Automatic diameters, if wanted.
    rounds: Option<Vec<HoleDimension>>,
    /// Cylinders with centre lines.
    cylinders: Vec<Cylinder>,
}

impl<'a> SheetLayout<'a> {
    /// Reads which dimensions and centre lines a sheet has.
    ///
    /// # Errors
    /// Returns an error if the set of dimensions is unknown.
    pub(crate) fn new(sheet: &'a SheetPage, plan: &ViewPlan, source: &PageSource) -> Result<Self, Error> {
        let dimensions = match &sheet.dimensions {
            None => "overall",
            Some(requested_set) => match &**requested_set.get_ref() {
                set_name @ ("none" | "overall" | "auto") => set_name,
                _ => {
                    return Err(source.unknown(
                        requested_set,
                        "set of dimensions",
                        &["none", "overall", "auto"],
                    ));
                }
            },
        };
        let is_automatic = dimensions == "auto";
        let is_single = plan.sets[0].scene.parts.len() == 1;
        let cylinders = if sheet.centre_lines.unwrap_or(is_single || is_automatic) {
            whole_cylinders(&Mesh::build(plan.sets[0].scene.to_soup()))
        } else {
            Vec::new()
        };
        let has_overall_dimensions = sheet.overall.unwrap_or(dimensions != "none");
        Ok(Self { sheet, overall: has_overall_dimensions, rounds: is_automatic.then(Vec::new), cylinders })
    }

    fn measures(&self, plan: &ViewPlan, source: &PageSource) -> Result<DimensionSet, Error> {
        let mut measures = DimensionSet::default();
        if self.overall {
            measures.add_overall(plan);
        }
        if let Some(rounds) = &self.rounds {
            measures.add_rounds(plan, rounds);
        }
        add_requested(self.sheet, plan, &mut measures, source)?;
        Ok(measures)
    }

    /// Arranges the views until all annotations fit.
    ///
    /// # Errors
    /// Returns an error if the views or their annotations do not fit, or a view cannot be drawn.
    pub(crate) fn settle_layout(
        &mut self,
        plan: &mut ViewPlan,
        space_and_reserved: (Rect, &[Rect]),
        (font, items): (&Font, &[PartsListItem]),
        source: &PageSource,
    ) -> Result<SettledLayout, Error> {
        let requested_scale = self.sheet.scale.as_ref().map(|scale| read_scale(scale, source)).transpose()?;
        let sets = plan.sets.clone();
        let mut prepared = Vec::new();
        for (number, set) in sets.iter().enumerate() {
            prepared
                .push(plan.scene_of_view.contains(&number).then(|| Renderer::new(&set.scene, &set.style)));
        }
        let mut drawings = ViewDrawings::new(prepared, plan.views.len());
        let mut anchors: Option<Vec<Option<DVec2>>> = None;
        for _ in 0..MAX_LAYOUT_ROUNDS {
            let unit_mm = plan.unit_mm();
            let fitting_scale = arrange_views(
                &mut plan.views,
                space_and_reserved,
                (self.sheet.projection, unit_mm, requested_scale),
            );
            let Some(scale) = fitting_scale else { return Err(self.misfit_error(plan, source)) };
            if anchors.is_none() {
                drawings.update(plan)?;
                if let Some(rounds) = &mut self.rounds {
                    *rounds = find_hole_dimensions(plan);
                }
                let initial_anchors = plan.balloons.map(|view| {
                    let sheet_view = &plan.views[view].sight;
                    let anchor_points =
                        find_anchors(sheet_view, &plan.sets[plan.scene_of_view[view]].scene, items);
                    let relative_to_view =
                        |p: Point| DVec2::new(p.x - sheet_view.corner.x, p.y - sheet_view.corner.y);
                    anchor_points
                        .into_iter()
                        .map(|p| p.map(|p| relative_to_view(p) / sheet_view.mm_per_unit))
                        .collect()
                });
                anchors = Some(initial_anchors.unwrap_or_default());
            }
            let measures = self.measures(plan, source)?;
            let layout = Annotations {
                font,
                measures: &measures,
                cylinders: &self.cylinders,
                items,
                anchors: anchors.as_deref().unwrap_or_default(),
                scale,
            };
            let annotate_views = |plan: &ViewPlan, view_drawings: &ViewDrawings| {
                (0..plan.views.len())
                    .map(|view| layout.board(view, plan, view_drawings))
                    .collect::<Result<Vec<_>, _>>()
            };
            let mut annotation_boards = annotate_views(plan, &drawings)?;
            let mut fits = make_room(&mut plan.views, &annotation_boards);
            if fits && drawings.update(plan)? {
                annotation_boards = annotate_views(plan, &drawings)?;
                fits = make_room(&mut plan.views, &annotation_boards);
            }
            if !fits {
                continue;
            }
            if let Some(view) = plan.balloons {
                let annotate_view = |plan: &ViewPlan, drawn: &ViewDrawings| layout.board(view, plan, drawn);
                fill_ring(plan, view, &mut drawings, (scale, &mut annotation_boards[view]), annotate_view)?;
            }
            if let Some(unplaced) = annotation_boards.iter().find_map(|board| board.unplaced.first()) {
                return Err(Error::new(format!("this sheet has no free place for {unplaced}"))
                    .remedy("choose a larger size or another scale, or leave something out"));
            }
            let views = drawings.into_items(plan);
            return Ok(SettledLayout {
                scale,
                views,
                boards: annotation_boards,
                anchors: anchors.unwrap_or_default(),
            });
        }
        Err(self.misfit_error(plan, source))
    }

    /// The error that the views do not fit; it names the view with the widest margins.
    fn misfit_error(&self, plan: &ViewPlan, source: &PageSource) -> Error {
        let total_margin =
            |placed: &PlacedView| placed.margins.last().map_or(0.0, |(_, around)| around.iter().sum::<f64>());
        let widest = plan.views.iter().max_by(|a, b| total_margin(a).total_cmp(&total_margin(b)));
        let message = match widest.filter(|placed| total_margin(placed) > 0.0) {
            Some(placed) => format!(
                "the views do not fit on this sheet; `{}` needs the most room for dimensions, letters and balloons",
                placed.sight.name
            ),
            None => "the views do not fit on this sheet".to_owned(),
        };
        let remedy = "choose a larger size, fewer views or another scale";
        match &self.sheet.scale {
            Some(requested_scale) => source.fault(&requested_scale.span(), &message, remedy),
            None => Error::new(message).remedy(remedy),
        }
    }
}

/// Enlarges a view with balloons as far as the ring of balloons allows. Views to scale keep their size.
fn fill_ring(
    plan: &mut ViewPlan,
    view: usize,
    drawings: &mut ViewDrawings,
    (scale, best_board): (f64, &mut AnnotationBoard),
    annotate_view: impl Fn(&ViewPlan, &ViewDrawings) -> Result<AnnotationBoard, Error>,
) -> Result<(), Error> {
    let unit = plan.views[view].sight.mm_per_unit;
    let Some(max_unit_size) = plan.views[view].placement.max_unit(scale * plan.unit_mm()) else {
        return Ok(());
    };
    for enlargement in RING_ENLARGEMENTS {
        plan.views[view].rescale(unit, (unit * enlargement).min(max_unit_size));
        let mut trial_board = annotate_view(plan, drawings)?;
        if plan.views[view].has_room_for(&trial_board) {
            drawings.update(plan)?;
            trial_board = annotate_view(plan, drawings)?;
            if plan.views[view].has_room_for(&trial_board) {
                *best_board = trial_board;
                return Ok(());
            }
        }
        let enlarged_unit = plan.views[view].sight.mm_per_unit;
        plan.views[view].rescale(enlarged_unit, unit);
    }
    drawings.update(plan)?;
    Ok(())
}

/// Widens the margins of views to those that their annotations need. Returns whether they were wide enough.
fn make_room(views: &mut [PlacedView], boards: &[AnnotationBoard]) -> bool {
    let mut fits = true;
    for (placed, board) in views.iter_mut().zip(boards) {
        let needed = Annotations::room(board, placed.sight.rect());
        let current_margins = placed.margins_at(placed.sight.mm_per_unit);
        if needed.iter().zip(current_margins).all(|(needed, own)| *needed <= own + LENGTH_ROUNDING_MM) {
            continue;
        }
        fits = false;
        placed.widen_margins(needed);
    }
    fits
}
