//! The title block, with a strip for scale, size, unit, tolerances and the projection symbol above it.
//!
//! Source: ISO 7200:2004 (width of the block, names and lengths of fields); ISO 5456-2:1996, 5 (the
//! projection symbol, a truncated cone).

use kurbo::{Point, Rect};
use serde::Deserialize;

use crate::error::Error;
use crate::page::page_source::Source;
use crate::page::sheet::canvas::sheet_canvas::{CHAIN, Ink, NARROW, Stand, WIDE, way};
use crate::page::sheet::view::projection_method::Method;
use crate::text::Font;

/// Width of the title block, mm.
pub const WIDTH: f64 = 180.0;

/// Height of a row, and of the strip above the block, mm.
const ROW: f64 = 9.0;
const STRIP: f64 = 10.0;

/// Letter heights in one-row fields (`LOW`) and two-row fields (`TALL`), preferred first, mm (ISO 3098).
const LOW: [f64; 4] = [2.5, 2.2, 2.0, SMALLEST];
const TALL: [f64; 6] = [3.5, 3.0, 2.5, 2.2, 2.0, SMALLEST];
const SMALLEST: f64 = 1.8;

/// Line pitch and descent, as multiples of the letter height.
const PITCH: f64 = 1.5;
const DESCENT: f64 = 0.35;

/// Space for the name of a field, below its text, and at its sides, mm.
const NAMES: f64 = 3.4;
const UNDER: f64 = 0.6;
const ASIDE: f64 = 1.0;

/// Maximum height of the block as a share of the sheet's height.
const HIGHEST: f64 = 0.4;

/// The texts of a title block.
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
    /// Sheet number and number of sheets: `1/3`.
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

/// A field of the block: its name, the key of its text, its columns from and to (mm), its rows from and to.
type Field<'a> = (&'a str, &'a str, [f64; 2], [usize; 2]);

/// The fields with texts from the page file.
fn fields(keys: &TitleKeys) -> [(Field<'static>, &String); 14] {
    [
        (("General tolerances", "tolerances", [0.0, 80.0], [0, 1]), &keys.tolerances),
        (("Responsible department", "department", [0.0, 40.0], [1, 2]), &keys.department),
        (("Technical reference", "reference", [40.0, 80.0], [1, 2]), &keys.reference),
        (("Document type", "document", [80.0, 130.0], [1, 2]), &keys.document),
        (("Document status", "status", [130.0, 180.0], [1, 2]), &keys.status),
        (("Created by", "creator", [40.0, 80.0], [2, 3]), &keys.creator),
        (("Approved by", "approver", [40.0, 80.0], [3, 4]), &keys.approver),
        (("Number", "number", [130.0, 180.0], [2, 3]), &keys.number),
        (("Rev.", "revision", [130.0, 140.0], [3, 4]), &keys.revision),
        (("Date of issue", "date", [140.0, 162.0], [3, 4]), &keys.date),
        (("Lang.", "language", [162.0, 170.0], [3, 4]), &keys.language),
        (("Sheet", "sheet", [170.0, 180.0], [3, 4]), &keys.sheet),
        (("Legal owner", "owner", [0.0, 40.0], [2, 4]), &keys.owner),
        (("Title, supplementary title", "title", [80.0, 130.0], [2, 4]), &keys.title),
    ]
}

/// Letter height in mm, and the lines of a text.
type Lines = (f64, Vec<String>);

/// Height of some lines, including the descent of the last one.
fn height((high, lines): &Lines) -> f64 {
    if lines.is_empty() { 0.0 } else { high * (PITCH * (lines.len() - 1) as f64 + 1.0 + DESCENT) }
}

/// A title block with its place; rows are high enough for their texts.
pub(crate) struct TitleBlock {
    pub place: Rect,
    /// The y coordinates of the row borders.
    rows: [f64; 5],
    /// For each field its text, and the supplementary title below it.
    texts: Vec<(Field<'static>, Lines, Lines)>,
}

impl TitleBlock {
    /// Sets the title block in the lower right corner of a drawing space.
    ///
    /// # Errors
    /// Returns an error if no font has a glyph, or a text is too long for the sheet.
    pub fn new(keys: &TitleKeys, space: Rect, font: &Font, source: &Source) -> Result<Self, Error> {
        let ink = Ink::new(font, "title-block");
        let mut rows = [STRIP, ROW, ROW, ROW];
        let mut texts = Vec::new();
        for (field, text) in fields(keys) {
            let (_, key, [x0, x1], [from, to]) = field;
            let width = x1 - x0 - 2.0 * ASIDE;
            let is_tall = to - from > 1;
            let heights: &[f64] = if is_tall { &TALL } else { &LOW };
            let below = if key == "title" { &*keys.subtitle } else { "" };
            let room = rows[from..to].iter().sum::<f64>() - NAMES - UNDER;
            let about = |key: &'static str, text: &'_ String| {
                let text = text.clone();
                move |error: Error| {
                    source.about_text([&text], error.within(format!("`{key}` of the title block")))
                }
            };
            let below = ink
                .fitted(below, &LOW, width, |high, lines| {
                    lines < 2 || height(&(high, vec![String::new(); lines])) < 4.0
                })
                .map_err(about("subtitle", &keys.subtitle))?;
            let left = room - if below.1.is_empty() { 0.0 } else { height(&below) + UNDER };
            let fits = |high: f64, lines: usize| height(&(high, vec![String::new(); lines])) <= left + 1e-9;
            let own = ink.fitted(text, heights, width, fits).map_err(about(key, text))?;
            // The last row of the field grows if the smallest letters do not fit.
            let needed = height(&own) - left;
            if needed > 0.0 {
                rows[to - 1] += needed;
            }
            texts.push((field, own, below));
        }
        let whole: f64 = rows.iter().sum();
        if whole > HIGHEST * space.height() {
            let longest = fields(keys).into_iter().max_by_key(|(_, text)| text.len());
            let (key, text) = longest.map_or(("title", &keys.title), |((_, key, ..), text)| (key, text));
            let error =
                Error::new(format!("the text of `{key}` in the title block is too long for this sheet"))
                    .remedy("shorten it, or choose a larger size");
            return Err(source.about_text([text], error));
        }
        let place = Rect::new(space.x1 - WIDTH, space.y1 - whole, space.x1, space.y1);
        let mut ends = [place.y0; 5];
        for k in 0..4 {
            ends[k + 1] = ends[k] + rows[k];
        }
        Ok(Self { place, rows: ends, texts })
    }

    fn cell(&self, [x0, x1]: [f64; 2], [from, to]: [usize; 2]) -> Rect {
        Rect::new(self.place.x0 + x0, self.rows[from], self.place.x0 + x1, self.rows[to])
    }

    /// Draws the block with the scale, the projection symbol, the name of the size and the unit of
    /// dimensions.
    ///
    /// # Errors
    /// Returns an error if no font has a glyph.
    pub fn draw(
        &self,
        (scale, method, size, unit): (&str, Method, &str, &str),
        ink: &mut Ink,
    ) -> Result<(), Error> {
        ink.rect(self.place, WIDE);
        let one = |text: &str| (LOW[0], vec![text.to_owned()]);
        let none = || (LOW[0], Vec::new());
        let own: [(Field, Lines, Lines); 4] = [
            (("Scale", "", [80.0, 110.0], [0, 1]), one(scale), none()),
            (("Size", "", [110.0, 130.0], [0, 1]), one(size), none()),
            (("Dimensions in", "", [130.0, 150.0], [0, 1]), one(unit), none()),
            (("Projection", "", [150.0, 180.0], [0, 1]), none(), none()),
        ];
        for ((name, _, columns, rows), text, below) in own.iter().chain(&self.texts) {
            let cell = self.cell(*columns, *rows);
            ink.rect(cell, NARROW);
            let left = cell.x0 + ASIDE;
            ink.word(name, Point::new(left, cell.y0 + 2.7), SMALLEST, Stand::Left, 0.0)?;
            // Texts of one line share a baseline above the bottom of their row.
            let is_low = rows[1] - rows[0] == 1;
            let mut y = if is_low && text.1.len() < 2 {
                cell.y1 - 1.6
            } else if is_low {
                cell.y0 + NAMES + text.0 + 0.2
            } else if text.1.len() < 2 {
                cell.y0 + 9.5
            } else {
                cell.y0 + NAMES + text.0 + 0.5
            };
            for line in &text.1 {
                ink.word(line, Point::new(left, y), text.0, Stand::Left, 0.0)?;
                y += PITCH * text.0;
            }
            y += below.0 + text.0 * DESCENT + UNDER - if text.1.is_empty() { 0.0 } else { PITCH * text.0 };
            for line in &below.1 {
                ink.word(line, Point::new(left, y), below.0, Stand::Left, 0.0)?;
                y += PITCH * below.0;
            }
        }
        symbol(Point::new(self.place.x0 + 170.0, self.place.y0 + STRIP / 2.0), method, ink);
        Ok(())
    }
}

/// Draws the projection symbol around a point: a truncated cone from the side and along its axis.
fn symbol(middle: Point, method: Method, ink: &mut Ink) {
    // Diameters of the ends and length, in the proportions of the standard for letters of 2.5 mm.
    let (small, large, length) = (2.5, 5.0, 5.0);
    let (cone, rings) = match method {
        Method::First => (middle.x - 5.0, middle.x + 5.0),
        Method::Third => (middle.x + 5.0, middle.x - 5.0),
    };
    let [left, right] = [cone - length / 2.0, cone + length / 2.0];
    // The circles show the cone from the left, from its small end.
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
