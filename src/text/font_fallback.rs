//! Which font has which letter: the one that was asked for, and those that stand in for it.

use std::collections::BTreeMap;
use std::fmt;

use unicode_linebreak::{BreakClass, break_property};

use super::Font;
use super::shaping::glyphs_of;
use crate::error::Error;

/// A letter that a font lacks, and the font that it was taken from.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Fallback {
    /// The letter, with the marks on it.
    pub letter: String,
    /// The font that was asked for.
    pub asked: String,
    /// The font that has it.
    pub used: String,
}

impl fmt::Display for Fallback {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { letter, asked, used } = self;
        write!(f, "the font {asked} has no {}; {used} is used", spelled(letter))
    }
}

/// A letter and its code: `` `Ω` (U+03A9) ``.
fn spelled(letter: &str) -> String {
    let codes: Vec<String> = letter.chars().map(|c| format!("U+{:04X}", c as u32)).collect();
    format!("`{letter}` ({})", codes.join(" "))
}

/// The fonts of a text, the one that was asked for first.
pub(crate) struct Chain {
    pub fonts: Vec<Font>,
    /// The number of the font of each letter that was asked for.
    known: BTreeMap<String, usize>,
}

impl Chain {
    pub fn new(asked: &Font) -> Self {
        Self { fonts: vec![asked.clone()], known: BTreeMap::new() }
    }

    /// Adds the fonts that come with the project.
    fn add_others(&mut self) -> Result<(), Error> {
        for name in Font::names() {
            let font = Font::named(name)?;
            if !self.fonts.contains(&font) {
                self.fonts.push(font);
            }
        }
        Ok(())
    }

    /// The number of the first font that has a letter with its marks.
    pub fn font_of(&mut self, letter: &str) -> Result<usize, Error> {
        if let Some(number) = self.known.get(letter) {
            return Ok(*number);
        }
        let has = |font: &Font| {
            let glyphs = glyphs_of(font, letter, false, None);
            glyphs.is_ok_and(|(glyphs, whole)| whole && glyphs.len() > 1)
        };
        // What is not seen is in every font.
        let unseen = letter.chars().all(|c| c.is_control() || c.is_whitespace() && c != '\u{3000}');
        let mut number = if unseen { Some(0) } else { self.fonts.iter().position(has) };
        if number.is_none() && self.fonts.len() == 1 {
            self.add_others()?;
            number = self.fonts.iter().position(has);
        }
        if number.is_none() && letter.starts_with(char::REPLACEMENT_CHARACTER) {
            // What stands for letters that could not be read is drawn as the box that fonts have for letters they lack.
            let has_box = |font: &Font| !font.outline(0).elements().is_empty();
            number = Some(self.fonts.iter().position(has_box).unwrap_or_default());
        }
        let Some(number) = number else {
            let names: Vec<&str> = self.fonts.iter().map(Font::name).collect();
            let message =
                format!("the letter {} is in none of the fonts {}", spelled(letter), names.join(", "));
            return Err(
                Error::new(message).remedy("name a font file with this letter, or write another letter")
            );
        };
        self.known.insert(letter.to_owned(), number);
        Ok(number)
    }

    /// The letters that were not in the font that was asked for.
    pub fn fallbacks(&self) -> Vec<Fallback> {
        let name =
            |number: usize| self.fonts.get(number).map(|font| font.name().to_owned()).unwrap_or_default();
        let others = self.known.iter().filter(|(_, number)| **number > 0);
        others
            .map(|(letter, number)| Fallback { letter: letter.clone(), asked: name(0), used: name(*number) })
            .collect()
    }
}

/// The letters of a text, each with the marks that stand on it.
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
