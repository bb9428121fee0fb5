//! Texts of a technical sheet that are not dimensions: the titles of its views and its general notes.
//!
//! Also finds the view that shows a section's cutting line, the circle around a detail view, and texts with
//! unreadable characters.

use kurbo::{Circle, Point, Rect, Shape as _};

use super::view_arrangement::ViewPlacement;
use super::view_plan::{CutLine, ViewPlan};
use crate::drawing::Composition;
use crate::error::Error;
use crate::page::page_source::PageSource;
use crate::page::sheet::canvas::sheet_canvas::SheetCanvas;
use crate::page::sheet::keys::sheet_keys::SheetPage;
use crate::page::sheet::view::scale_series;
use crate::page::sheet::view::sheet_view::SheetView;
use crate::page::tolerances;
use crate::text::Font;

/// Text above a view, such as `A-A (2:1)`: its title, and its scale if that differs from the sheet's. `None`
/// if it has neither.
///
/// `scale` is the scale of the sheet. The scale of free and pictorial views is never written.
pub(crate) fn view_title(plan: &ViewPlan, view: usize, scale: f64) -> Option<String> {
    let placed = &plan.views[view];
    let own = placed.sight.mm_per_unit / plan.unit_mm();
    let is_other = !matches!(placed.placement, ViewPlacement::Free | ViewPlacement::Pictorial)
        && (own / scale - 1.0).abs() > tolerances::MAX_SCALE_DIFFERENCE_SHARE;
    let scale = is_other.then(|| scale_series::format_scale(own));
    match (&placed.sight.title, scale) {
        (Some(title), Some(scale)) => Some(format!("{title} ({scale})")),
        (Some(title), None) => Some(title.clone()),
        (None, scale) => scale.map(|scale| format!("({scale})")),
    }
}

/// Index of the view that shows the cutting line of a section: the first view without a title that sees the
/// cutting plane edge-on.
pub(crate) fn edge_on_view(plan: &ViewPlan, cut: &CutLine) -> Option<usize> {
    let edge_on =
        |sight: &SheetView| cut.plane.normal().dot(sight.axes()[2]).abs() < tolerances::MAX_EDGE_ON_COSINE;
    plan.views.iter().position(|placed| edge_on(&placed.sight) && placed.sight.title.is_none())
}

/// The circle around a detail view, page mm.
pub(crate) fn detail_circle(shown: &SheetView) -> Circle {
    Circle::new(shown.rect().center(), shown.rect().width() / 2.0)
}

/// Letter height of notes.
const NOTE_HEIGHT_MM: f64 = 3.5;
/// Maximum width of a line of a note.
const MAX_NOTE_WIDTH_MM: f64 = 90.0;
/// Distance of notes from the left side of the frame.
const NOTE_LEFT_MARGIN_MM: f64 = 16.0;
/// Distance of notes from the frame and from tables.
const NOTE_MARGIN_MM: f64 = 6.0;

/// Sets the notes of a sheet in the lower left corner, or above the tables there. Returns their marks, and
/// the rectangle they occupy; `None` if the sheet has no notes.
///
/// `space` is the free rectangle inside the frame, and `tables` are the rectangles of tables, page mm.
///
/// # Errors
/// Returns an error if no font has a glyph, or the notes are too high for the sheet.
pub(crate) fn write_notes(
    sheet: &SheetPage,
    (space, tables): (Rect, &[Rect]),
    font: &Font,
    source: &PageSource,
) -> Result<(SheetCanvas, Option<Rect>), Error> {
    let mut ink = SheetCanvas::new(font, "note");
    let text = sheet.notes.join("\n");
    if text.trim().is_empty() {
        return Ok((ink, None));
    }
    let high = ink
        .lines(&text, Point::ZERO, NOTE_HEIGHT_MM, MAX_NOTE_WIDTH_MM)
        .map_err(|error| source.about_text(&sheet.notes, error.within("the notes")))?;
    let wide = ink.marks.iter().map(|mark| mark.path.bounding_box().x1).fold(0.0, f64::max);
    let left = space.x0 + NOTE_LEFT_MARGIN_MM;
    // The lowest position that does not overlap a table.
    let mut place = Rect::new(left, space.y1 - NOTE_MARGIN_MM - high, left + wide, space.y1 - NOTE_MARGIN_MM);
    let mut tables: Vec<&Rect> = tables.iter().collect();
    tables.sort_by(|a, b| b.y0.total_cmp(&a.y0));
    for table in tables {
        if table.inflate(NOTE_MARGIN_MM, NOTE_MARGIN_MM).overlaps(place) {
            place = Rect { y0: table.y0 - NOTE_MARGIN_MM - high, y1: table.y0 - NOTE_MARGIN_MM, ..place };
        }
    }
    if place.y0 < space.y0 + NOTE_MARGIN_MM {
        return Err(Error::new("the notes do not fit on this sheet")
            .in_file(&source.path)
            .remedy("choose a larger size, or shorten them"));
    }
    ink.marks = ink.marks.into_iter().map(|mark| mark.moved(place.origin().to_vec2())).collect();
    Ok((ink, Some(place)))
}

/// A warning with the first text that contains the replacement character U+FFFD; `None` if no text does.
pub(crate) fn unreadable_text_warning(composition: &Composition) -> Option<String> {
    let marks = composition.items.iter().flat_map(|item| &item.drawing.layers).flat_map(|layer| &layer.marks);
    let texts = marks.filter_map(|mark| Some(&mark.provenance.text.as_ref()?.words));
    let first = texts.into_iter().find(|words| words.contains(char::REPLACEMENT_CHARACTER))?;
    let what = "the text has a character that could not be read (U+FFFD); it is drawn as a box";
    Some(format!("`{first}`: {what}"))
}
