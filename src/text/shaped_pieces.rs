//! [`ShapedPieces`]: the unbreakable pieces of a text, each shaped and measured once.
//!
//! 1. The letters of a piece are grouped into runs of one font and one embedding level.
//! 2. Each run is shaped, and its ink is measured from the outlines.
//! 3. The piece keeps its width, and how far its ink extends past it on all sides.

use std::collections::BTreeMap;
use std::sync::Arc;

use kurbo::{Affine, Rect, Shape};
use unicode_bidi::{BidiInfo, Direction, Level, get_base_direction_full};

use super::font_fallback::{FontChain, FontFallback, letters};
use super::shaping::shape_glyphs;
use super::{Font, Setting};
use crate::drawing::SetGlyph;
use crate::error::Error;

/// Glyphs of one font and direction. Lengths in ems of the requested font.
#[derive(Debug, Clone)]
pub(crate) struct GlyphRun {
    pub font: Font,
    /// Em of its font, in ems of the requested font.
    pub em: f64,
    /// Embedding level (UAX 9): even levels run to the right, odd ones to the left.
    pub level: Level,
    pub words: String,
    /// Glyphs from the left, in ems of their font.
    pub glyphs: Vec<SetGlyph>,
    pub width: f64,
    /// Bounding box of the ink, y down from the baseline; `None` for blanks.
    pub ink: Option<Rect>,
}

/// An unbreakable piece of text, and the blanks after it. Lengths in ems.
#[derive(Debug, Clone, Default)]
pub(crate) struct ShapedPiece {
    pub runs: Vec<GlyphRun>,
    pub blanks: Vec<GlyphRun>,
    pub width: f64,
    pub blank_width: f64,
    /// Ink outside the advance width, on the left and on the right.
    pub overhang: [f64; 2],
    /// Ink above and below the baseline.
    pub reach: [f64; 2],
}

/// Shapes the pieces of a text and caches them.
pub(crate) struct ShapedPieces<'a> {
    text: &'a str,
    setting: &'a Setting,
    chain: FontChain,
    /// Embedding level of the character at each byte.
    levels: Vec<Level>,
    /// Whether the base direction is right to left.
    pub runs_left: bool,
    known: BTreeMap<(usize, usize, bool), Arc<ShapedPiece>>,
}

impl<'a> ShapedPieces<'a> {
    pub(crate) fn new(text: &'a str, setting: &'a Setting) -> Self {
        let runs_left = get_base_direction_full(text) == Direction::Rtl;
        let levels = BidiInfo::new(text, Some(base_level(runs_left))).levels;
        let chain = FontChain::new(&setting.font);
        Self { text, setting, chain, levels, runs_left, known: BTreeMap::new() }
    }

    /// The piece between two bytes of the text, with or without a hyphen at its end.
    pub(crate) fn piece(&mut self, from: usize, to: usize, hyphen: bool) -> Result<Arc<ShapedPiece>, Error> {
        if let Some(piece) = self.known.get(&(from, to, hyphen)) {
            return Ok(Arc::clone(piece));
        }
        let text = self.text.get(from..to).unwrap_or_default();
        let core = text.trim_end();
        let mut piece = ShapedPiece { runs: self.runs(from, core, hyphen)?, ..ShapedPiece::default() };
        piece.blanks = self.runs(from + core.len(), &text[core.len()..], false)?;
        let measured = |runs: &[GlyphRun]| runs.iter().map(|run| run.width).sum::<f64>();
        (piece.width, piece.blank_width) = (measured(&piece.runs), measured(&piece.blanks));
        let mut x = 0.0;
        let order = BidiInfo::reorder_visual(&piece.runs.iter().map(|run| run.level).collect::<Vec<_>>());
        for run in order.into_iter().filter_map(|number| piece.runs.get(number)) {
            if let Some(ink) = run.ink {
                let [left, right] = &mut piece.overhang;
                *left = left.max(-(x + ink.x0));
                *right = right.max(x + ink.x1 - piece.width);
                let [above, below] = &mut piece.reach;
                *above = above.max(-ink.y0);
                *below = below.max(ink.y1);
            }
            x += run.width;
        }
        let piece = Arc::new(piece);
        self.known.insert((from, to, hyphen), Arc::clone(&piece));
        Ok(piece)
    }

    /// The letters that the requested font lacks.
    pub(crate) fn fallbacks(&self) -> Vec<FontFallback> {
        self.chain.fallbacks()
    }

    fn runs(&mut self, from: usize, text: &str, hyphen: bool) -> Result<Vec<GlyphRun>, Error> {
        let mut runs: Vec<(usize, Level, String)> = Vec::new();
        let mut last = base_level(self.runs_left);
        let mut at = from;
        for letter in letters(text) {
            let level = self.levels.get(at).copied().unwrap_or(last);
            at += letter.len();
            last = level;
            // Soft hyphens and zero-width spaces are dropped; control characters become blanks.
            let plain: String = letter
                .chars()
                .filter(|c| *c != '\u{ad}' && *c != '\u{200b}')
                .map(|c| if c.is_control() { ' ' } else { c })
                .collect();
            if !plain.is_empty() {
                let cased = self.setting.cased(&plain);
                self.add(&mut runs, level, &cased)?;
            }
        }
        if hyphen {
            self.add(&mut runs, last, "-")?;
        }
        runs.into_iter().map(|(font, level, words)| self.run(font, level, words)).collect()
    }

    fn add(
        &mut self,
        runs: &mut Vec<(usize, Level, String)>,
        level: Level,
        cased: &str,
    ) -> Result<(), Error> {
        for letter in letters(cased) {
            let font = self.chain.font_of(letter)?;
            match runs.last_mut() {
                Some((last, its_level, words)) if *last == font && *its_level == level => {
                    words.push_str(letter)
                }
                _ => runs.push((font, level, letter.to_owned())),
            }
        }
        Ok(())
    }

    fn run(&self, number: usize, level: Level, words: String) -> Result<GlyphRun, Error> {
        let asked = &self.setting.font;
        let font = self.chain.fonts.get(number).unwrap_or(asked).clone();
        // Fallback fonts are scaled to the height of capitals of the requested font.
        let em = if number == 0 { 1.0 } else { asked.file().cap_height / font.file().cap_height };
        let language = self.setting.language.as_deref();
        let (mut glyphs, _) = shape_glyphs(&font, &words, level.is_rtl(), language)?;
        let width = glyphs.pop().map_or(0.0, |end| end.x) * em;
        let boxes = glyphs.iter().filter_map(|glyph| {
            let outline = font.outline(glyph.id);
            let place = Affine::scale(em) * Affine::translate((glyph.x, -glyph.y));
            (!outline.elements().is_empty()).then(|| (place * outline).bounding_box())
        });
        let ink = boxes.reduce(|a, b| a.union(b));
        Ok(GlyphRun { font, em, level, words, glyphs, width, ink })
    }
}

/// The embedding level of a paragraph.
fn base_level(runs_left: bool) -> Level {
    if runs_left { Level::rtl() } else { Level::ltr() }
}
