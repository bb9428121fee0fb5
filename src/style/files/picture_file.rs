//! Reads the pictures that a style names by path.

use std::fmt;
use std::path::Path;

use crate::colour::pixel_picture::Picture;
use crate::error::Error;

/// Maximum size of a picture file, bytes.
const MAX_FILE_BYTES: u64 = 1 << 26;

/// Reads a picture. `of` names its use in errors, `remedy` is the advice.
pub(crate) fn read_picture(path: &Path, of: &str, remedy: &str) -> Result<Picture, Error> {
    let unread = |error: std::io::Error| {
        Error::io(format!("cannot read the picture {of}"), error).in_file(path).remedy("check the path")
    };
    let unfit = |message: &dyn fmt::Display| {
        Error::new(format!("the picture {of} {message}")).in_file(path).remedy(remedy)
    };
    if std::fs::metadata(path).map_err(unread)?.len() > MAX_FILE_BYTES {
        return Err(unfit(&"is too large"));
    }
    let bytes = std::fs::read(path).map_err(unread)?;
    Picture::decode(&bytes).map_err(|message| unfit(&message))
}

/// Makes the path at a key of a table relative to the folder of its sheet.
pub(crate) fn place(table: &mut toml::Table, key: &str, folder: &Path) {
    if let Some(toml::Value::String(path)) = table.get_mut(key)
        && !path.is_empty()
    {
        *path = folder.join(&*path).to_string_lossy().into_owned();
    }
}

/// Makes the path of the paper's picture relative to the folder of its sheet.
pub(crate) fn place_paper(sheet: &mut toml::Table, folder: &Path) {
    if let Some(toml::Value::Table(page)) = sheet.get_mut("page") {
        place(page, "paper", folder);
    }
}
