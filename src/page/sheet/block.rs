//! The title block, and beside it scale, tolerances and the symbol of the method of projection.
//!
//! Source: ISO 7200:2004, Data fields in title blocks and document headers: width, names and lengths of fields. ISO 5456-2:1996, 5: the
//! symbol, a cut cone.

use kurbo::{Point, Rect};
use serde::Deserialize;

use super::ink::{CHAIN, Ink, NARROW, Stand, WIDE, way};
use super::method::Method;
use crate::error::Error;

/// Width of the title block, mm.
pub const WIDTH: f64 = 180.0;

/// Height of a row, and of the strip above the block.
const ROW: f64 = 9.0;
const STRIP: f64 = 10.0;

/// Height of the block with its strip.
pub const HEIGHT: f64 = 3.0 * ROW + STRIP;

/// What a title block says.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct TitleKeys {
    /// Title.
    pub title: String,
    /// Supplementary title.
    pub subtitle: String,
    /// Legal owner.
    pub owner: String,
    /// Identification number.
    pub number: String,
    /// Revision index.
    pub revision: String,
    /// Date of issue.
    pub date: String,
    /// Language code.
    pub language: String,
    /// Number of the sheet and of sheets: `1/3`.
    pub sheet: String,
    /// Responsible department.
    pub department: String,
    /// Technical reference.
    pub reference: String,
    /// Document type.
    pub document: String,
    /// Document status.
    pub status: String,
    /// Creator.
    pub creator: String,
    /// Approval person.
    pub approver: String,
    /// General tolerances.
    pub tolerances: String,
}

/// The place of a title block in a drawing space: its lower right corner.
#[must_use]
pub fn place(space: Rect) -> Rect {
    Rect::new(space.x1 - WIDTH, space.y1 - HEIGHT, space.x1, space.y1)
}

/// Draws it.
pub(super) fn draw(
    place: Rect,
    keys: &TitleKeys,
    (scale, method, size, unit): (&str, Method, &str, &str),
    ink: &mut Ink,
) -> Result<(), Error> {
    ink.rect(place, WIDE);
    let row = |k: f64| place.y0 + STRIP + k * ROW;
    let x = |x: f64| place.x0 + x;
    let cell = |x0: f64, y0: f64, x1: f64, y1: f64| Rect::new(x(x0), y0, x(x1), y1);
    let cells = [
        ("General tolerances", &*keys.tolerances, cell(0.0, place.y0, 80.0, row(0.0))),
        ("Scale", scale, cell(80.0, place.y0, 110.0, row(0.0))),
        ("Size", size, cell(110.0, place.y0, 130.0, row(0.0))),
        ("Dimensions in", unit, cell(130.0, place.y0, 150.0, row(0.0))),
        ("Projection", "", cell(150.0, place.y0, 180.0, row(0.0))),
        ("Responsible department", &keys.department, cell(0.0, row(0.0), 40.0, row(1.0))),
        ("Technical reference", &keys.reference, cell(40.0, row(0.0), 80.0, row(1.0))),
        ("Document type", &keys.document, cell(80.0, row(0.0), 130.0, row(1.0))),
        ("Document status", &keys.status, cell(130.0, row(0.0), 180.0, row(1.0))),
        ("Created by", &keys.creator, cell(40.0, row(1.0), 80.0, row(2.0))),
        ("Approved by", &keys.approver, cell(40.0, row(2.0), 80.0, row(3.0))),
        ("", &keys.number, cell(130.0, row(1.0), 180.0, row(2.0))),
        ("Rev.", &keys.revision, cell(130.0, row(2.0), 140.0, row(3.0))),
        ("Date of issue", &keys.date, cell(140.0, row(2.0), 162.0, row(3.0))),
        ("Lang.", &keys.language, cell(162.0, row(2.0), 170.0, row(3.0))),
        ("Sheet", &keys.sheet, cell(170.0, row(2.0), 180.0, row(3.0))),
    ];
    for (name, value, cell) in cells {
        ink.rect(cell, NARROW);
        ink.word(name, Point::new(cell.x0 + 1.0, cell.y0 + 2.7), 1.8, Stand::Left, cell.width() - 2.0)?;
        ink.word(value, Point::new(cell.x0 + 1.0, cell.y1 - 1.6), 2.5, Stand::Left, cell.width() - 2.0)?;
    }
    let tall = [
        ("Legal owner", &*keys.owner, "", cell(0.0, row(1.0), 40.0, row(3.0))),
        ("Title, supplementary title", &*keys.title, &*keys.subtitle, cell(80.0, row(1.0), 130.0, row(3.0))),
    ];
    for (name, value, below, cell) in tall {
        ink.rect(cell, NARROW);
        let most = cell.width() - 2.0;
        ink.word(name, Point::new(cell.x0 + 1.0, cell.y0 + 2.7), 1.8, Stand::Left, most)?;
        ink.word(value, Point::new(cell.x0 + 1.0, cell.y0 + 9.5), 3.5, Stand::Left, most)?;
        ink.word(below, Point::new(cell.x0 + 1.0, cell.y0 + 15.0), 2.5, Stand::Left, most)?;
    }
    ink.word("Number", Point::new(x(131.0), row(1.0) + 2.7), 1.8, Stand::Left, 30.0)?;
    symbol(Point::new(x(170.0), place.y0 + STRIP / 2.0), method, ink);
    Ok(())
}

/// The symbol of first- or third-angle projection around a point: a cut cone from the side, and along its axis.
fn symbol(middle: Point, method: Method, ink: &mut Ink) {
    // Diameters of its ends, and its length: in the proportions of the standard, for letters of 2.5 mm.
    let (small, large, length) = (2.5, 5.0, 5.0);
    let (cone, rings) = match method {
        Method::First => (middle.x - 5.0, middle.x + 5.0),
        Method::Third => (middle.x + 5.0, middle.x - 5.0),
    };
    let [left, right] = [cone - length / 2.0, cone + length / 2.0];
    // The rings show it from the left, where it is thin.
    let [(x0, d0), (x1, d1)] = [(left, small), (right, large)];
    let at = |x: f64, y: f64| Point::new(x, middle.y + y);
    let mut outline = way(&[at(x0, -d0 / 2.0), at(x1, -d1 / 2.0), at(x1, d1 / 2.0), at(x0, d0 / 2.0)]);
    outline.close_path();
    ink.path(outline, WIDE, &[]);
    ink.circle(at(rings, 0.0), small / 2.0, WIDE);
    ink.circle(at(rings, 0.0), large / 2.0, WIDE);
    let reach = large / 2.0 + 1.5;
    let dash: Vec<f64> = CHAIN.iter().map(|part| part / 3.0).collect();
    ink.path(way(&[at(left - 1.5, 0.0), at(right + 1.5, 0.0)]), NARROW, &dash);
    ink.path(way(&[at(rings - reach, 0.0), at(rings + reach, 0.0)]), NARROW, &dash);
    ink.path(way(&[at(rings, -reach), at(rings, reach)]), NARROW, &dash);
}
