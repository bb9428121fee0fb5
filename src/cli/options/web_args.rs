//! Options for drawings in web pages.

use clap::Args;
use clap::builder::PossibleValuesParser;

/// Older value of `--ink`, replaced by `--current-colour`.
const CURRENT_COLOUR: &str = "currentColor";

/// Options for drawings in web pages, and the inks of PDF.
#[derive(Debug, Clone, Default, Args)]
pub(crate) struct WebArgs {
    /// Add an invisible SVG area per named part that reacts to the pointer; with --title or --desc, a button
    #[arg(long, help_heading = "Output")]
    pub(crate) hotspots: bool,

    /// Title, also for screen readers [default: MODEL's name]
    #[arg(long, value_name = "TEXT", help_heading = "Output")]
    pub(crate) title: Option<String>,

    /// Description in SVG, for screen readers
    #[arg(long, value_name = "TEXT", help_heading = "Output")]
    pub(crate) desc: Option<String>,

    /// Draw what has the pen's colour in the text colour of the web page (SVG currentColor)
    #[arg(long, alias = "current-color", help_heading = "Output")]
    current_colour: bool,

    /// PDF inks: screen (RGB), k (black only) or cmyk (four inks, with --icc) [default: screen]
    #[arg(long, value_name = "INKS", help_heading = "Print", ignore_case = true, hide_possible_values = true,
        value_parser = PossibleValuesParser::new(["screen", "k", "cmyk", CURRENT_COLOUR]))]
    ink: Option<String>,
}

impl WebArgs {
    /// Whether the pen's colour becomes the text colour of the web page.
    pub(crate) fn uses_current_colour(&self) -> bool {
        let is_ink = self.ink.as_deref().is_some_and(|ink| ink.eq_ignore_ascii_case(CURRENT_COLOUR));
        self.current_colour || is_ink
    }

    /// Inks of PDF output, if given.
    #[cfg(feature = "pdf")]
    pub(crate) fn pdf_inks(&self) -> Option<&str> {
        self.ink.as_deref().filter(|ink| !ink.eq_ignore_ascii_case(CURRENT_COLOUR))
    }
}
