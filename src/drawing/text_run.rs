//! [`TextRun`]: the text that a mark outlines, for formats that embed fonts.

use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use kurbo::{Affine, Rect};

/// A font file and the metrics that a document needs to embed it. Lengths in ems, y up.
#[derive(Clone)]
pub struct FontFile {
    /// Bytes of the file.
    pub data: Arc<[u8]>,
    /// PostScript name, such as `ComicNeue-Bold`.
    pub name: String,
    /// Bounding box of all glyphs.
    pub bounds: Rect,
    /// Height above the baseline.
    pub ascent: f64,
    /// Depth below the baseline, negative.
    pub descent: f64,
    /// Height of capitals.
    pub cap_height: f64,
    /// Italic angle in degrees, negative if letters lean to the right.
    pub italic_deg: f64,
    /// Whether the font's licence flags allow embedding a subset. Otherwise documents contain outlines.
    pub embeddable: bool,
}

impl fmt::Debug for FontFile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "FontFile({}, {} bytes)", self.name, self.data.len())
    }
}

impl PartialEq for FontFile {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name && (Arc::ptr_eq(&self.data, &other.data) || self.data == other.data)
    }
}

/// A positioned glyph of a run. Lengths in ems of the font, y up.
#[derive(Debug, Clone, PartialEq)]
pub struct SetGlyph {
    /// Glyph id in the font.
    pub id: u16,
    /// Position from the start of the run.
    pub x: f64,
    /// Height above the baseline.
    pub y: f64,
    /// Advance width in the font.
    pub advance: f64,
    /// The bytes of the words that it shows; empty if the glyph before it shows them too.
    pub shows: Range<usize>,
}

/// Glyphs of one font on one line, from left to right.
#[derive(Debug, Clone, PartialEq)]
pub struct TextRun {
    /// The text in reading order.
    pub words: Arc<str>,
    /// The font.
    pub font: Arc<FontFile>,
    /// The glyphs.
    pub glyphs: Arc<[SetGlyph]>,
    /// Transform from ems (y up, origin at the start of the run) to user units.
    pub place: Affine,
}
