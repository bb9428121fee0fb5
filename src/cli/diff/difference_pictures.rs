//! Pictures of differences (`--image`).

use std::path::{Path, PathBuf};

use super::comparison::FileComparison;
use super::input_pairs::InputPairs;
use crate::cli::library_calls;
use crate::cli::output::output_files::{Format, Output, Staging, check_place};
use crate::diff::{Diff, View};
use crate::error::Error;
use crate::export::SvgOptions;

/// Resolution of PNG pictures, pixels per inch.
const PICTURE_DPI: f64 = 96.0;

/// Output of the pictures.
pub(crate) enum PictureTarget {
    File(Output),
    Folder(PathBuf),
}

impl PictureTarget {
    /// Reads the output path and checks it before any work is done.
    pub(crate) fn new(path: &Path, pairing: &InputPairs) -> Result<Self, Error> {
        if pairing.folders {
            if path.is_dir() {
                return Ok(Self::Folder(path.to_path_buf()));
            }
            return Err(Error::new("each difference needs its own picture, and this is not a folder")
                .in_file(path)
                .remedy("create the folder first"));
        }
        check_place(path)?;
        let output = Output::new(path.to_path_buf())?;
        match output.format {
            Format::Svg | Format::Png => Ok(Self::File(output)),
            _ => Err(Error::new("differences can be drawn as SVG or PNG only")
                .in_file(path)
                .remedy("end the name with .svg or .png")),
        }
    }

    /// Stages a picture of each difference.
    pub(crate) fn add(
        &self,
        told: &[(String, FileComparison)],
        view: View,
        staging: &mut Staging,
    ) -> Result<(), Error> {
        for (name, told) in told {
            let FileComparison::Both(diff) = told else { continue };
            if diff.is_same() {
                continue;
            }
            match self {
                Self::File(output) => staging.add(&output.path, &bytes(diff, view, output.format)?)?,
                Self::Folder(folder) => {
                    let flat = format!("{}.svg", name.trim_end_matches(".svg").replace('/', "-"));
                    staging.add(&folder.join(flat), &bytes(diff, view, Format::Svg)?)?;
                }
            }
        }
        Ok(())
    }
}

fn bytes(diff: &Diff, view: View, format: Format) -> Result<Vec<u8>, Error> {
    let drawing = diff.picture(view);
    match format {
        Format::Png => library_calls::png(&drawing, PICTURE_DPI),
        _ => Ok(drawing.to_svg(&SvgOptions::default()).into_bytes()),
    }
}
