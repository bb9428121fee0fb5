//! [`TextRun`]: the words that a mark's outline shows, for files that keep letters with their font.

use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use kurbo::{Affine, Rect};

/// A font as a file holds it, and what one must know of it to put it into a document. Lengths are in ems, y up.
#[derive(Clone)]
pub struct FontFile {
    /// The bytes of the file.
    pub data: Arc<[u8]>,
    /// The font's PostScript name, such as `ComicNeue-Bold`.
    pub name: String,
    /// Around all letters.
    pub bounds: Rect,
    /// How far letters reach above the line of writing.
    pub ascent: f64,
    /// How far they reach below it, negative.
    pub descent: f64,
    /// Height of capitals.
    pub cap_height: f64,
    /// How far the letters lean, degrees, negative to the right.
    pub italic_deg: f64,
    /// Whether the licence that the font tells of lets documents hold parts of it; others show outlines.
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

/// A letter of a run: a glyph of its font. Lengths are in ems of the font, y up.
#[derive(Debug, Clone, PartialEq)]
pub struct SetGlyph {
    /// Its number in the font.
    pub id: u16,
    /// Where it stands, from the start of the run.
    pub x: f64,
    /// How far above the line of writing.
    pub y: f64,
    /// How far the font itself goes on after it.
    pub advance: f64,
    /// The bytes of the words it shows; empty if the glyph before shows them as well.
    pub shows: Range<usize>,
}

/// Letters of one font on one line, from left to right as they are seen.
#[derive(Debug, Clone, PartialEq)]
pub struct TextRun {
    /// What they say, in reading order.
    pub words: Arc<str>,
    /// Their font.
    pub font: Arc<FontFile>,
    /// The letters.
    pub glyphs: Arc<[SetGlyph]>,
    /// From ems, y up, the start of the run at (0, 0), to user units.
    pub place: Affine,
}
