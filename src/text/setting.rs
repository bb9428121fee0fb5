//! [`Setting`]: how a text is set: its font, size, leading, alignment, language.

use super::Font;

/// How large letters are, in user units of the page.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Size {
    /// The em of the font.
    Em(f64),
    /// The height of capitals, which drawings of machines are lettered by.
    Capitals(f64),
}

/// Where the lines of a block stand.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Align {
    /// At its left side.
    Left,
    /// In its middle.
    #[default]
    Centre,
    /// At its right side.
    Right,
}

/// How a text is set.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Setting {
    /// The font. Letters that it lacks are taken from the fonts that come with the project.
    pub font: Font,
    /// Size of the letters.
    pub size: Size,
    /// From one line of writing to the next, in ems.
    pub leading: f64,
    /// Where lines stand.
    pub align: Align,
    /// Whether all letters are capitals.
    pub upper_case: bool,
    /// The language, as two letters of ISO 639-1: words are parted where it parts them, and `i` is capital as it writes it. With none
    /// words stay whole.
    pub language: Option<String>,
}

impl Setting {
    /// Letters of a font whose em is a unit, in lines that are centred and 1.2 ems apart.
    #[must_use]
    pub fn new(font: Font) -> Self {
        let (size, align) = (Size::Em(1.0), Align::Centre);
        Self { font, size, leading: 1.2, align, upper_case: false, language: None }
    }

    /// Letters with an em of so many units.
    #[must_use]
    pub fn with_em(mut self, em: f64) -> Self {
        self.size = Size::Em(em);
        self
    }

    /// Letters whose capitals are so many units high.
    #[must_use]
    pub fn with_capitals(mut self, height: f64) -> Self {
        self.size = Size::Capitals(height);
        self
    }

    /// Lines so many ems apart.
    #[must_use]
    pub fn with_leading(mut self, ems: f64) -> Self {
        self.leading = ems;
        self
    }

    /// Lines that stand there.
    #[must_use]
    pub fn aligned(mut self, align: Align) -> Self {
        self.align = align;
        self
    }

    /// All letters as capitals.
    #[must_use]
    pub fn upper_case(mut self) -> Self {
        self.upper_case = true;
        self
    }

    /// Words of that language, as two letters of ISO 639-1, parted where it parts them.
    #[must_use]
    pub fn in_language(mut self, code: &str) -> Self {
        self.language = Some(code.to_owned());
        self
    }

    /// The em in user units.
    #[must_use]
    pub fn em(&self) -> f64 {
        match self.size {
            Size::Em(em) => em,
            Size::Capitals(height) => height / self.font.file().cap_height,
        }
    }

    /// A text as its letters are set.
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
