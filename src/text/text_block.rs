//! [`Block`]: a text broken into lines that are set one below the other.

use std::sync::Arc;

use kurbo::{Affine, BezPath, Point, Rect, Vec2};

use super::bidi::seen_order;
use super::font_fallback::Fallback;
use super::measured_text::Source;
use super::shaped_pieces::Run;
use super::{Align, Setting};
use crate::colour::srgb::Colour;
use crate::drawing::{Mark, Paint, Provenance, SetGlyph, TextRun};
use crate::error::{Error, ErrorKind};

/// Longer texts are no blocks, bytes.
const LONGEST: usize = 50_000;

/// How much smaller an ellipse must get before words are parted for it.
const WORTH_PARTING: f64 = 0.85;

/// A line of a block; lengths in user units, from the upper left corner of the block, y down.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Line {
    /// What it says, in reading order.
    pub words: String,
    /// Its left side.
    pub x: f64,
    /// Its width, all ink included.
    pub width: f64,
    /// The line of writing.
    pub baseline: f64,
    /// From the top of the line to the line of writing; of all lines of a block alike: no ink is higher, and neither are capitals.
    pub ascent: f64,
    /// From the line of writing to the lower end of the lowest letter of the block.
    pub descent: f64,
    /// From its left side to where its first letter stands, and the runs, from the left, with where they stand.
    start: f64,
    runs: Vec<(f64, Run)>,
}

impl Line {
    /// The box around it.
    #[must_use]
    pub fn bounds(&self) -> Rect {
        Rect::new(self.x, self.baseline - self.ascent, self.x + self.width, self.baseline + self.descent)
    }
}

/// A text in lines; lengths in user units, from its upper left corner, y down.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Block {
    /// The lines, from the top.
    pub lines: Vec<Line>,
    /// Its width.
    pub width: f64,
    /// Its height, from the top of the first line to the lower end of the last.
    pub height: f64,
    /// Letters that the font lacks, and which one they were taken from.
    pub fallbacks: Vec<Fallback>,
    em: f64,
}

impl Block {
    /// A text in lines as they are written, however long.
    ///
    /// # Errors
    /// Returns an error if no font has a letter, or the text is too long.
    pub fn unbroken(text: &str, setting: &Setting) -> Result<Self, Error> {
        let text = tidied(text)?;
        let mut source = Source::new(&text, setting)?;
        let ends = source.greedy(f64::INFINITY, false).unwrap_or_default();
        set(&mut source, &ends, None)
    }

    /// A text in lines no wider than a width in user units, each as full as can be. The block is as wide as that.
    ///
    /// # Errors
    /// Returns an error that names a word which is too wide, or if no font has a letter, or the text is too long.
    pub fn in_width(text: &str, setting: &Setting, width: f64) -> Result<Self, Error> {
        let text = tidied(text)?;
        let mut source = Source::new(&text, setting)?;
        let ends = source.greedy(width, true).map_err(|begin| source.too_wide(begin, width))?;
        set(&mut source, &ends, Some(width))
    }

    /// A text in lines no wider than a width in user units, as few as can be, and those as even as can be: the widest is as narrow as
    /// so many lines allow. Words are parted only where the text does not fit otherwise. The block is as wide as its widest line.
    ///
    /// # Errors
    /// Returns an error as [`Block::in_width`] does.
    pub fn balanced(text: &str, setting: &Setting, width: f64) -> Result<Self, Error> {
        let text = tidied(text)?;
        let mut source = Source::new(&text, setting)?;
        let (parted, full) = match source.greedy(width, false) {
            Ok(ends) => (false, ends),
            Err(_) => (true, source.greedy(width, true).map_err(|begin| source.too_wide(begin, width))?),
        };
        source.refuse_many(full.len())?;
        let limit = source.in_ems(width);
        let mut cost = |source: &mut Source, _: usize, from: usize, to: usize| {
            let width = source.line_width(from, to)?;
            (width <= limit).then_some(width)
        };
        let ends = source.best(full.len(), parted, &mut cost).map_or(full, |(_, ends)| ends);
        set(&mut source, &ends, None)
    }

    /// A text in lines whose corners all lie in an ellipse around the middle of the block, the smallest that is `aspect` times as high
    /// as wide, and half the width and height of that ellipse. Words are parted where that saves a lot.
    ///
    /// # Errors
    /// Returns an error if no font has a letter, or the text is too long.
    pub fn in_ellipse(text: &str, setting: &Setting, aspect: f64) -> Result<(Self, Vec2), Error> {
        if !(aspect.is_finite() && aspect > 0.0) {
            return Err(Error::new(format!("an ellipse with aspect {aspect} is not possible"))
                .remedy("give a number above 0"));
        }
        let text = tidied(text)?;
        let mut source = Source::new(&text, setting)?;
        let mut best = source.smallest_ellipse(aspect, false)?;
        if source.breaks.iter().any(|place| place.hyphen) {
            let parted = source.smallest_ellipse(aspect, true)?;
            if parted.0 < best.0 * WORTH_PARTING {
                best = parted;
            }
        }
        let (radius, ends) = best;
        let block = set(&mut source, &ends, None)?;
        let radius = radius * setting.em();
        Ok((block, Vec2::new(radius, radius * aspect)))
    }

    /// The box around it.
    #[must_use]
    pub fn bounds(&self) -> Rect {
        Rect::new(0.0, 0.0, self.width, self.height)
    }

    /// What it says, line by line.
    #[must_use]
    pub fn words(&self) -> String {
        self.lines.iter().map(|line| line.words.as_str()).collect::<Vec<_>>().join("\n")
    }

    /// Its letters with its upper left corner at a point: filled outlines, one mark for each stretch of a line in one font, with the
    /// words beside them.
    #[must_use]
    pub fn marks(&self, corner: Point, colour: Colour) -> Vec<Mark> {
        self.lines.iter().flat_map(|line| self.marks_of(line, corner, colour)).collect()
    }

    fn marks_of(&self, line: &Line, corner: Point, colour: Colour) -> Vec<Mark> {
        let stretches = line.runs.chunk_by(|(_, a), (_, b)| a.font == b.font && a.level == b.level);
        stretches.filter_map(|runs| self.mark(line, runs, corner, colour)).collect()
    }

    fn mark(&self, line: &Line, runs: &[(f64, Run)], corner: Point, colour: Colour) -> Option<Mark> {
        let (begin, first) = runs.first()?;
        let x = corner.x + line.x + line.start + begin * self.em;
        let em = first.em * self.em;
        let place = Affine::new([em, 0.0, 0.0, -em, x, corner.y + line.baseline]);
        let mut glyphs: Vec<SetGlyph> = Vec::new();
        let mut path = BezPath::new();
        // Words are read from the right where letters run there.
        let leftward = first.level % 2 == 1;
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

/// A text without blanks around its lines.
fn tidied(text: &str) -> Result<String, Error> {
    if text.len() > LONGEST {
        let message = format!("a text of {} bytes is too long to be set in one block", text.len());
        return Err(Error::new(message).remedy(format!("give at most {LONGEST} bytes, or several blocks")));
    }
    let lines: Vec<&str> = text.trim().lines().map(str::trim).collect();
    if lines.iter().all(|line| line.is_empty()) {
        return Err(Error::new("the text has no letters").of_kind(ErrorKind::Empty));
    }
    Ok(lines.join("\n"))
}

/// The block of lines that end at those breaks, as wide as asked for or as its widest line.
fn set(source: &mut Source, ends: &[usize], width: Option<f64>) -> Result<Block, Error> {
    source.take_fault()?;
    let em = source.setting.em();
    let mut begin = 0;
    let mut lines = Vec::with_capacity(ends.len());
    for (number, end) in ends.iter().enumerate() {
        let baseline = (source.reach[0] + number as f64 * source.setting.leading) * em;
        lines.push(line(source, begin, *end, baseline)?);
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
    Ok(Block { lines, width, height, fallbacks: source.pieces.fallbacks(), em })
}

/// The line between two breaks.
fn line(source: &mut Source, from: usize, to: usize, baseline: f64) -> Result<Line, Error> {
    let em = source.setting.em();
    let mut runs: Vec<Run> = Vec::new();
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
    let levels: Vec<u8> = runs.iter().map(|run| run.level).collect();
    let mut x = 0.0;
    let mut placed = Vec::with_capacity(runs.len());
    for number in seen_order(&levels) {
        let run = runs[number].clone();
        let width = run.width;
        placed.push((x, run));
        x += width;
    }
    let width = source.measured(from, to)? * em;
    let [ascent, descent] = source.reach.map(|reach| reach * em);
    Ok(Line { words, x: 0.0, width, baseline, ascent, descent, start: overhang * em, runs: placed })
}
