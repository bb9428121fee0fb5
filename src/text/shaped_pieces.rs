//! [`Pieces`]: stretches of a text that no line is broken in, shaped once each, with their measures.

use std::collections::BTreeMap;
use std::sync::Arc;

use kurbo::{Affine, Rect, Shape};

use super::bidi::{levels, runs_left};
use super::font_fallback::{Chain, Fallback, letters};
use super::shaping::glyphs_of;
use super::{Font, Setting};
use crate::drawing::SetGlyph;
use crate::error::Error;

/// Letters of one font and direction; lengths in ems of the font that was asked for.
#[derive(Debug, Clone)]
pub(crate) struct Run {
    pub font: Font,
    /// An em of its font.
    pub em: f64,
    /// Even ones run to the right, odd ones to the left.
    pub level: u8,
    pub words: String,
    /// From the left, in ems of its font.
    pub glyphs: Vec<SetGlyph>,
    pub width: f64,
    /// What is inked, y down from the line of writing, nothing if all are blanks.
    pub ink: Option<Rect>,
}

/// A stretch of text, without the blanks after it; lengths in ems.
#[derive(Debug, Clone, Default)]
pub(crate) struct Piece {
    pub runs: Vec<Run>,
    pub blanks: Vec<Run>,
    pub width: f64,
    pub blank_width: f64,
    /// How far ink reaches out to the left of its start, and to the right of its end.
    pub overhang: [f64; 2],
    /// How far ink reaches above the line of writing, and below it.
    pub reach: [f64; 2],
}

/// The pieces of a text.
pub(crate) struct Pieces<'a> {
    text: &'a str,
    setting: &'a Setting,
    chain: Chain,
    /// Of the character at each byte.
    levels: BTreeMap<usize, u8>,
    /// Whether the text as a whole runs to the left.
    pub runs_left: bool,
    known: BTreeMap<(usize, usize, bool), Arc<Piece>>,
}

impl<'a> Pieces<'a> {
    pub fn new(text: &'a str, setting: &'a Setting) -> Self {
        let runs_left = runs_left(text);
        let levels = levels(text, u8::from(runs_left));
        let levels = text.char_indices().map(|(at, _)| at).zip(levels).collect();
        let chain = Chain::new(&setting.font);
        Self { text, setting, chain, levels, runs_left, known: BTreeMap::new() }
    }

    /// The piece between two bytes of the text, with a hyphen behind it or none.
    pub fn piece(&mut self, from: usize, to: usize, hyphen: bool) -> Result<Arc<Piece>, Error> {
        if let Some(piece) = self.known.get(&(from, to, hyphen)) {
            return Ok(Arc::clone(piece));
        }
        let text = self.text.get(from..to).unwrap_or_default();
        let core = text.trim_end();
        let mut piece = Piece { runs: self.runs(from, core, hyphen)?, ..Piece::default() };
        piece.blanks = self.runs(from + core.len(), &text[core.len()..], false)?;
        let measured = |runs: &[Run]| runs.iter().map(|run| run.width).sum::<f64>();
        (piece.width, piece.blank_width) = (measured(&piece.runs), measured(&piece.blanks));
        let mut x = 0.0;
        let order = super::bidi::seen_order(&piece.runs.iter().map(|run| run.level).collect::<Vec<_>>());
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

    /// Letters that had to be taken from other fonts.
    pub fn fallbacks(&self) -> Vec<Fallback> {
        self.chain.fallbacks()
    }

    fn runs(&mut self, from: usize, text: &str, hyphen: bool) -> Result<Vec<Run>, Error> {
        let mut runs: Vec<(usize, u8, String)> = Vec::new();
        let mut last = u8::from(self.runs_left);
        let mut at = from;
        for letter in letters(text) {
            let level = self.levels.get(&at).copied().unwrap_or(last);
            at += letter.len();
            last = level;
            // Marks of where a word may be parted, line ends and tabs are no letters of their own.
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

    fn add(&mut self, runs: &mut Vec<(usize, u8, String)>, level: u8, cased: &str) -> Result<(), Error> {
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

    fn run(&self, number: usize, level: u8, words: String) -> Result<Run, Error> {
        let asked = &self.setting.font;
        let font = self.chain.fonts.get(number).unwrap_or(asked).clone();
        // Others are as high as the one that was asked for.
        let em = if number == 0 { 1.0 } else { asked.file().cap_height / font.file().cap_height };
        let language = self.setting.language.as_deref();
        let (mut glyphs, _) = glyphs_of(&font, &words, level % 2 == 1, language)?;
        let width = glyphs.pop().map_or(0.0, |end| end.x) * em;
        let boxes = glyphs.iter().filter_map(|glyph| {
            let outline = font.outline(glyph.id);
            let place = Affine::scale(em) * Affine::translate((glyph.x, -glyph.y));
            (!outline.elements().is_empty()).then(|| (place * outline).bounding_box())
        });
        let ink = boxes.reduce(|a, b| a.union(b));
        Ok(Run { font, em, level, words, glyphs, width, ink })
    }
}
