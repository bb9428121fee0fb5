//! Font fallback: chooses a font for each letter, the requested one or a bundled one.
//!
//! A font has a letter if shaping yields no missing glyph, combining marks included. Bundled fonts are loaded
//! only when the requested font lacks a letter.

use std::collections::BTreeMap;
use std::fmt;

use unicode_linebreak::{BreakClass, break_property};

use super::Font;
use super::shaping::shape_glyphs;
use crate::error::Error;

/// A letter that the requested font lacks, and the font that replaces it.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct FontFallback {
    /// The letter with its combining marks.
    pub letter: String,
    /// The requested font.
    pub requested: String,
    /// The font that has the letter.
    pub used: String,
}

impl fmt::Display for FontFallback {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { letter, requested: asked, used } = self;
        write!(f, "the font {asked} has no {}; {used} is used", quoted_with_code(letter))
    }
}

/// Formats a letter with its code points: `` `Ω` (U+03A9) ``.
fn quoted_with_code(letter: &str) -> String {
    let codes: Vec<String> = letter.chars().map(|c| format!("U+{:04X}", c as u32)).collect();
    format!("`{letter}` ({})", codes.join(" "))
}

/// The fonts of a text, the requested one first.
pub(crate) struct FontChain {
    pub fonts: Vec<Font>,
    /// Cache: the index of the font for each letter.
    known: BTreeMap<String, usize>,
}

impl FontChain {
    pub(crate) fn new(asked: &Font) -> Self {
        Self { fonts: vec![asked.clone()], known: BTreeMap::new() }
    }

    /// Adds the bundled fonts.
    fn add_others(&mut self) -> Result<(), Error> {
        for name in Font::names() {
            let font = Font::named(name)?;
            if !self.fonts.contains(&font) {
                self.fonts.push(font);
            }
        }
        Ok(())
    }

    /// The index of the first font that has a letter with its combining marks.
    pub(crate) fn font_of(&mut self, letter: &str) -> Result<usize, Error> {
        if let Some(number) = self.known.get(letter) {
            return Ok(*number);
        }
        let has = |font: &Font| {
            let glyphs = shape_glyphs(font, letter, false, None);
            glyphs.is_ok_and(|(glyphs, whole)| whole && glyphs.len() > 1)
        };
        // Invisible characters need no glyph.
        let unseen = letter.chars().all(|c| c.is_control() || c.is_whitespace() && c != '\u{3000}');
        let mut number = if unseen { Some(0) } else { self.fonts.iter().position(has) };
        if number.is_none() && self.fonts.len() == 1 {
            self.add_others()?;
            number = self.fonts.iter().position(has);
        }
        if number.is_none() && letter.starts_with(char::REPLACEMENT_CHARACTER) {
            // The replacement character is drawn as the font's box for missing glyphs.
            let has_box = |font: &Font| !font.outline(0).elements().is_empty();
            number = Some(self.fonts.iter().position(has_box).unwrap_or_default());
        }
        let Some(number) = number else {
            let names: Vec<&str> = self.fonts.iter().map(Font::name).collect();
            let message = format!(
                "the letter {} is in none of the fonts {}",
                quoted_with_code(letter),
                names.join(", ")
            );
            return Err(
                Error::new(message).remedy("name a font file with this letter, or write another letter")
            );
        };
        self.known.insert(letter.to_owned(), number);
        Ok(number)
    }

    /// The letters that the requested font lacks.
    pub(crate) fn fallbacks(&self) -> Vec<FontFallback> {
        let name =
            |number: usize| self.fonts.get(number).map(|font| font.name().to_owned()).unwrap_or_default();
        let others = self.known.iter().filter(|(_, number)| **number > 0);
        others
            .map(|(letter, number)| FontFallback {
                letter: letter.clone(),
                requested: name(0),
                used: name(*number),
            })
            .collect()
    }
}

/// Splits a text into letters with their combining marks.
pub(crate) fn letters(text: &str) -> Vec<&str> {
    let joins = |c: char| {
        let class = break_property(c as u32);
        matches!(class, BreakClass::CombiningMark | BreakClass::ZeroWidthJoiner)
    };
    let mut found = Vec::new();
    let mut begin = 0;
    let mut joined = true;
    for (at, c) in text.char_indices() {
        if at > begin && !joins(c) && !joined {
            found.push(&text[begin..at]);
            begin = at;
        }
        joined = c == '\u{200d}';
    }
    if begin < text.len() {
        found.push(&text[begin..]);
    }
    found
}
