//! [`TextBlock`]: a text broken into lines, and the lines set below each other.
//!
//! 1. Lines are broken at given line breaks, greedily to a width, evenly to a width, or into an ellipse.
//! 2. The runs of each line are put in visual order and positioned.
//! 3. Marks are made from the glyph outlines, one for each stretch of one font and direction.

use std::sync::Arc;

use kurbo::{Affine, BezPath, Point, Rect, Vec2};
use unicode_bidi::{BidiInfo, Level};

use super::font_fallback::FontFallback;
use super::measured_text::MeasuredText;
use super::shaped_pieces::GlyphRun;
use super::{Align, Setting};
use crate::colour::srgb::Colour;
use crate::drawing::{Mark, Paint, Provenance, SetGlyph, TextRun};
use crate::error::{Error, ErrorKind};

/// Maximum length of a text, bytes.
const MAX_TEXT_BYTES: usize = 50_000;

/// Words are hyphenated if that shrinks the ellipse at least to this share.
const MAX_HYPHENATED_SIZE_RATIO: f64 = 0.85;

/// A line of a block. Lengths in user units, from the upper left corner of the block, y down.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct TextLine {
    /// The text in reading order.
    pub words: String,
    /// Left side.
    pub x: f64,
    /// Width, including overhanging ink.
    pub width: f64,
    /// y coordinate of the baseline.
    pub baseline: f64,
    /// Distance from the top of the line to the baseline. It is the same for all lines of a block, and covers
    /// all ink and the height of capitals.
    pub ascent: f64,
    /// Distance from the baseline to the lowest ink of the block.
    pub descent: f64,
    /// Offset from the left side to the first letter, and the runs from the left with their positions.
    start: f64,
    runs: Vec<(f64, GlyphRun)>,
}

impl TextLine {
    /// The bounding box.
    #[must_use]
    pub fn bounds(&self) -> Rect {
        Rect::new(self.x, self.baseline - self.ascent, self.x + self.width, self.baseline + self.descent)
    }
}

/// A text in lines. Lengths in user units, from its upper left corner, y down.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct TextBlock {
    /// The lines from top to bottom.
    pub lines: Vec<TextLine>,
    /// Width of the block.
    pub width: f64,
    /// Height, from the top of the first line to the bottom of the last one.
    pub height: f64,
    /// Letters that the font lacks, with the fonts that replace it.
    pub fallbacks: Vec<FontFallback>,
    em: f64,
}

impl TextBlock {
    /// Sets a text with its own line breaks only.
    ///
    /// # Errors
    /// Returns an error if no font has a glyph, or the text is too long.
    pub fn unbroken(text: &str, setting: &Setting) -> Result<Self, Error> {
        let text = trim_lines(text)?;
        let mut source = MeasuredText::new(&text, setting)?;
        let ends = source.greedy(f64::INFINITY, false).unwrap_or_default();
        set_lines(&mut source, &ends, None)
    }

    /// Sets a text in lines of at most `width` user units, each as full as possible. The block has that
    /// width.
    ///
    /// # Errors
    /// Returns an error if a word is too wide, no font has a glyph, or the text is too long.
    pub fn in_width(text: &str, setting: &Setting, width: f64) -> Result<Self, Error> {
        let text = trim_lines(text)?;
        let mut source = MeasuredText::new(&text, setting)?;
        let ends = source.greedy(width, true).map_err(|begin| source.word_too_wide_error(begin, width))?;
        set_lines(&mut source, &ends, Some(width))
    }

    /// Sets a text in the fewest lines of at most `width` user units, as even as possible.
    ///
    /// The widest line is as narrow as this number of lines allows. Words are hyphenated only if the text
    /// does not fit otherwise. The block is as wide as its widest line.
    ///
    /// # Errors
    /// Returns the same errors as [`TextBlock::in_width`].
    pub fn balanced(text: &str, setting: &Setting, width: f64) -> Result<Self, Error> {
        let text = trim_lines(text)?;
        let mut source = MeasuredText::new(&text, setting)?;
        let (parted, full) = match source.greedy(width, false) {
            Ok(ends) => (false, ends),
            Err(_) => {
                (true, source.greedy(width, true).map_err(|begin| source.word_too_wide_error(begin, width))?)
            }
        };
        source.check_search_size(full.len())?;
        let limit = source.in_ems(width);
        let mut cost = |source: &mut MeasuredText, _: usize, from: usize, to: usize| {
            let width = source.line_width(from, to)?;
            (width <= limit).then_some(width)
        };
        let ends = source.best_ends(full.len(), parted, &mut cost).map_or(full, |(_, ends)| ends);
        set_lines(&mut source, &ends, None)
    }

    /// Sets a text in the smallest ellipse around the centre of the block with height `aspect` times its
    /// width.
    ///
    /// The corners of all lines lie in the ellipse. Words are hyphenated if that saves much space. Also
    /// returns half the width and height of the ellipse.
    ///
    /// # Errors
    /// Returns an error if `aspect` is not positive, no font has a glyph, or the text is too long.
    pub fn in_ellipse(text: &str, setting: &Setting, aspect: f64) -> Result<(Self, Vec2), Error> {
        if !(aspect.is_finite() && aspect > 0.0) {
            return Err(Error::new(format!("an ellipse with aspect {aspect} is not possible"))
                .remedy("give a number above 0"));
        }
        let text = trim_lines(text)?;
        let mut source = MeasuredText::new(&text, setting)?;
        let mut best = source.smallest_ellipse(aspect, false)?;
        if source.breaks.iter().any(|place| place.hyphen) {
            let parted = source.smallest_ellipse(aspect, true)?;
            if parted.0 < best.0 * MAX_HYPHENATED_SIZE_RATIO {
                best = parted;
            }
        }
        let (radius, ends) = best;
        let block = set_lines(&mut source, &ends, None)?;
        let radius = radius * setting.em();
        Ok((block, Vec2::new(radius, radius * aspect)))
    }

    /// The bounding box.
    #[must_use]
    pub fn bounds(&self) -> Rect {
        Rect::new(0.0, 0.0, self.width, self.height)
    }

    /// The text of all lines, separated by line breaks.
    #[must_use]
    pub fn words(&self) -> String {
        self.lines.iter().map(|line| line.words.as_str()).collect::<Vec<_>>().join("\n")
    }

    /// The letters as filled outlines, with the upper left corner of the block at a point. There is one mark
    /// for each stretch of a line in one font and direction.
    #[must_use]
    pub fn marks(&self, corner: Point, colour: Colour) -> Vec<Mark> {
        self.lines.iter().flat_map(|line| self.marks_of(line, corner, colour)).collect()
    }

    fn marks_of(&self, line: &TextLine, corner: Point, colour: Colour) -> Vec<Mark> {
        let stretches = line.runs.chunk_by(|(_, a), (_, b)| a.font == b.font && a.level == b.level);
        stretches.filter_map(|runs| self.mark(line, runs, corner, colour)).collect()
    }

    fn mark(&self, line: &TextLine, runs: &[(f64, GlyphRun)], corner: Point, colour: Colour) -> Option<Mark> {
        let (begin, first) = runs.first()?;
        let x = corner.x + line.x + line.start + begin * self.em;
        let em = first.em * self.em;
        let place = Affine::new([em, 0.0, 0.0, -em, x, corner.y + line.baseline]);
        let mut glyphs: Vec<SetGlyph> = Vec::new();
        let mut path = BezPath::new();
        // Runs from right to left hold their words in reverse order.
        let leftward = first.level.is_rtl();
        let reading: Vec<&str> = {
            let words = runs.iter().map(|(_, run)| run.words.as_str());
            if leftward { words.rev().collect() } else { words.collect() }
        };
        let words: String = reading.concat();
        let mut before = if leftward { words.len() } else { 0 };
        for (at, run) in runs {
            if leftward {
                before -= run.words.len();
            }
            for glyph in &run.glyphs {
                let x = (at - begin) / run.em + glyph.x;
                let outline = run.font.outline(glyph.id);
                path.extend(place * Affine::new([1.0, 0.0, 0.0, -1.0, x, glyph.y]) * outline);
                let shows = glyph.shows.start + before..glyph.shows.end + before;
                glyphs.push(SetGlyph { x, shows, ..glyph.clone() });
            }
            if !leftward {
                before += run.words.len();
            }
        }
        if path.elements().is_empty() {
            return None;
        }
        let font = Arc::clone(first.font.file());
        let text = TextRun { words: Arc::from(words), font, glyphs: glyphs.into(), place };
        let provenance = Provenance { classes: vec!["text"], text: Some(text), ..Provenance::default() };
        Some(Mark { path, paint: Paint::Fill(colour), provenance })
    }
}

/// Trims the lines of a text; an error if it is too long or empty.
fn trim_lines(text: &str) -> Result<String, Error> {
    if text.len() > MAX_TEXT_BYTES {
        let message = format!("a text of {} bytes is too long to be set in one block", text.len());
        return Err(
            Error::new(message).remedy(format!("give at most {MAX_TEXT_BYTES} bytes, or several blocks"))
        );
    }
    let lines: Vec<&str> = text.trim().lines().map(str::trim).collect();
    if lines.iter().all(|line| line.is_empty()) {
        return Err(Error::new("the text has no letters").of_kind(ErrorKind::Empty));
    }
    Ok(lines.join("\n"))
}

/// Sets the lines that end at the given breaks. The block has the given width, or that of its widest line.
fn set_lines(source: &mut MeasuredText, ends: &[usize], width: Option<f64>) -> Result<TextBlock, Error> {
    source.take_fault()?;
    let em = source.setting.em();
    let mut begin = 0;
    let mut lines = Vec::with_capacity(ends.len());
    for (number, end) in ends.iter().enumerate() {
        let baseline = (source.reach[0] + number as f64 * source.setting.leading) * em;
        lines.push(set_line(source, begin, *end, baseline)?);
        begin = *end;
    }
    let widest = lines.iter().map(|line| line.width).fold(0.0, f64::max);
    let width = width.unwrap_or(widest);
    for line in &mut lines {
        line.x = match source.setting.align {
            Align::Left => 0.0,
            Align::Centre => (width - line.width) / 2.0,
            Align::Right => width - line.width,
        };
    }
    let height = lines.last().map_or(0.0, |line| line.baseline + line.descent);
    Ok(TextBlock { lines, width, height, fallbacks: source.pieces.fallbacks(), em })
}

/// Sets the line between two breaks.
fn set_line(source: &mut MeasuredText, from: usize, to: usize, baseline: f64) -> Result<TextLine, Error> {
    let em = source.setting.em();
    let mut runs: Vec<GlyphRun> = Vec::new();
    let mut overhang = 0.0;
    let parts = source.parts(from, to);
    for (number, (from, to, hyphen)) in parts.iter().enumerate() {
        let piece = source.pieces.piece(*from, *to, *hyphen)?;
        runs.extend(piece.runs.iter().cloned());
        let is_last = number + 1 == parts.len();
        if !is_last {
            runs.extend(piece.blanks.iter().cloned());
        }
        let is_leftmost = if source.pieces.runs_left { is_last } else { number == 0 };
        if is_leftmost {
            overhang = piece.overhang[0];
        }
    }
    let words = runs.iter().map(|run| run.words.as_str()).collect();
    let levels: Vec<Level> = runs.iter().map(|run| run.level).collect();
    let mut x = 0.0;
    let mut placed = Vec::with_capacity(runs.len());
    for number in BidiInfo::reorder_visual(&levels) {
        let run = runs[number].clone();
        let width = run.width;
        placed.push((x, run));
        x += width;
    }
    let width = source.measure_line(from, to)? * em;
    let [ascent, descent] = source.reach.map(|reach| reach * em);
    Ok(TextLine { words, x: 0.0, width, baseline, ascent, descent, start: overhang * em, runs: placed })
}
