//! Pairs of files to compare: two files, or the files of two folders by name.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::folder_files::{self, MODEL_ENDINGS};
use crate::cli::draw::model_drawing;
use crate::cli::options::draw_args::HowArgs;
use crate::cli::request::draw_request::DrawRequest;
use crate::diff::Picture;
use crate::error::Error;
use crate::error::bounded_read::read_up_to;
use crate::export::encoding::gzip;

/// Maximum size of a drawing file, bytes.
const MAX_DRAWING_BYTES: u64 = 1 << 30;

/// Files to compare, by name.
#[derive(Debug)]
pub(crate) struct InputPairs {
    pub(crate) names: BTreeMap<String, [Option<PathBuf>; 2]>,
    /// Whether the inputs are folders.
    pub(crate) folders: bool,
}

impl InputPairs {
    /// Pairs two files, or the files of two folders.
    ///
    /// # Errors
    /// If one input is a folder and the other is not, or if there is nothing to compare.
    pub(crate) fn new(before: &Path, after: &Path) -> Result<Self, Error> {
        match (before.is_dir(), after.is_dir()) {
            (false, false) => {
                let name = after.display().to_string();
                let files = [Some(before.to_path_buf()), Some(after.to_path_buf())];
                Ok(Self { names: BTreeMap::from([(name, files)]), folders: false })
            }
            (true, true) => {
                let mut names: BTreeMap<String, [Option<PathBuf>; 2]> = BTreeMap::new();
                for (side, folder) in [before, after].into_iter().enumerate() {
                    for (name, path) in folder_files::drawings(folder)? {
                        names.entry(name).or_default()[side] = Some(path);
                    }
                }
                if names.is_empty() {
                    return Err(Error::new("neither folder contains a drawing or a model")
                        .in_file(before)
                        .remedy("name folders with .svg files"));
                }
                Ok(Self { names, folders: true })
            }
            (first, _) => {
                let (folder, file) = if first { (before, after) } else { (after, before) };
                let remedy = format!("name the drawing in it to compare with {}", file.display());
                Err(Error::new("this is a folder, and the other argument is a file")
                    .in_file(folder)
                    .remedy(remedy))
            }
        }
    }
}

/// Reads both drawings. Models are drawn, the second from the view of the first.
pub(crate) fn pictures(before: &Path, after: &Path, how: &HowArgs) -> Result<[Picture; 2], Error> {
    let request = |path: &Path| -> Result<DrawRequest, Error> {
        let mut request = DrawRequest::of_model(path.to_path_buf(), how.clone())?;
        request.how.quiet = true;
        Ok(request)
    };
    if is_model(before) {
        let (svg, seen) = model_drawing::encode_with_view(&request(before)?)?;
        let first = picture(before, &String::from_utf8_lossy(&svg))?;
        if !is_model(after) {
            return Ok([first, picture(after, &text(after)?)?]);
        }
        let request = DrawRequest { view: seen, ..request(after)? };
        let second =
            picture(after, &String::from_utf8_lossy(&model_drawing::encode_first_output(&request)?))?;
        // A model without named parts takes the name of its file, which would count as a difference.
        let stems = [before, after].map(|path| path.file_stem().unwrap_or_default().to_string_lossy());
        return Ok([first, second.with_part_renamed(&stems[1], &stems[0])]);
    }
    let second = || match is_model(after) {
        true => {
            picture(after, &String::from_utf8_lossy(&model_drawing::encode_first_output(&request(after)?)?))
        }
        false => picture(after, &text(after)?),
    };
    let (first, second) =
        crate::parallel::join(|| text(before).and_then(|svg| picture(before, &svg)), second);
    Ok([first?, second?])
}

fn picture(path: &Path, svg: &str) -> Result<Picture, Error> {
    Picture::from_svg(svg).map_err(|error| error.in_file(path))
}

fn is_model(path: &Path) -> bool {
    path.extension().is_some_and(|e| MODEL_ENDINGS.iter().any(|model| e.eq_ignore_ascii_case(model)))
}

/// Reads a drawing as text, and unpacks it if necessary.
fn text(path: &Path) -> Result<String, Error> {
    let unread = |error: std::io::Error| {
        Error::io("cannot read the drawing", error).in_file(path).remedy("check the path")
    };
    let too_large =
        || Error::new("the file is larger than 1 GB").in_file(path).remedy("give a smaller drawing");
    let bytes = read_up_to(path, MAX_DRAWING_BYTES).map_err(unread)?.ok_or_else(too_large)?;
    let bytes = gzip::plain(bytes, MAX_DRAWING_BYTES as usize).map_err(|error| error.in_file(path))?;
    String::from_utf8(bytes).map_err(|error| {
        Error::new("the file is not SVG: it is not UTF-8 text")
            .in_file(path)
            .at(format!("byte {}", error.utf8_error().valid_up_to()))
            .remedy("give an SVG file")
    })
}
