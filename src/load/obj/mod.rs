//! Wavefront OBJ with its MTL libraries.
//!
//! Source: Wavefront Technologies, *Object Files (.obj)* and *MTL material format*, appendices B1 and B2 of
//! the Advanced Visualizer manual; free-form curves and surfaces are passed over.
//!
//! `o` begins a part; in files (or before objects) without `o`, each name of `g` is one, however
//! often it is taken up again. y is taken to point up.

mod assemble;
mod library;
mod statements;

use std::path::Path;

use crate::error::Error;
use crate::load::text::utf8;
use crate::scene::{Scene, coarse};

/// Reads an OBJ file and the libraries beside it.
///
/// # Errors
/// Names the file and the line if an index points nowhere, or says that nothing can be drawn.
pub fn read(path: &Path) -> Result<Scene, Error> {
    super::read_with(path, |bytes, stem| {
        read_bytes(bytes, stem, |name| crate::scene::beside::read_beside(path, name).ok())
    })
}

/// Reads the text of an OBJ file, in UTF-8, Latin-1 or (with its mark) UTF-16; `stem` names faces outside objects,
/// `library` gives the text of an MTL file by the name the model calls it.
///
/// # Errors
/// As [`read`].
pub fn read_bytes(
    bytes: &[u8],
    stem: &str,
    library: impl FnMut(&str) -> Option<Vec<u8>>,
) -> Result<Scene, Error> {
    let bytes = &*utf8(bytes);
    let statements = statements::Statements::parse(bytes)?;
    let scene = assemble::scene(statements, stem, library);
    if bytes.contains(&0) {
        return crate::scene::drawable(scene).map_err(|_| {
            Error::new("this is binary data, not OBJ text; nothing to draw").remedy("check the file's ending")
        });
    }
    crate::scene::drawable(scene).map(coarse::checked)
}

#[cfg(test)]
mod tests;
