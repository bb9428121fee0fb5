//! Contact sheets: grids of small captioned drawings to choose from.
//!
//! - `views`: a model from nine sides, with the angles to paste back (`ligne draw --contact-sheet`).
//! - `styles`: a model in many styles (`ligne styles --sheet`).
//! - The moments of an animation are in `animate`, which draws them as frames (`ligne animate --contact-sheet`).
//!
//! Each of them draws its pictures with the options of `ligne draw` and hands them to [`Sheet`]. `grid` puts them into one
//! drawing, which is written in every format of drawings.

mod args;
mod grid;
mod style_args;
mod styles;
mod views;

pub(super) use self::args::{MomentSheetArgs, ViewSheetArgs};
pub(super) use self::grid::{Picture, SIDE_PX};
pub(super) use self::style_args::StyleSheetArgs;
pub(super) use self::styles::run as of_styles;
pub(super) use self::views::run as of_views;
use super::draw::Drawn;
use super::output::{Format, Output, Staging, check_place};
use super::paper::Extent;
use super::request::DrawRequest;
use super::{draw, number, pipeline, print, say};
use crate::drawing::Unit;
use crate::error::Error;
use crate::export::{DxfOptions, gzip};

/// Pictures in a row of views and moments.
pub(super) const COLUMNS: usize = 3;

/// Pictures on a sheet of views or moments.
pub(super) const PICTURES: usize = 9;

/// A sheet that is being made.
#[derive(Debug, Default)]
pub(super) struct Sheet {
    pictures: Vec<Picture>,
    warnings: Vec<String>,
}

impl Sheet {
    /// Adds a drawing, and the warnings that no other had.
    fn add(&mut self, drawn: Drawn, caption: String, key: String) {
        for warning in &drawn.report.warnings {
            if !self.warnings.contains(warning) {
                self.warnings.push(warning.clone());
            }
        }
        self.pictures.push(Picture { drawing: drawn.into_drawing(), caption, key });
    }

    /// Writes the sheet, and reports what is on it: `what` is the name of a picture.
    fn finish(
        self,
        request: &DrawRequest,
        outputs: &[Output],
        columns: usize,
        what: &str,
    ) -> Result<(), Error> {
        if let Some(warning) = self.warnings.first().filter(|_| request.strict) {
            return Err(Error::new(warning.clone())
                .in_file(&request.model)
                .remedy("mend the model, or draw without --strict"));
        }
        if !request.quiet {
            for warning in &self.warnings {
                say(&format!("warning: {}: {warning}", request.model.display()));
            }
        }
        let counted = number::counted(self.pictures.len() as u64, what);
        for (output, bytes) in write(self.pictures, columns, request, outputs)? {
            if !request.quiet {
                say(&format!("{}: {counted}, {}", output.name(), number::bytes(bytes)));
            }
        }
        Ok(())
    }
}

/// The request for one picture: nothing is written of it, and it has the size of a small one unless another is given.
pub(super) fn picture_request(mut request: DrawRequest) -> DrawRequest {
    let side = Extent { width: SIDE_PX, height: SIDE_PX };
    request.sheet.extent = request.sheet.extent.or(Some((side, Unit::Px)));
    request.outputs = Vec::new();
    request
}

/// Refuses places that nothing can be written to.
pub(super) fn check_outputs(outputs: &[Output]) -> Result<(), Error> {
    let mut files = outputs.iter().filter(|output| output.format != Format::SvgToStdout);
    files.try_for_each(|output| check_place(&output.path))
}

/// Writes the pictures as one sheet; returns the number of bytes of each file.
pub(super) fn write<'a>(
    pictures: Vec<Picture>,
    columns: usize,
    request: &DrawRequest,
    outputs: &'a [Output],
) -> Result<Vec<(&'a Output, u64)>, Error> {
    let sheet = grid::grid(pictures, columns);
    let svg = || sheet.to_svg(&pipeline::svg_options(&request.svg)).into_bytes();
    let mut staging = Staging::default();
    let mut files = Vec::new();
    for output in outputs {
        let bytes = match output.format {
            Format::SvgToStdout => {
                print(&svg())?;
                continue;
            }
            Format::Svg => svg(),
            Format::Svgz => gzip::packed(&svg()),
            Format::Dxf => sheet.to_dxf(&DxfOptions::default()),
            Format::Png => pipeline::png(&sheet, request.dpi.unwrap_or(draw::default_dpi(Unit::Px)))?,
            #[cfg(feature = "pdf")]
            Format::Pdf => sheet.to_pdf(),
        };
        staging.add(&output.path, &bytes)?;
        files.push((output, bytes.len() as u64));
    }
    staging.commit()?;
    Ok(files)
}
