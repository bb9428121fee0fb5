//! [`PdfOptions`]: how pages are written as PDF: inks, standard, marks for the printer.

use std::sync::Arc;

use super::halftone_screen::Screen;
use crate::colour::srgb::Colour;

/// The inks that a page is printed with.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Inks {
    /// None: colours of screens, RGB.
    #[default]
    Screen,
    /// Black alone, as dark as the colours look.
    K,
    /// Cyan, magenta, yellow and black, as the profile of a press says (ICC). Colours without hue are printed with black alone.
    Cmyk(Arc<[u8]>),
}

/// A colour that is printed with an ink of its own.
#[derive(Debug, Clone, PartialEq)]
pub struct Spot {
    /// The colour in the drawing; its opacity is its own.
    pub colour: Colour,
    /// The name of the ink, such as `PANTONE 185 C`.
    pub name: String,
}

/// A standard that a file keeps to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Standard {
    /// PDF/X-4 (ISO 15930-7), for presses.
    X4,
    /// PDF/A-2b (ISO 19005-2), for archives.
    A2b,
}

/// How pages are written.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct PdfOptions {
    /// The inks.
    pub inks: Inks,
    /// Colours with inks of their own.
    pub spots: Vec<Spot>,
    /// All inks of a place together, percent of one; only of [`Inks::Cmyk`].
    pub ink_limit: Option<f64>,
    /// The profile of the press, or of the screen for [`Inks::Screen`], that the file says it is made for (ICC). [`Inks::Cmyk`] has its
    /// own.
    pub profile: Option<Arc<[u8]>>,
    /// Colours without hue that are no lighter, as 0 to 1 of white, are printed as solid black, and so are all such ones of
    /// [`Inks::K`].
    pub solid_black: f64,
    /// A half-tone screen: fills are dots of solid ink; only of the inks of a press.
    pub screen: Option<Screen>,
    /// Whether crop marks and registration marks are printed outside the trimmed page.
    pub marks: bool,
    /// The standard.
    pub standard: Option<Standard>,
    /// Whether letters are outlines, without fonts.
    pub outlined: bool,
    /// The moment that standards want to be told, `2000-01-01T00:00:00Z` by default: with the clock's no two files were alike.
    pub date: [u16; 6],
}

impl Default for PdfOptions {
    fn default() -> Self {
        Self {
            inks: Inks::Screen,
            spots: Vec::new(),
            ink_limit: None,
            profile: None,
            solid_black: 0.11,
            screen: None,
            marks: false,
            standard: None,
            outlined: false,
            date: [2000, 1, 1, 0, 0, 0],
        }
    }
}

impl PdfOptions {
    /// Printed with those inks.
    #[must_use]
    pub fn with_inks(mut self, inks: Inks) -> Self {
        self.inks = inks;
        self
    }

    /// A colour printed with an ink of its own.
    #[must_use]
    pub fn with_spot(mut self, colour: Colour, name: impl Into<String>) -> Self {
        self.spots.push(Spot { colour, name: name.into() });
        self
    }

    /// No more ink on a place than so many percent.
    #[must_use]
    pub fn with_ink_limit(mut self, percent: f64) -> Self {
        self.ink_limit = Some(percent);
        self
    }

    /// Made for the press, or the screen, of that profile.
    #[must_use]
    pub fn with_profile(mut self, profile: impl Into<Arc<[u8]>>) -> Self {
        self.profile = Some(profile.into());
        self
    }

    /// With fills as dots of solid ink, so many rows an inch, at that angle of the black plate in degrees.
    #[must_use]
    pub fn with_screen(mut self, lpi: f64, angle_deg: f64) -> Self {
        self.screen = Some(Screen { lpi, angle_deg });
        self
    }

    /// With crop marks and registration marks.
    #[must_use]
    pub fn with_marks(mut self) -> Self {
        self.marks = true;
        self
    }

    /// Keeping to a standard.
    #[must_use]
    pub fn with_standard(mut self, standard: Standard) -> Self {
        self.standard = Some(standard);
        self
    }

    /// With letters as outlines.
    #[must_use]
    pub fn outlined(mut self) -> Self {
        self.outlined = true;
        self
    }
}
