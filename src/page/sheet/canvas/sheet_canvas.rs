//! [`SheetCanvas`]: drawing surface of a technical sheet. It collects lines, shapes and texts as marks.
//!
//! Coordinates are in mm on the page, y down. All marks are black. Words are single lines set by
//! `crate::text`; texts for tables are wrapped, and shrunk if necessary.

use kurbo::{BezPath, Circle, Point, Rect, Shape, Vec2};

use crate::colour::srgb::Colour;
use crate::drawing::{
    Cap, Drawing, Join, Layer, LayerKind, Mark, Page, Paint, Provenance, StrokePaint, Unit,
};
use crate::error::Error;
use crate::geometry::plane::polyline_path::polyline;
use crate::page::tolerances::MAX_CIRCLE_ERROR_MM;
use crate::text::{Align, Font, Setting, TextBlock};

/// Widths of wide and narrow lines, mm (ISO 128-2, group 0.5).
pub(crate) const THICK_LINE_MM: f64 = 0.5;
pub(crate) const THIN_LINE_MM: f64 = 0.25;

/// Dash pattern of narrow chain lines: long dash, gap, short dash, gap, mm (ISO 128-2, line type 04.1).
pub(crate) const CHAIN_DASH_MM: [f64; 4] = [6.0, 0.75, 0.13, 0.75];

/// Maximum length of a text in a table, bytes.
const MAX_TABLE_TEXT_BYTES: usize = 2000;

/// Horizontal anchor of a word.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum WordAnchor {
    /// The word starts at the point.
    Left,
    /// The word is centred at the point.
    Middle,
}

/// Lines and words of a sheet as marks, in mm.
#[derive(Debug, Clone)]
pub(crate) struct SheetCanvas {
    font: Font,
    /// Class of all lines and shapes in the SVG file.
    class: &'static str,
    pub marks: Vec<Mark>,
}

impl SheetCanvas {
    /// An empty canvas; `class` becomes the class of all lines.
    pub(crate) fn new(font: &Font, class: &'static str) -> Self {
        Self { font: font.clone(), class, marks: Vec::new() }
    }

    /// An empty canvas with the same font and class.
    pub(crate) fn new_like(&self) -> Self {
        Self { font: self.font.clone(), class: self.class, marks: Vec::new() }
    }

    fn provenance(&self) -> Provenance {
        Provenance { classes: vec![self.class], ..Provenance::default() }
    }

    /// Adds a stroked path; an empty dash pattern means a solid line.
    pub(crate) fn path(&mut self, path: BezPath, width: f64, dash: &[f64]) {
        self.dashed(path, width, dash, 0.0);
    }

    /// Adds a stroked path whose dash pattern starts at an offset.
    pub(crate) fn dashed(&mut self, path: BezPath, width: f64, dash: &[f64], dash_offset: f64) {
        let paint = Paint::Stroke(StrokePaint {
            width,
            colour: Colour::BLACK,
            cap: Cap::Butt,
            join: Join::Miter,
            dash: dash.to_vec(),
            dash_offset,
        });
        self.marks.push(Mark { path, paint, provenance: self.provenance() });
    }

    /// Adds a straight line.
    pub(crate) fn line(&mut self, a: Point, b: Point, width: f64) {
        self.path(polyline(&[a, b]), width, &[]);
    }

    /// Adds the outline of a rectangle.
    pub(crate) fn rect(&mut self, rect: Rect, width: f64) {
        self.path(rect.to_path(MAX_CIRCLE_ERROR_MM), width, &[]);
    }

    /// Adds a circle.
    pub(crate) fn circle(&mut self, centre: Point, radius: f64, width: f64) {
        self.path(Circle::new(centre, radius).to_path(MAX_CIRCLE_ERROR_MM), width, &[]);
    }

    /// Adds a filled path.
    pub(crate) fn fill(&mut self, path: BezPath) {
        self.marks.push(Mark { path, paint: Paint::Fill(Colour::BLACK), provenance: self.provenance() });
    }

    /// Adds a filled arrow head with its tip at a point. It points in the direction `towards`.
    pub(crate) fn arrow(&mut self, tip: Point, towards: Vec2, length: f64) {
        let mut path = polyline(&arrow_corners(tip, towards, length));
        path.close_path();
        self.fill(path);
    }

    /// Adds a word with its baseline at a point and returns its width. `high` is the height of capitals. A
    /// word that would be wider than `most` is made smaller; 0 sets no limit.
    ///
    /// # Errors
    /// Returns an error if no font has a glyph.
    pub(crate) fn word(
        &mut self,
        words: &str,
        at: Point,
        high: f64,
        stand: WordAnchor,
        most: f64,
    ) -> Result<f64, Error> {
        let Some((mut block, mut setting)) = self.set(words, high)? else { return Ok(0.0) };
        if block.width > most && most > 0.0 {
            setting = setting.with_capitals(high * most / block.width);
            block = TextBlock::unbroken(words, &setting)?;
        }
        let aside = match stand {
            WordAnchor::Left => 0.0,
            WordAnchor::Middle => block.width / 2.0,
        };
        let baseline = block.lines.first().map_or(0.0, |line| line.baseline);
        self.marks.extend(block.marks(Point::new(at.x - aside, at.y - baseline), Colour::BLACK));
        Ok(block.width)
    }

    /// Adds a text broken into lines of at most `width` and returns its height. `corner` is the upper left
    /// corner.
    ///
    /// # Errors
    /// Returns an error if no font has a glyph, or a word is too wide.
    pub(crate) fn lines(&mut self, words: &str, corner: Point, high: f64, width: f64) -> Result<f64, Error> {
        let Some((_, setting)) = self.set(words, high)? else { return Ok(0.0) };
        let block = TextBlock::in_width(words, &setting, width)?;
        self.marks.extend(block.marks(corner, Colour::BLACK));
        Ok(block.height)
    }

    /// Breaks a text into lines of at most `width`, between words if possible, otherwise inside words.
    ///
    /// # Errors
    /// Returns an error if no font has a glyph.
    pub(crate) fn wrapped(&self, words: &str, high: f64, width: f64) -> Result<Vec<String>, Error> {
        let mut lines: Vec<String> = Vec::new();
        for paragraph in words.lines() {
            let mut line = String::new();
            for word in paragraph.split_whitespace() {
                let both = if line.is_empty() { word.to_owned() } else { format!("{line} {word}") };
                if self.width(&both, high)? <= width {
                    line = both;
                    continue;
                }
                lines.extend(Some(std::mem::take(&mut line)).filter(|line| !line.is_empty()));
                // The word alone is wider than the line, so it is broken between letters.
                for c in word.chars() {
                    let longer = format!("{line}{c}");
                    if !line.is_empty() && self.width(&longer, high)? > width {
                        lines.push(std::mem::replace(&mut line, c.to_string()));
                    } else {
                        line = longer;
                    }
                }
            }
            lines.extend(Some(line).filter(|line| !line.is_empty()));
        }
        Ok(lines)
    }

    /// The first of `heights` that fits a text, with its lines; the last one if none fits. `heights` must
    /// descend. `fits` takes a height and the number of lines.
    ///
    /// # Errors
    /// Returns an error if no font has a glyph, or the text is too long for any table.
    pub(crate) fn fitted(
        &self,
        words: &str,
        heights: &[f64],
        width: f64,
        fits: impl Fn(f64, usize) -> bool,
    ) -> Result<(f64, Vec<String>), Error> {
        if words.len() > MAX_TABLE_TEXT_BYTES {
            return Err(Error::new(format!("a text of {} bytes is too long for a table", words.len()))
                .remedy(format!("write at most {MAX_TABLE_TEXT_BYTES} bytes")));
        }
        let mut found = (0.0, Vec::new());
        for high in heights {
            found = (*high, self.wrapped(words, *high, width)?);
            if fits(*high, found.1.len()) {
                break;
            }
        }
        Ok(found)
    }

    /// The width of a word, mm.
    ///
    /// # Errors
    /// Returns an error if no font has a glyph.
    pub(crate) fn width(&self, words: &str, high: f64) -> Result<f64, Error> {
        Ok(self.set(words, high)?.map_or(0.0, |(block, _)| block.width))
    }

    /// Sets a word as one line with capitals of height `high`; `None` if it is blank.
    fn set(&self, words: &str, high: f64) -> Result<Option<(TextBlock, Setting)>, Error> {
        if words.trim().is_empty() {
            return Ok(None);
        }
        let setting = Setting::new(self.font.clone()).with_capitals(high).aligned(Align::Left);
        Ok(Some((TextBlock::unbroken(words, &setting)?, setting)))
    }

    /// All marks as a drawing of the given size.
    pub(crate) fn drawing(self, title: &str, width: f64, height: f64) -> Drawing {
        let page = Page { width, height, unit: Unit::Mm, background: None };
        let layer = Layer { kind: LayerKind::Callouts, pen: None, ordered: true, marks: self.marks };
        Drawing::new(title, page, vec![layer])
    }
}

/// The corners of an arrow head, from its tip, which points in the direction `towards`.
pub(crate) fn arrow_corners(tip: Point, towards: Vec2, length: f64) -> [Point; 3] {
    let back = -towards * (length / towards.hypot2().sqrt().max(f64::MIN_POSITIVE));
    // 30 degrees opening angle (ISO 129-1): 0.268 = tan 15°.
    let side = Vec2::new(-back.y, back.x) * 0.268;
    [tip, tip + back + side, tip + back - side]
}
