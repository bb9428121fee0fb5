//! [`Setting`]: font, size, leading, alignment and language of a text.

use super::Font;

/// Letter size, in user units of the page.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LetterSize {
    /// Em size of the font.
    Em(f64),
    /// Height of capitals, as usual on technical drawings.
    Capitals(f64),
}

/// Alignment of the lines in a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Align {
    /// Aligned left.
    Left,
    /// Centred.
    #[default]
    Centre,
    /// Aligned right.
    Right,
}

/// Settings of a text.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Setting {
    /// The font. Letters that it lacks are taken from the bundled fonts.
    pub font: Font,
    /// Letter size.
    pub size: LetterSize,
    /// Distance between baselines, in ems.
    pub leading: f64,
    /// Alignment of lines.
    pub align: Align,
    /// Whether all letters are upper case.
    pub upper_case: bool,
    /// Language for hyphenation and upper case, two letters of ISO 639-1. `None` disables hyphenation.
    pub language: Option<String>,
}

impl Setting {
    /// Settings with an em of 1 unit, centred lines and a leading of 1.2.
    #[must_use]
    pub fn new(font: Font) -> Self {
        let (size, align) = (LetterSize::Em(1.0), Align::Centre);
        Self { font, size, leading: 1.2, align, upper_case: false, language: None }
    }

    /// Sets the em size, in user units.
    #[must_use]
    pub fn with_em(mut self, em: f64) -> Self {
        self.size = LetterSize::Em(em);
        self
    }

    /// Sets the height of capitals, in user units.
    #[must_use]
    pub fn with_capitals(mut self, height: f64) -> Self {
        self.size = LetterSize::Capitals(height);
        self
    }

    /// Sets the distance between baselines, in ems.
    #[must_use]
    pub fn with_leading(mut self, ems: f64) -> Self {
        self.leading = ems;
        self
    }

    /// Sets the alignment of lines.
    #[must_use]
    pub fn aligned(mut self, align: Align) -> Self {
        self.align = align;
        self
    }

    /// Sets all letters to upper case.
    #[must_use]
    pub fn upper_case(mut self) -> Self {
        self.upper_case = true;
        self
    }

    /// Sets the language for hyphenation, two letters of ISO 639-1.
    #[must_use]
    pub fn in_language(mut self, code: &str) -> Self {
        self.language = Some(code.to_owned());
        self
    }

    /// Em size in user units.
    #[must_use]
    pub fn em(&self) -> f64 {
        match self.size {
            LetterSize::Em(em) => em,
            LetterSize::Capitals(height) => height / self.font.file().cap_height,
        }
    }

    /// The text in upper case, if that is set.
    pub(crate) fn cased(&self, text: &str) -> String {
        if !self.upper_case {
            return text.to_owned();
        }
        match self.language.as_deref() {
            Some("tr" | "az") => text.replace('i', "İ").replace('ı', "I").to_uppercase(),
            _ => text.to_uppercase(),
        }
    }
}
