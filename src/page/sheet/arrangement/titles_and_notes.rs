//! Titles of views, and the notes of a sheet.

use kurbo::{Circle, Point, Rect, Shape as _};

use super::view_arrangement::Stands;
use super::view_plan::{CutLine, Plan};
use crate::drawing::Composition;
use crate::error::Error;
use crate::page::page_source::Source;
use crate::page::sheet::canvas::sheet_canvas::Ink;
use crate::page::sheet::keys::sheet_keys::SheetPage;
use crate::page::sheet::view::scale_series;
use crate::page::sheet::view::sheet_view::Sight;
use crate::text::Font;

/// The title of a view: its own title, and its scale if that differs from the sheet's.
pub(crate) fn title(plan: &Plan, view: usize, scale: f64) -> Option<String> {
    let placed = &plan.views[view];
    let own = placed.sight.unit / plan.unit_mm();
    let is_other =
        !matches!(placed.stands, Stands::Free | Stands::Pictorial) && (own / scale - 1.0).abs() > 1e-9;
    let scale = is_other.then(|| scale_series::written(own));
    match (&placed.sight.title, scale) {
        (Some(title), Some(scale)) => Some(format!("{title} ({scale})")),
        (Some(title), None) => Some(title.clone()),
        (None, scale) => scale.map(|scale| format!("({scale})")),
    }
}

/// The view with the line of a section: the first one that sees the plane edge-on.
pub(crate) fn crossed(plan: &Plan, cut: &CutLine) -> Option<usize> {
    let edge_on = |sight: &Sight| cut.plane.normal().dot(sight.axes()[2]).abs() < 1e-9;
    plan.views.iter().position(|placed| edge_on(&placed.sight) && placed.sight.title.is_none())
}

/// The circle around a detail view.
pub(crate) fn circle_of(shown: &Sight) -> Circle {
    Circle::new(shown.rect().center(), shown.rect().width() / 2.0)
}

/// Letter height of notes, maximum width, and margins to the frame, mm.
const HIGH: f64 = 3.5;
const WIDE: f64 = 90.0;
const LEFT: f64 = 16.0;
const BELOW: f64 = 6.0;

/// Sets the notes of a sheet in the lower left corner, or above the tables there. Returns their marks and the
/// paper they occupy.
///
/// # Errors
/// Returns an error if no font has a glyph, or the notes are too high for the sheet.
pub(crate) fn written(
    sheet: &SheetPage,
    (space, tables): (Rect, &[Rect]),
    font: &Font,
    source: &Source,
) -> Result<(Ink, Option<Rect>), Error> {
    let mut ink = Ink::new(font, "note");
    let text = sheet.notes.join("\n");
    if text.trim().is_empty() {
        return Ok((ink, None));
    }
    let high = ink
        .lines(&text, Point::ZERO, HIGH, WIDE)
        .map_err(|error| source.about_text(&sheet.notes, error.within("the notes")))?;
    let wide = ink.marks.iter().map(|mark| mark.path.bounding_box().x1).fold(0.0, f64::max);
    let left = space.x0 + LEFT;
    // The lowest position that does not overlap a table.
    let mut place = Rect::new(left, space.y1 - BELOW - high, left + wide, space.y1 - BELOW);
    let mut tables: Vec<&Rect> = tables.iter().collect();
    tables.sort_by(|a, b| b.y0.total_cmp(&a.y0));
    for table in tables {
        if table.inflate(BELOW, BELOW).overlaps(place) {
            place = Rect { y0: table.y0 - BELOW - high, y1: table.y0 - BELOW, ..place };
        }
    }
    if place.y0 < space.y0 + BELOW {
        return Err(Error::new("the notes do not fit on this sheet")
            .in_file(&source.path)
            .remedy("choose a larger size, or shorten them"));
    }
    ink.marks = ink.marks.into_iter().map(|mark| mark.moved(place.origin().to_vec2())).collect();
    Ok((ink, Some(place)))
}

/// A warning if a text contains a character that could not be read.
pub(crate) fn unreadable(composition: &Composition) -> Option<String> {
    let marks = composition.items.iter().flat_map(|item| &item.drawing.layers).flat_map(|layer| &layer.marks);
    let texts = marks.filter_map(|mark| Some(&mark.provenance.text.as_ref()?.words));
    let first = texts.into_iter().find(|words| words.contains(char::REPLACEMENT_CHARACTER))?;
    let what = "the text has a character that could not be read (U+FFFD); it is drawn as a box";
    Some(format!("`{first}`: {what}"))
}
