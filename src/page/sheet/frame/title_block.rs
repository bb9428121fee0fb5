//! The title block, with a strip for scale, size, unit, tolerances and the projection symbol above it.
//!
//! Source: ISO 7200:2004 (width of the block, names and lengths of fields); ISO 5456-2:1996, 5 (the
//! projection symbol, a truncated cone).

use kurbo::{Point, Rect};
use serde::Deserialize;

use crate::error::Error;
use crate::geometry::plane::polyline_path::polyline;
use crate::page::page_source::PageSource;
use crate::page::sheet::canvas::sheet_canvas::{
    CHAIN_DASH_MM, SheetCanvas, THICK_LINE_MM, THIN_LINE_MM, WordAnchor,
};
use crate::page::sheet::view::projection_method::ProjectionMethod;
use crate::page::tolerances::LENGTH_ROUNDING_MM;
use crate::text::Font;

/// Width of the title block, mm.
pub(crate) const BLOCK_WIDTH_MM: f64 = 180.0;

/// Height of a row, and of the strip above the block, mm.
const ROW_HEIGHT_MM: f64 = 9.0;
const STRIP_HEIGHT_MM: f64 = 10.0;

/// Letter heights in one-row fields (`ROW_LETTER_HEIGHTS_MM`) and two-row fields
/// (`FIELD_LETTER_HEIGHTS_MM`), preferred first, mm (ISO 3098).
const ROW_LETTER_HEIGHTS_MM: [f64; 4] = [2.5, 2.2, 2.0, MIN_LETTER_HEIGHT_MM];
const FIELD_LETTER_HEIGHTS_MM: [f64; 6] = [3.5, 3.0, 2.5, 2.2, 2.0, MIN_LETTER_HEIGHT_MM];
const MIN_LETTER_HEIGHT_MM: f64 = 1.8;

/// Line pitch and descent, as multiples of the letter height.
const LINE_PITCH: f64 = 1.5;
const DESCENT_SHARE: f64 = 0.35;

/// Space for the name of a field, below its text, and at its sides, mm.
const NAME_HEIGHT_MM: f64 = 3.4;
const BOTTOM_PADDING_MM: f64 = 0.6;
const SIDE_PADDING_MM: f64 = 1.0;

/// Maximum height of the block as a share of the sheet's height.
const MAX_HEIGHT_SHARE: f64 = 0.4;

/// The texts of a title block.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct TitleKeys {
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
type TitleField<'a> = (&'a str, &'a str, [f64; 2], [usize; 2]);

/// The fields with texts from the page file.
fn title_fields(keys: &TitleKeys) -> [(TitleField<'static>, &String); 14] {
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
type FittedLines = (f64, Vec<String>);

/// Height of some lines, including the descent of the last one.
fn text_height((high, lines): &FittedLines) -> f64 {
    if lines.is_empty() { 0.0 } else { high * (LINE_PITCH * (lines.len() - 1) as f64 + 1.0 + DESCENT_SHARE) }
}

/// A title block with its place; rows are high enough for their texts.
pub(crate) struct TitleBlock {
    pub place: Rect,
    /// The y coordinates of the row borders.
    rows: [f64; 5],
    /// For each field its text, and the supplementary title below it.
    texts: Vec<(TitleField<'static>, FittedLines, FittedLines)>,
}

impl TitleBlock {
    /// Sets the title block in the lower right corner of a drawing space.
    ///
    /// # Errors
    /// Returns an error if no font has a glyph, or a text is too long for the sheet.
    pub(crate) fn new(
        keys: &TitleKeys,
        space: Rect,
        font: &Font,
        source: &PageSource,
    ) -> Result<Self, Error> {
        let ink = SheetCanvas::new(font, "title-block");
        let mut rows = [STRIP_HEIGHT_MM, ROW_HEIGHT_MM, ROW_HEIGHT_MM, ROW_HEIGHT_MM];
        let mut texts = Vec::new();
        for (field, text) in title_fields(keys) {
            let (_, key, [x0, x1], [from, to]) = field;
            let width = x1 - x0 - 2.0 * SIDE_PADDING_MM;
            let is_tall = to - from > 1;
            let heights: &[f64] = if is_tall { &FIELD_LETTER_HEIGHTS_MM } else { &ROW_LETTER_HEIGHTS_MM };
            let below = if key == "title" { &*keys.subtitle } else { "" };
            let room = rows[from..to].iter().sum::<f64>() - NAME_HEIGHT_MM - BOTTOM_PADDING_MM;
            let about = |key: &'static str, text: &'_ String| {
                let text = text.clone();
                move |error: Error| {
                    source.about_text([&text], error.within(format!("`{key}` of the title block")))
                }
            };
            let below = ink
                .fitted(below, &ROW_LETTER_HEIGHTS_MM, width, |high, lines| {
                    lines < 2 || text_height(&(high, vec![String::new(); lines])) < 4.0
                })
                .map_err(about("subtitle", &keys.subtitle))?;
            let left = room - if below.1.is_empty() { 0.0 } else { text_height(&below) + BOTTOM_PADDING_MM };
            let fits = |high: f64, lines: usize| {
                text_height(&(high, vec![String::new(); lines])) <= left + LENGTH_ROUNDING_MM
            };
            let own = ink.fitted(text, heights, width, fits).map_err(about(key, text))?;
            // The last row of the field grows if the smallest letters do not fit.
            let needed = text_height(&own) - left;
            if needed > 0.0 {
                rows[to - 1] += needed;
            }
            texts.push((field, own, below));
        }
        let whole: f64 = rows.iter().sum();
        if whole > MAX_HEIGHT_SHARE * space.height() {
            let longest = title_fields(keys).into_iter().max_by_key(|(_, text)| text.len());
            let (key, text) = longest.map_or(("title", &keys.title), |((_, key, ..), text)| (key, text));
            let error =
                Error::new(format!("the text of `{key}` in the title block is too long for this sheet"))
                    .remedy("shorten it, or choose a larger size");
            return Err(source.about_text([text], error));
        }
        let place = Rect::new(space.x1 - BLOCK_WIDTH_MM, space.y1 - whole, space.x1, space.y1);
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
    pub(crate) fn draw(
        &self,
        (scale, method, size, unit): (&str, ProjectionMethod, &str, &str),
        ink: &mut SheetCanvas,
    ) -> Result<(), Error> {
        ink.rect(self.place, THICK_LINE_MM);
        let one = |text: &str| (ROW_LETTER_HEIGHTS_MM[0], vec![text.to_owned()]);
        let none = || (ROW_LETTER_HEIGHTS_MM[0], Vec::new());
        let own: [(TitleField, FittedLines, FittedLines); 4] = [
            (("Scale", "", [80.0, 110.0], [0, 1]), one(scale), none()),
            (("Size", "", [110.0, 130.0], [0, 1]), one(size), none()),
            (("Dimensions in", "", [130.0, 150.0], [0, 1]), one(unit), none()),
            (("Projection", "", [150.0, 180.0], [0, 1]), none(), none()),
        ];
        for ((name, _, columns, rows), text, below) in own.iter().chain(&self.texts) {
            let cell = self.cell(*columns, *rows);
            ink.rect(cell, THIN_LINE_MM);
            let left = cell.x0 + SIDE_PADDING_MM;
            ink.word(name, Point::new(left, cell.y0 + 2.7), MIN_LETTER_HEIGHT_MM, WordAnchor::Left, 0.0)?;
            // Texts of one line share a baseline above the bottom of their row.
            let is_low = rows[1] - rows[0] == 1;
            let mut y = if is_low && text.1.len() < 2 {
                cell.y1 - 1.6
            } else if is_low {
                cell.y0 + NAME_HEIGHT_MM + text.0 + 0.2
            } else if text.1.len() < 2 {
                cell.y0 + 9.5
            } else {
                cell.y0 + NAME_HEIGHT_MM + text.0 + 0.5
            };
            for line in &text.1 {
                ink.word(line, Point::new(left, y), text.0, WordAnchor::Left, 0.0)?;
                y += LINE_PITCH * text.0;
            }
            y += below.0 + text.0 * DESCENT_SHARE + BOTTOM_PADDING_MM
                - if text.1.is_empty() { 0.0 } else { LINE_PITCH * text.0 };
            for line in &below.1 {
                ink.word(line, Point::new(left, y), below.0, WordAnchor::Left, 0.0)?;
                y += LINE_PITCH * below.0;
            }
        }
        draw_projection_symbol(
            Point::new(self.place.x0 + 170.0, self.place.y0 + STRIP_HEIGHT_MM / 2.0),
            method,
            ink,
        );
        Ok(())
    }
}

/// Draws the projection symbol around a point: a truncated cone from the side and along its axis.
fn draw_projection_symbol(middle: Point, method: ProjectionMethod, ink: &mut SheetCanvas) {
    // Diameters of the ends and length, in the proportions of the standard for letters of 2.5 mm.
    let (small, large, length) = (2.5, 5.0, 5.0);
    let (cone, rings) = match method {
        ProjectionMethod::First => (middle.x - 5.0, middle.x + 5.0),
        ProjectionMethod::Third => (middle.x + 5.0, middle.x - 5.0),
    };
    let [left, right] = [cone - length / 2.0, cone + length / 2.0];
    // The circles show the cone from the left, from its small end.
    let [(x0, d0), (x1, d1)] = [(left, small), (right, large)];
    let at = |x: f64, y: f64| Point::new(x, middle.y + y);
    let mut outline = polyline(&[at(x0, -d0 / 2.0), at(x1, -d1 / 2.0), at(x1, d1 / 2.0), at(x0, d0 / 2.0)]);
    outline.close_path();
    ink.path(outline, THICK_LINE_MM, &[]);
    ink.circle(at(rings, 0.0), small / 2.0, THICK_LINE_MM);
    ink.circle(at(rings, 0.0), large / 2.0, THICK_LINE_MM);
    let reach = large / 2.0 + 1.5;
    let dash: Vec<f64> = CHAIN_DASH_MM.iter().map(|part| part / 3.0).collect();
    ink.path(polyline(&[at(left - 1.5, 0.0), at(right + 1.5, 0.0)]), THIN_LINE_MM, &dash);
    ink.path(polyline(&[at(rings - reach, 0.0), at(rings + reach, 0.0)]), THIN_LINE_MM, &dash);
    ink.path(polyline(&[at(rings, -reach), at(rings, reach)]), THIN_LINE_MM, &dash);
}
