//! Options of PDF output for printing and archiving.

use std::path::PathBuf;
use std::sync::Arc;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueHint};

use crate::cli::output::output_files::{Format, Output};
use crate::colour::srgb::Colour;
use crate::drawing::{Composition, Drawing, Page, PlacedDrawing};
use crate::error::Error;
use crate::export::{Inks, PdfOptions, Screen, Spot, Standard, to_pdf};

/// Options of PDF output, except the inks.
#[derive(Debug, Clone, Default, Args)]
pub(crate) struct PrintArgs {
    /// ICC profile of the press, for --ink cmyk and PDF/X-4
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath, help_heading = "Print")]
    icc: Option<PathBuf>,

    /// Spot colour, such as "#e4002b=PANTONE 185 C"; repeatable
    #[arg(long = "spot", value_name = "COLOUR=INK", value_parser = spot, help_heading = "Print")]
    spots: Vec<Spot>,

    /// Maximum total ink in percent, with --ink cmyk, such as 300
    #[arg(long, value_name = "PERCENT", help_heading = "Print")]
    ink_limit: Option<f64>,

    /// Halftone screen for fills: lines per inch and angle of black, such as 60 or 60@45
    #[arg(long, value_name = "LPI@ANGLE", value_parser = screen, help_heading = "Print")]
    screen: Option<Screen>,

    /// Add crop marks and registration marks
    #[arg(long, help_heading = "Print")]
    marks: bool,

    /// PDF standard: x4 (PDF/X-4, presses) or a2b (PDF/A-2b, archives)
    #[arg(long = "pdf", value_name = "STANDARD", help_heading = "Print", ignore_case = true,
        value_parser = PossibleValuesParser::new(["x4", "a2b"])
            .map(|name| if name.eq_ignore_ascii_case("x4") { Standard::X4 } else { Standard::A2b }))]
    standard: Option<Standard>,

    /// Write letters as outlines, without fonts
    #[arg(long, help_heading = "Print")]
    outlined: bool,
}

/// Names of the sets of inks.
pub(crate) const INKS: [&str; 3] = ["screen", "k", "cmyk"];

/// Reads a spot colour and the name of its ink.
fn spot(text: &str) -> Result<Spot, String> {
    let (colour, name) = text.split_once('=').ok_or("write COLOUR=INK, such as \"#e4002b=PANTONE 185 C\"")?;
    let colour = Colour::parse(colour).ok_or_else(|| format!("`{colour}` is not a colour"))?;
    Ok(Spot { colour, name: name.trim().to_owned() })
}

/// Reads a halftone screen: lines per inch and angle in degrees.
fn screen(text: &str) -> Result<Screen, String> {
    let (lpi, angle) = text.split_once('@').unwrap_or((text, "45"));
    let number = |text: &str| text.trim().parse::<f64>().map_err(|_| format!("`{text}` is not a number"));
    Ok(Screen { lpi: number(lpi)?, angle_deg: number(angle)? })
}

impl PrintArgs {
    /// Merges these options with the print settings of a page file. Typed options take precedence.
    #[cfg(feature = "page")]
    pub(crate) fn merged_with(
        &self,
        ink: Option<&str>,
        file: &crate::page::PrintInks,
    ) -> (Self, Option<String>) {
        let mut all = self.clone();
        let inks = ink.map(str::to_owned).or_else(|| file.ink.clone());
        all.icc = all.icc.or_else(|| file.icc.clone());
        if inks.as_deref().is_some_and(|inks| inks.eq_ignore_ascii_case("cmyk")) {
            all.ink_limit = all.ink_limit.or(file.ink_limit);
        }
        let is_free = |colour: Colour| !self.spots.iter().any(|spot| spot.colour == colour);
        let spots = file.spots.iter().filter(|spot| is_free(spot.colour));
        all.spots.extend(spots.map(|spot| Spot { colour: spot.colour, name: spot.name.trim().to_owned() }));
        (all, inks)
    }

    /// Options of the PDF exporter for a set of inks; none if all have default values.
    ///
    /// # Errors
    /// Returns an error if options contradict each other or the profile cannot be read.
    pub(crate) fn options(&self, ink: Option<&str>) -> Result<Option<PdfOptions>, Error> {
        let ink = ink.map(str::to_ascii_lowercase);
        let profile: Option<Arc<[u8]>> = match &self.icc {
            None => None,
            Some(file) => {
                let bytes = std::fs::read(file)
                    .map_err(|error| Error::io("cannot be read", error).in_file(file).at("--icc"))?;
                Some(Arc::from(bytes))
            }
        };
        let mut options =
            PdfOptions { spots: self.spots.clone(), marks: self.marks, ..PdfOptions::default() };
        options.screen = self.screen;
        (options.standard, options.outlined, options.ink_limit) =
            (self.standard, self.outlined, self.ink_limit);
        match ink.as_deref() {
            Some("cmyk") => {
                let profile = profile.ok_or_else(|| {
                    Error::new("four inks need the ICC profile of the press")
                        .at("--ink cmyk")
                        .remedy("give --icc FILE (icc in a page file), or --ink k for black only")
                })?;
                options.inks = Inks::Cmyk(profile);
            }
            Some("k") => (options.inks, options.profile) = (Inks::K, profile),
            _ => options.profile = profile,
        }
        if self.ink_limit.is_some() && !matches!(options.inks, Inks::Cmyk(_)) {
            return Err(Error::new("an ink limit needs four inks")
                .at("--ink-limit")
                .remedy("give --ink cmyk --icc FILE, or leave it out"));
        }
        Ok((options != PdfOptions::default()).then_some(options))
    }

    /// Options of the PDF exporter, if an output is a PDF.
    ///
    /// # Errors
    /// Returns an error as [`PrintArgs::options`] does, and if PDF options are given without a PDF output.
    pub(crate) fn of_outputs(
        &self,
        ink: Option<&str>,
        outputs: &[Output],
    ) -> Result<Option<PdfOptions>, Error> {
        let writes_pdf = outputs.iter().any(|output| output.format == Format::Pdf);
        self.refuse_without_pdf(ink, writes_pdf)?;
        if writes_pdf { self.options(ink) } else { Ok(None) }
    }

    /// Refuses PDF options if no PDF is written.
    pub(crate) fn refuse_without_pdf(&self, ink: Option<&str>, writes_pdf: bool) -> Result<(), Error> {
        let given = [
            (ink.is_some_and(|ink| INKS.iter().any(|name| ink.eq_ignore_ascii_case(name))), "--ink"),
            (self.icc.is_some(), "--icc"),
            (!self.spots.is_empty(), "--spot"),
            (self.ink_limit.is_some(), "--ink-limit"),
            (self.screen.is_some(), "--screen"),
            (self.marks, "--marks"),
            (self.standard.is_some(), "--pdf"),
            (self.outlined, "--outlined"),
        ];
        match given.iter().find(|(given, _)| *given) {
            Some((_, option)) if !writes_pdf => {
                Err(Error::new("this option works with PDF only, and no PDF is written")
                    .at(*option)
                    .remedy("name a .pdf file"))
            }
            _ => Ok(()),
        }
    }
}

/// Encodes a drawing as PDF.
pub(crate) fn encode(drawing: &Drawing, options: Option<&PdfOptions>) -> Result<Vec<u8>, Error> {
    let Some(options) = options else { return Ok(drawing.to_pdf()) };
    let (name, drawing, place) = ("drawing".to_owned(), drawing.clone(), kurbo::Affine::IDENTITY);
    let page = Page { background: None, ..drawing.page };
    let title = drawing.title.clone();
    to_pdf(
        &[Composition::new(title, page, vec![PlacedDrawing { name, drawing, place, clip: None }])],
        options,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spot_parses_a_colour_and_an_ink_name() {
        let read = spot("#e4002b=PANTONE 185 C").unwrap();
        assert_eq!((read.colour, read.name.as_str()), (Colour::rgb(228, 0, 43), "PANTONE 185 C"));
        assert!(spot("red").unwrap_err().contains("COLOUR=INK"));
        assert!(spot("#12=X").unwrap_err().contains("`#12`"));
    }

    #[test]
    fn pdf_options_are_none_without_print_options() {
        assert_eq!(PrintArgs::default().options(None).unwrap(), None);
        assert_eq!(PrintArgs::default().options(Some("currentColor")).unwrap(), None);
        assert!(PrintArgs::default().options(Some("k")).unwrap().is_some());
        let error = PrintArgs::default().options(Some("CMYK")).unwrap_err().to_string();
        assert!(error.contains("--icc"), "{error}");
    }
}
