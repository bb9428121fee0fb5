//! Wavefront OBJ with its MTL libraries.
//!
//! Source: Wavefront Technologies, *Object Files (.obj)* and *MTL material format*, appendices B1 and B2 of
//! the Advanced Visualizer manual. Free-form curves and surfaces are skipped. The y axis is assumed to point
//! up.
//!
//! 1. [`statements`] reads all statements into flat arrays, in one pass over the bytes.
//! 2. [`mtl_library`] reads the material libraries that the file names.
//! 3. [`scene_assembly`] makes parts and materials. `o` begins a part; in files without `o`, or before the
//!    first `o`, each name of `g` is a part, even when the group is resumed later.

mod mtl_library;
mod scene_assembly;
mod statements;

use std::path::Path;

use super::text_cursor::utf8;
use crate::error::Error;
use crate::scene::Scene;
use crate::scene::extent::precision_warning;
use crate::scene::model_folder::{ModelFolder, read_from_model_folder};

/// Reads an OBJ file and the libraries next to it.
///
/// # Errors
/// Names the file and the line if an index is out of range, or reports that nothing can be drawn.
pub(crate) fn read(path: &Path) -> Result<Scene, Error> {
    let files = ModelFolder::of(path);
    super::read_with(path, |bytes, stem| {
        read_with_files(bytes, stem, |name| read_from_model_folder(path, name).ok(), Some(&files))
    })
}

/// Reads the text of an OBJ file, in UTF-8, Latin-1, or UTF-16 with a byte-order mark.
///
/// `stem` names faces outside objects. `library` returns the text of an MTL file by the name that the model
/// uses.
///
/// # Errors
/// As [`read`].
pub(crate) fn read_bytes(
    bytes: &[u8],
    stem: &str,
    library: impl FnMut(&str) -> Option<Vec<u8>>,
) -> Result<Scene, Error> {
    read_with_files(bytes, stem, library, None)
}

fn read_with_files(
    bytes: &[u8],
    stem: &str,
    library: impl FnMut(&str) -> Option<Vec<u8>>,
    files: Option<&ModelFolder>,
) -> Result<Scene, Error> {
    let bytes = &*utf8(bytes);
    let statements = statements::Statements::parse(bytes)?;
    let scene = scene_assembly::scene(statements, stem, library, files);
    if bytes.contains(&0) {
        return crate::scene::drawable(scene).map_err(|_| {
            Error::new("this is binary data, not OBJ text; nothing to draw").remedy("check the file's ending")
        });
    }
    crate::scene::drawable(scene).map(precision_warning::with_precision_warning)
}

#[cfg(test)]
mod tests;
