//! [`Ink`]: lines and letters of a sheet, in mm.

use kurbo::{BezPath, Circle, Point, Rect, Shape, Vec2};

use crate::colour::srgb::Colour;
use crate::drawing::{
    Cap, Drawing, Join, Layer, LayerKind, Mark, Page, Paint, Provenance, StrokePaint, Unit,
};
use crate::error::Error;
use crate::text::{Align, Block, Font, Setting};

/// Widths of lines, mm (ISO 128-2, group 0.5): wide and narrow ones.
pub(crate) const WIDE: f64 = 0.5;
pub(crate) const NARROW: f64 = 0.25;

/// A long dash, a gap, a short dash, a gap, in mm, for narrow lines (ISO 128-2, line type 04.1).
pub(crate) const CHAIN: [f64; 4] = [6.0, 0.75, 0.13, 0.75];

/// Texts in tables are no longer than this, bytes.
const LONGEST: usize = 2000;

/// Where a word stands at its point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Stand {
    /// Begins there.
    Left,
    /// Has its middle there.
    Middle,
}

/// Lines and letters of a sheet, in mm.
#[derive(Debug, Clone)]
pub(crate) struct Ink {
    font: Font,
    class: &'static str,
    pub marks: Vec<Mark>,
}

impl Ink {
    /// Nothing yet; what is drawn has a class.
    pub fn new(font: &Font, class: &'static str) -> Self {
        Self { font: font.clone(), class, marks: Vec::new() }
    }

    /// Nothing yet, in the same font and class.
    pub fn emptied(&self) -> Self {
        Self { font: self.font.clone(), class: self.class, marks: Vec::new() }
    }

    fn provenance(&self) -> Provenance {
        Provenance { classes: vec![self.class], ..Provenance::default() }
    }

    /// A path of one width; no dashes is solid.
    pub fn path(&mut self, path: BezPath, width: f64, dash: &[f64]) {
        self.dashed(path, width, dash, 0.0);
    }

    /// The same with dashes that begin so far in.
    pub fn dashed(&mut self, path: BezPath, width: f64, dash: &[f64], dash_offset: f64) {
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

    /// A straight line.
    pub fn line(&mut self, a: Point, b: Point, width: f64) {
        self.path(way(&[a, b]), width, &[]);
    }

    /// A rectangle.
    pub fn rect(&mut self, rect: Rect, width: f64) {
        self.path(rect.to_path(TOLERANCE), width, &[]);
    }

    /// A circle.
    pub fn circle(&mut self, centre: Point, radius: f64, width: f64) {
        self.path(Circle::new(centre, radius).to_path(TOLERANCE), width, &[]);
    }

    /// A filled path.
    pub fn fill(&mut self, path: BezPath) {
        self.marks.push(Mark { path, paint: Paint::Fill(Colour::BLACK), provenance: self.provenance() });
    }

    /// A filled arrow of that length, with its tip at a point, that points in a direction.
    pub fn arrow(&mut self, tip: Point, towards: Vec2, length: f64) {
        let back = -towards * (length / towards.hypot2().sqrt());
        // 30 degrees wide (ISO 129-1).
        let side = Vec2::new(-back.y, back.x) * 0.268;
        let mut path = way(&[tip, tip + back + side, tip + back - side]);
        path.close_path();
        self.fill(path);
    }

    /// A word, whose capitals are so high, on a line of writing; smaller where it would be wider than `most`. Gives how wide it is.
    ///
    /// # Errors
    /// If no font has one of its letters.
    pub fn word(&mut self, words: &str, at: Point, high: f64, stand: Stand, most: f64) -> Result<f64, Error> {
        let Some((mut block, mut setting)) = self.set(words, high)? else { return Ok(0.0) };
        if block.width > most && most > 0.0 {
            setting = setting.with_capitals(high * most / block.width);
            block = Block::unbroken(words, &setting)?;
        }
        let aside = match stand {
            Stand::Left => 0.0,
            Stand::Middle => block.width / 2.0,
        };
        let baseline = block.lines.first().map_or(0.0, |line| line.baseline);
        self.marks.extend(block.marks(Point::new(at.x - aside, at.y - baseline), Colour::BLACK));
        Ok(block.width)
    }

    /// A text in lines no wider than so much, from its upper left corner. Gives how high it is.
    ///
    /// # Errors
    /// If no font has one of its letters, or a word is too wide.
    pub fn lines(&mut self, words: &str, corner: Point, high: f64, width: f64) -> Result<f64, Error> {
        let Some((_, setting)) = self.set(words, high)? else { return Ok(0.0) };
        let block = Block::in_width(words, &setting, width)?;
        self.marks.extend(block.marks(corner, Colour::BLACK));
        Ok(block.height)
    }

    /// Lines of a text within a width: broken between words where that is enough, else between letters.
    ///
    /// # Errors
    /// If no font has one of its letters.
    pub fn wrapped(&self, words: &str, high: f64, width: f64) -> Result<Vec<String>, Error> {
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
                // A word that is wider than the line.
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

    /// The largest of some heights of letters, which fall, at which the lines of a text fit, and these lines; the smallest where they fit
    /// at none.
    ///
    /// # Errors
    /// If no font has one of its letters, or the text is too long for any table.
    pub fn fitted(
        &self,
        words: &str,
        heights: &[f64],
        width: f64,
        fits: impl Fn(f64, usize) -> bool,
    ) -> Result<(f64, Vec<String>), Error> {
        if words.len() > LONGEST {
            return Err(Error::new(format!("a text of {} bytes is too long for a table", words.len()))
                .remedy(format!("write at most {LONGEST} bytes")));
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

    /// How wide a word is.
    ///
    /// # Errors
    /// If no font has one of its letters.
    pub fn width(&self, words: &str, high: f64) -> Result<f64, Error> {
        Ok(self.set(words, high)?.map_or(0.0, |(block, _)| block.width))
    }

    fn set(&self, words: &str, high: f64) -> Result<Option<(Block, Setting)>, Error> {
        if words.trim().is_empty() {
            return Ok(None);
        }
        let setting = Setting::new(self.font.clone()).with_capitals(high).aligned(Align::Left);
        Ok(Some((Block::unbroken(words, &setting)?, setting)))
    }

    /// All of it as a drawing of that size.
    pub fn drawing(self, title: &str, width: f64, height: f64) -> Drawing {
        let page = Page { width, height, unit: Unit::Mm, background: None };
        let layer = Layer { kind: LayerKind::Callouts, pen: None, ordered: true, marks: self.marks };
        Drawing::new(title, page, vec![layer])
    }
}

/// How near curves are to circles, mm.
const TOLERANCE: f64 = 1e-3;

/// The way through points.
pub(crate) fn way(points: &[Point]) -> BezPath {
    let mut path = BezPath::new();
    for (k, p) in points.iter().enumerate() {
        if k == 0 { path.move_to(*p) } else { path.line_to(*p) }
    }
    path
}
