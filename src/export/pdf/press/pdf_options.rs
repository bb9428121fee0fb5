//! Options of PDF pages: inks, standard, printer's marks.

use std::sync::Arc;

use super::halftone_screen::Screen;
use crate::colour::srgb::Colour;

/// Inks of a printed page.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Inks {
    /// RGB for screens, without inks.
    #[default]
    Screen,
    /// Black only, as dark as each colour looks.
    K,
    /// Cyan, magenta, yellow and black by the ICC profile of a press. Neutral colours are printed with black
    /// only.
    Cmyk(Arc<[u8]>),
}

/// A colour printed with a spot ink.
#[derive(Debug, Clone, PartialEq)]
pub struct Spot {
    /// The colour in the drawing, compared without opacity.
    pub colour: Colour,
    /// Name of the ink, such as `PANTONE 185 C`.
    pub name: String,
}

/// A standard for PDF files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Standard {
    /// PDF/X-4 (ISO 15930-7), for presses.
    X4,
    /// PDF/A-2b (ISO 19005-2), for archives.
    A2b,
}

/// Options of PDF pages.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct PdfOptions {
    /// Inks.
    pub inks: Inks,
    /// Colours printed with spot inks.
    pub spots: Vec<Spot>,
    /// Largest sum of all inks at one place, in percent. For [`Inks::Cmyk`] only.
    pub ink_limit: Option<f64>,
    /// ICC profile of the press, or of the screen for [`Inks::Screen`], written as the output intent.
    /// [`Inks::Cmyk`] has its own profile.
    pub profile: Option<Arc<[u8]>>,
    /// Largest lightness, as a share of white, that is printed as solid black. It applies to neutral colours,
    /// and to all colours with [`Inks::K`].
    pub solid_black: f64,
    /// Halftone screen: fills become dots of solid ink. For press inks only.
    pub screen: Option<Screen>,
    /// Whether crop marks and registration marks are printed outside the trimmed page.
    pub marks: bool,
    /// Standard to conform to.
    pub standard: Option<Standard>,
    /// Whether letters are outlines instead of embedded fonts.
    pub outlined: bool,
    /// Creation date required by standards. Default: `2000-01-01T00:00:00Z`. The current time would make
    /// every file different.
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
    /// Sets the inks.
    #[must_use]
    pub fn with_inks(mut self, inks: Inks) -> Self {
        self.inks = inks;
        self
    }

    /// Adds a colour printed with a spot ink.
    #[must_use]
    pub fn with_spot(mut self, colour: Colour, name: impl Into<String>) -> Self {
        self.spots.push(Spot { colour, name: name.into() });
        self
    }

    /// Limits the sum of all inks at one place, in percent.
    #[must_use]
    pub fn with_ink_limit(mut self, percent: f64) -> Self {
        self.ink_limit = Some(percent);
        self
    }

    /// Sets the ICC profile of the press or the screen.
    #[must_use]
    pub fn with_profile(mut self, profile: impl Into<Arc<[u8]>>) -> Self {
        self.profile = Some(profile.into());
        self
    }

    /// Prints fills as dots of solid ink: `lpi` rows per inch, with the black plate at `angle_deg` degrees.
    #[must_use]
    pub fn with_screen(mut self, lpi: f64, angle_deg: f64) -> Self {
        self.screen = Some(Screen { lpi, angle_deg });
        self
    }

    /// Adds crop marks and registration marks.
    #[must_use]
    pub fn with_marks(mut self) -> Self {
        self.marks = true;
        self
    }

    /// Sets the standard.
    #[must_use]
    pub fn with_standard(mut self, standard: Standard) -> Self {
        self.standard = Some(standard);
        self
    }

    /// Writes letters as outlines.
    #[must_use]
    pub fn outlined(mut self) -> Self {
        self.outlined = true;
        self
    }
}
