//! Options of drawings that are put into web pages.

use clap::Args;
use clap::builder::PossibleValuesParser;

use super::pipeline::svg_options;
use super::request::SvgChoices;
use crate::drawing::{Drawing, Page};
use crate::error::Error;
use crate::export::SvgOptions;
use crate::render;
use crate::scene::{Camera, Scene};
use crate::stroke::pen::Ink;
use crate::style::Style;

/// What a web page needs of a drawing.
#[derive(Debug, Clone, Default, Args)]
pub(super) struct WebArgs {
    /// Lay an area over each part that is not painted, but answers the pointer in web pages and says the part's name, in SVG
    #[arg(long, help_heading = "Output")]
    pub(super) hotspots: bool,

    /// Title of the drawing, also for readers of screens [default: the model's name]
    #[arg(long, value_name = "TEXT", help_heading = "Output")]
    pub(super) title: Option<String>,

    /// What is seen in the drawing, for readers of screens, in SVG
    #[arg(long, value_name = "TEXT", help_heading = "Output")]
    pub(super) desc: Option<String>,

    /// Write what has the colour of the style's pen in the colour of the text around the drawing, in SVG; with --background none for
    /// light pages and dark ones
    #[arg(long, value_name = "currentColor", help_heading = "Output", ignore_case = true, hide_possible_values = true,
        value_parser = PossibleValuesParser::new(["currentColor"]))]
    pub(super) ink: Option<String>,
}

impl WebArgs {
    /// Adds to a drawing what was asked for; a warning where that is nothing.
    pub(super) fn complete(
        &self,
        drawing: &mut Drawing,
        scene: &Scene,
        camera: &Camera,
        style: &Style,
    ) -> Result<Option<&'static str>, Error> {
        if let Some(title) = &self.title {
            drawing.title.clone_from(title);
        }
        if self.hotspots {
            let page: Page = drawing.page;
            drawing.hotspots = render::hotspots(scene, camera, page, style)?;
        }
        let bare = self.hotspots && drawing.hotspots.is_empty();
        Ok(bare.then_some("no part with a name is in sight: there are no hot-spots"))
    }

    /// How SVG is written.
    pub(super) fn svg_options(&self, choices: &SvgChoices, style: &Style) -> Result<SvgOptions, Error> {
        let mut options = svg_options(choices);
        if self.title.is_some() || self.desc.is_some() {
            options = options.read_aloud(self.desc.as_deref().unwrap_or_default());
        }
        if self.ink.is_some() {
            let Ink::Fixed(ink) = style.stroke.pen.colour else {
                return Err(Error::new("the style's pen has no colour of its own")
                    .at("--ink")
                    .remedy("give it one: --set pen.colour=black"));
            };
            options = options.with_current_ink(ink);
        }
        Ok(options)
    }
}
