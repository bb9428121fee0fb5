//! Options of drawings that are put into web pages.

use clap::Args;
use clap::builder::PossibleValuesParser;

/// What a web page needs of a drawing.
#[derive(Debug, Clone, Default, Args)]
pub(super) struct WebArgs {
    /// Lay an area over each part that is not painted, but answers the pointer in web pages and has the part's name, in SVG; with --title or --desc it is a button
    #[arg(long, help_heading = "Output")]
    pub(super) hotspots: bool,

    /// Title of the drawing, also for screen readers [default: the model's name]
    #[arg(long, value_name = "TEXT", help_heading = "Output")]
    pub(super) title: Option<String>,

    /// What is seen in the drawing, for screen readers, in SVG
    #[arg(long, value_name = "TEXT", help_heading = "Output")]
    pub(super) desc: Option<String>,

    /// currentColor: write what has the colour of the style's pen in the colour of the text around the drawing, in SVG; with
    /// --background none for light pages and dark ones. k: print with black alone, in PDF; cmyk: with four inks, by --icc
    #[arg(long, value_name = "INK", help_heading = "Output", ignore_case = true, hide_possible_values = true,
        value_parser = PossibleValuesParser::new(["currentColor", "screen", "k", "cmyk"]))]
    pub(super) ink: Option<String>,
}
