//! Contact sheets: grids of small captioned drawings.
//!
//! - [`view_grid`]: one model from nine sides, captioned with the angles (`ligne draw --contact-sheet`).
//! - [`style_grid`]: one model in many styles (`ligne styles --sheet`), with the options of
//!   [`style_grid_args`].
//! - The moments of an animation are drawn by `animate` (`ligne animate --contact-sheet`).
//!
//! Each collects pictures in a `ContactSheet`. [`picture_grid`] arranges them in one drawing, which is
//! written in any drawing format.

mod picture_grid;
mod style_grid;
mod style_grid_args;
mod view_grid;

pub(crate) use self::picture_grid::{GridPicture, PICTURE_SIDE_PX};
pub(crate) use self::style_grid::run as of_styles;
pub(crate) use self::style_grid_args::StyleSheetArgs;
pub(crate) use self::view_grid::run as of_views;
use super::model_drawing;
use super::model_drawing::EncodedDrawing;
use crate::cli::options::values::paper_size::PaperSize;
use crate::cli::output::number_text;
use crate::cli::output::output_files::{Format, Output, Staging, check_place};
use crate::cli::request::draw_request::DrawRequest;
use crate::cli::{library_calls, print, say};
use crate::drawing::Unit;
use crate::error::Error;
use crate::export::DxfOptions;
use crate::export::encoding::gzip;
use crate::scene::warnings::add_new;

/// Number of columns of views and moments.
pub(crate) const COLUMN_COUNT: usize = 3;

/// Number of pictures on a sheet of views or moments.
pub(crate) const PICTURE_COUNT: usize = 9;

/// Contact sheet that is being filled.
#[derive(Debug, Default)]
pub(crate) struct ContactSheet {
    pictures: Vec<GridPicture>,
    warnings: Vec<String>,
}

impl ContactSheet {
    /// Adds a drawing, and its warnings if they are new.
    fn add(&mut self, drawn: EncodedDrawing, caption: String, key: String) {
        add_new(&mut self.warnings, drawn.report.warnings.iter().cloned());
        self.pictures.push(GridPicture { drawing: drawn.into_drawing(), caption, key });
    }

    /// Writes the sheet and prints a summary. `what` is the noun for a picture.
    fn finish(
        self,
        request: &DrawRequest,
        outputs: &[Output],
        columns: usize,
        what: &str,
    ) -> Result<(), Error> {
        if let Some(warning) = self.warnings.first().filter(|_| request.how.strict) {
            return Err(Error::new(warning.clone())
                .in_file(&request.model)
                .remedy("mend the model, or draw without --strict"));
        }
        if !request.how.quiet {
            for warning in &self.warnings {
                say(&format!("warning: {}: {warning}", request.model.display()));
            }
        }
        let counted = number_text::counted(self.pictures.len() as u64, what);
        for (output, bytes) in write(self.pictures, columns, request, outputs)? {
            if !request.how.quiet {
                say(&format!("{}: {counted}, {}", output.name(), number_text::bytes(bytes)));
            }
        }
        Ok(())
    }
}

/// Request for one picture: without outputs, and small unless a size is given.
pub(crate) fn picture_request(mut request: DrawRequest) -> DrawRequest {
    let side = PaperSize { width: PICTURE_SIDE_PX, height: PICTURE_SIDE_PX };
    request.sheet.extent = request.sheet.extent.or(Some((side, Unit::Px)));
    request.outputs = Vec::new();
    request
}

/// Refuses output paths that cannot be written.
pub(crate) fn check_outputs(outputs: &[Output]) -> Result<(), Error> {
    let mut files = outputs.iter().filter(|output| output.format != Format::SvgToStdout);
    files.try_for_each(|output| check_place(&output.path))
}

/// Writes the pictures as one sheet. Returns the number of bytes of each file.
pub(crate) fn write<'a>(
    pictures: Vec<GridPicture>,
    columns: usize,
    request: &DrawRequest,
    outputs: &'a [Output],
) -> Result<Vec<(&'a Output, u64)>, Error> {
    let sheet = picture_grid::grid(pictures, columns);
    let svg = || sheet.to_svg(&library_calls::svg_options(&request.how)).into_bytes();
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
            Format::Png => {
                library_calls::png(&sheet, request.how.dpi.unwrap_or(model_drawing::default_dpi(Unit::Px)))?
            }
            #[cfg(feature = "pdf")]
            Format::Pdf => sheet.to_pdf(),
        };
        staging.add(&output.path, &bytes)?;
        files.push((output, bytes.len() as u64));
    }
    staging.commit()?;
    Ok(files)
}
