//! [`arrange_views`]: the position of each view on a sheet, and the scale of the sheet.
//!
//! 1. Views in projection stand in rows and columns around the front view, in the upper left corner.
//! 2. The other views go to free rectangles, in the order that makes them largest.
//! 3. Scales of the standard series are tried from the largest. Of the two largest that fit, the one with the
//!    larger views is taken.
//!
//! Source: ISO 128-3:2020 and ISO 5456-2:1996 (positions of views in first- and third-angle projection).

use kurbo::{Point, Rect};

use super::free_rectangles::FreeRectangles;
use crate::geometry::numbers::portable_math::ln;
use crate::page::sheet::canvas::annotation_board::AnnotationBoard;
use crate::page::sheet::view::projection_method::ProjectionMethod;
use crate::page::sheet::view::scale_series::STANDARD_SCALES;
use crate::page::sheet::view::sheet_view::SheetView;
use crate::page::tolerances;
use crate::scene::NamedView;

/// Minimum margin around a view, mm.
pub(crate) const VIEW_MARGIN_MM: f64 = 7.0;

/// Offset of the views from the edge of the free paper where centring marks are in the way, mm.
const CENTRING_MARK_OFFSET_MM: f64 = 9.0;

/// Distance from the annotations of a view to the edge of its rectangle, mm.
pub(crate) const ANNOTATION_MARGIN_MM: f64 = 3.0;

/// Views without a scale are at most `MAX_FREE_ENLARGEMENT` times as large as the others. They shrink by
/// `FREE_SCALE_FACTOR` until they fit, at most `FREE_SCALE_STEPS` times.
const MAX_FREE_ENLARGEMENT: f64 = 4.0;
const FREE_SCALE_FACTOR: f64 = 0.94;
const FREE_SCALE_STEPS: i32 = 72;

/// Separate views may be smaller than the others by up to this number of steps of the series.
const MAX_SMALLER_SCALES: usize = 3;

/// A view and its position on the sheet.
#[derive(Debug)]
pub(crate) struct PlacedView {
    pub sight: SheetView,
    pub placement: ViewPlacement,
    /// Extra margin for annotations: left, above, right, below, mm. One entry for each length on paper of a
    /// model unit that was tried.
    pub margins: Vec<(f64, [f64; 4])>,
    /// The rectangle of the view with all its margins, page mm.
    place: Rect,
}

impl PlacedView {
    /// A view without annotations.
    pub(crate) fn new(sight: SheetView, view_placement: ViewPlacement) -> Self {
        Self { sight, placement: view_placement, margins: Vec::new(), place: Rect::ZERO }
    }
}

impl PlacedView {
    /// Extra margins if a model unit is `unit` mm long on paper: left, above, right, below.
    ///
    /// They are 0 at a scale where they are not known. Pictorial and free views have any scale, so they take
    /// the margins found last.
    pub(crate) fn margins_at(&self, unit: f64) -> [f64; 4] {
        let is_same = |known: &f64| (known / unit - 1.0).abs() < tolerances::MAX_SCALE_DIFFERENCE_SHARE;
        let known = self.margins.iter().find(|(known, _)| is_same(known));
        if let Some((_, around)) = known {
            return *around;
        }
        let last = self.margins.last().filter(|_| self.placement.max_unit(unit).is_some());
        last.map_or([0.0; 4], |(_, around)| *around)
    }

    /// Widens the margins at the present scale to at least `needed`.
    pub(crate) fn widen_margins(&mut self, needed: [f64; 4]) {
        let unit = self.sight.mm_per_unit;
        let current_margins = self.margins_at(unit);
        let is_other = |known: &f64| (known / unit - 1.0).abs() >= tolerances::MAX_SCALE_DIFFERENCE_SHARE;
        self.margins.retain(|(known, _)| is_other(known));
        self.margins.push((unit, [0, 1, 2, 3].map(|side| current_margins[side].max(needed[side]))));
    }

    /// Changes the scale from `from` to `to` and keeps the centre of the view.
    pub(crate) fn rescale(&mut self, from: f64, to: f64) {
        let ([w, h], [wide, high]) = (self.sight.size(from), self.sight.size(to));
        self.sight.mm_per_unit = to;
        self.sight.corner += kurbo::Vec2::new((w - wide) / 2.0, (h - high) / 2.0);
    }

    /// Whether the view and all its annotations fit into its rectangle.
    pub(crate) fn has_room_for(&self, board: &AnnotationBoard) -> bool {
        let rect = self.sight.rect();
        let extents = board.extents().map_or(rect, |extents| extents.union(rect));
        let margin = tolerances::POSITION_ROUNDING_MM - ANNOTATION_MARGIN_MM;
        let reserved_rect = self.place.inflate(margin, margin);
        reserved_rect.contains_rect(extents) && board.unplaced.is_empty()
    }
}

/// Position and scale that a view may have.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum ViewPlacement {
    /// In the row and column of the front view that its projection requires.
    Projected(NamedView),
    /// Anywhere, at the scale of the sheet or a smaller one.
    Separate,
    /// Anywhere, at the scale of the sheet or a smaller one; it may be enlarged later, because it is not to
    /// scale.
    Pictorial,
    /// Anywhere, as large as possible.
    Free,
    /// Anywhere, at this multiple of the scale of the sheet.
    Enlarged(f64),
    /// Anywhere, at this scale.
    At(f64),
}

impl ViewPlacement {
    /// The maximum length on paper of a model unit; `None` for views that are to scale.
    pub(crate) fn max_unit(self, unit: f64) -> Option<f64> {
        match self {
            Self::Pictorial | Self::Free => Some(unit * MAX_FREE_ENLARGEMENT),
            _ => None,
        }
    }
}

/// A scale, and the next smaller ones of the series.
fn with_smaller_scales(scale: f64, scale_index: usize) -> Vec<f64> {
    [scale]
        .into_iter()
        .chain(STANDARD_SCALES.iter().skip(scale_index + 1).copied().take(MAX_SMALLER_SCALES))
        .collect()
}

/// Column and row of a view; the front view is at 0, 0.
fn grid_cell(view: NamedView, method: ProjectionMethod) -> [i32; 2] {
    let towards = if method == ProjectionMethod::First { 1 } else { -1 };
    match view {
        NamedView::Left => [towards, 0],
        NamedView::Right => [-towards, 0],
        NamedView::Top => [0, towards],
        NamedView::Bottom => [0, -towards],
        NamedView::Back => [2, 0],
        _ => [0, 0],
    }
}

/// Places all views on the free part of a sheet and returns the scale; `None` if they do not fit.
///
/// `unit_mm` is the length of a model unit in mm, `requested_scale` a scale from the page file. Of the two largest
/// scales that fit, the one with the larger product of view sizes wins.
pub(crate) fn arrange_views(
    views: &mut [PlacedView],
    (space, reserved_rects): (Rect, &[Rect]),
    (method, unit_mm, requested_scale): (ProjectionMethod, f64, Option<f64>),
) -> Option<f64> {
    let mut free_rectangles = FreeRectangles::new(space);
    reserved_rects.iter().for_each(|taken| free_rectangles.take(*taken));
    let told = requested_scale.map(|scale| vec![scale]);
    let unprojected_views: Vec<usize> =
        (0..views.len()).filter(|k| !matches!(views[*k].placement, ViewPlacement::Projected(_))).collect();
    let orders = placement_orders(&unprojected_views);
    let mut best: Option<(f64, f64, &Vec<usize>)> = None;
    let mut fitting_scales = 0;
    for scale in told.as_deref().unwrap_or(&STANDARD_SCALES) {
        let mut fits = false;
        for order in &orders {
            let mut trial_rectangles = free_rectangles.clone();
            if try_scale(views, (&mut trial_rectangles, space), (method, *scale, unit_mm), order).is_none() {
                continue;
            }
            fits = true;
            let size: f64 = views.iter().map(|placed| ln(placed.sight.mm_per_unit)).sum();
            if best.is_none_or(|(best_size, ..)| size > best_size + tolerances::MIN_LOG_SCALE_GAIN) {
                best = Some((size, *scale, order));
            }
        }
        fitting_scales += usize::from(fits);
        if fitting_scales == 2 {
            break;
        }
    }
    let (_, scale, order) = best?;
    let free_before = free_rectangles.clone();
    try_scale(views, (&mut free_rectangles, space), (method, scale, unit_mm), order)?;
    centre_free_views(views, &free_before, order);
    Some(scale)
}

/// Moves each separate view to the middle of the free rectangle around it.
fn centre_free_views(views: &mut [PlacedView], free: &FreeRectangles, order: &[usize]) {
    for k in order {
        let mut free_rectangles = free.clone();
        let other_views = views.iter().enumerate().filter(|(other, _)| other != k);
        other_views.for_each(|(_, placed)| free_rectangles.take(placed.place));
        let view_rect = views[*k].place;
        if let Some(around) = free_rectangles.around(view_rect) {
            let shift = around.center() - view_rect.center();
            views[*k].place = view_rect + shift;
            views[*k].sight.corner += shift;
        }
    }
}

/// All possible orders of placing views, the given one first. More than `MAX_PERMUTED_VIEWS` views are
/// placed in the given order only.
fn placement_orders(views: &[usize]) -> Vec<Vec<usize>> {
    const MAX_PERMUTED_VIEWS: usize = 5;
    let Some((first, other_views)) = views.split_first().filter(|_| views.len() <= MAX_PERMUTED_VIEWS) else {
        return vec![views.to_vec()];
    };
    let mut orders = Vec::new();
    for order in placement_orders(other_views) {
        for insert_position in 0..=order.len() {
            let mut order = order.clone();
            order.insert(insert_position, *first);
            orders.push(order);
        }
    }
    orders.sort();
    orders
}

fn try_scale(
    views: &mut [PlacedView],
    (free_rectangles, space): (&mut FreeRectangles, Rect),
    (method, scale, unit_mm): (ProjectionMethod, f64, f64),
    order: &[usize],
) -> Option<()> {
    let unit = scale * unit_mm;
    let projected_cells = |views: &[PlacedView]| -> Vec<(usize, [i32; 2])> {
        let cell_of_view = |(k, placed): (usize, &PlacedView)| match placed.placement {
            ViewPlacement::Projected(view) => Some((k, grid_cell(view, method))),
            _ => None,
        };
        views.iter().enumerate().filter_map(cell_of_view).collect()
    };
    let projected_views = projected_cells(views);
    if !projected_views.is_empty() {
        // Extent of the views before and after the model's centre, for a column (line 0) or a row (line 1).
        let line_extent = |line: usize, at: i32| {
            let views_on_line = projected_views.iter().filter(|(_, field)| field[line] == at);
            views_on_line.fold(None, |extent_so_far: Option<[f64; 2]>, (k, _)| {
                let (low, high) = (views[*k].sight.low * unit, views[*k].sight.high * unit);
                let around = views[*k].margins_at(unit);
                let [before, after] = if line == 0 {
                    [around[0] - low.x, high.x + around[2]]
                } else {
                    [around[1] + high.y, around[3] - low.y]
                };
                let [b, a] = extent_so_far.unwrap_or([f64::NEG_INFINITY; 2]);
                Some([b.max(before), a.max(after)])
            })
        };
        let mut middles = [Vec::new(), Vec::new()];
        for (line, middles) in middles.iter_mut().enumerate() {
            let mut offset = VIEW_MARGIN_MM;
            for k in -2..=3 {
                if let Some([before, after]) = line_extent(line, k) {
                    middles.push((k, offset + before));
                    offset += before + after + 2.0 * VIEW_MARGIN_MM;
                }
            }
        }
        // The rectangle of a view with its margins, and the corner of the view itself.
        let rect_and_corner = |placed: &PlacedView, field: [i32; 2], start: [f64; 2]| {
            let middle = |line: usize| {
                let line_middle = middles[line].iter().find(|(at, _)| *at == field[line]);
                start[line] + line_middle.map_or(0.0, |(_, middle)| *middle)
            };
            let sight = &placed.sight;
            let corner = Point::new(
                space.x0 + middle(0) + sight.low.x * unit,
                space.y0 + middle(1) - sight.high.y * unit,
            );
            let [w, h] = sight.size(unit);
            let [left, above, right, below] = placed.margins_at(unit).map(|room| VIEW_MARGIN_MM + room);
            let (x1, y1) = (corner.x + w + right, corner.y + h + below);
            (Rect { x0: corner.x - left, y0: corner.y - above, x1, y1 }, corner)
        };
        // The group stands in the upper left corner, either between the centring marks or clear of them.
        let starts = [
            [0.0, 0.0],
            [0.0, CENTRING_MARK_OFFSET_MM],
            [CENTRING_MARK_OFFSET_MM, 0.0],
            [CENTRING_MARK_OFFSET_MM, CENTRING_MARK_OFFSET_MM],
        ];
        let fits = |start: &[f64; 2]| {
            projected_views
                .iter()
                .all(|(k, field)| free_rectangles.is_free(rect_and_corner(&views[*k], *field, *start).0))
        };
        let start = starts.into_iter().find(fits)?;
        for (k, field) in &projected_views {
            let (view_rect, corner) = rect_and_corner(&views[*k], *field, start);
            let placed = &mut views[*k];
            (placed.place, placed.sight.mm_per_unit, placed.sight.corner) = (view_rect, unit, corner);
            free_rectangles.take(view_rect);
        }
    }
    for k in order {
        let placed = &mut views[*k];
        let max_scale = scale * (1.0 + tolerances::MAX_SCALE_DIFFERENCE_SHARE);
        let first_scale_index = STANDARD_SCALES
            .iter()
            .position(|standard_scale| *standard_scale <= max_scale)
            .unwrap_or_default();
        let scales: Vec<f64> = match placed.placement {
            ViewPlacement::Projected(_) => continue,
            ViewPlacement::Enlarged(times) => vec![scale * times],
            ViewPlacement::At(scale) => vec![scale],
            ViewPlacement::Separate => with_smaller_scales(scale, first_scale_index),
            ViewPlacement::Pictorial => {
                (0..FREE_SCALE_STEPS).map(|k| scale * FREE_SCALE_FACTOR.powi(k)).collect()
            }
            ViewPlacement::Free => (0..FREE_SCALE_STEPS)
                .map(|k| scale * MAX_FREE_ENLARGEMENT * FREE_SCALE_FACTOR.powi(k))
                .collect(),
        };
        let scale_and_rect = scales.into_iter().find_map(|scale| {
            let [w, h] = placed.sight.size(scale * unit_mm);
            let [left, above, right, below] = placed.margins_at(scale * unit_mm);
            free_rectangles
                .put(w + 2.0 * VIEW_MARGIN_MM + left + right, h + 2.0 * VIEW_MARGIN_MM + above + below)
                .map(|fitting_rect| (scale, fitting_rect))
        });
        let (scale, placed_rect) = scale_and_rect?;
        let [left, above, ..] = placed.margins_at(scale * unit_mm);
        placed.place = placed_rect;
        placed.sight.mm_per_unit = scale * unit_mm;
        placed.sight.corner =
            Point::new(placed_rect.x0 + VIEW_MARGIN_MM + left, placed_rect.y0 + VIEW_MARGIN_MM + above);
    }
    Some(())
}
