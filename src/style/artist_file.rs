//! Reads the pictures that a style names for artist lines.

use std::fmt;
use std::path::Path;
use std::sync::Arc;

use crate::error::Error;
use crate::math::picture::Picture;
use crate::scene::ArtistTextures;

/// Bytes of a picture that are read.
const GREATEST_FILE: u64 = 1 << 26;

/// Reads the pictures.
pub(super) fn read_artist_textures(textures: &mut ArtistTextures) -> Result<(), Error> {
    for texture in &mut textures.0 {
        texture.picture = Some(Arc::new(read(&texture.path)?));
    }
    Ok(())
}

/// Makes the paths of the pictures in a sheet relative to what the sheet's own path is relative to.
pub(super) fn place_artist_textures(sheet: &mut toml::Table, folder: &Path) {
    let place = |path: &mut toml::Value| {
        if let toml::Value::String(path) = path
            && !path.is_empty()
        {
            *path = folder.join(&*path).to_string_lossy().into_owned();
        }
    };
    let Some(toml::Value::Table(lines)) = sheet.get_mut("lines") else { return };
    match lines.get_mut("artist_texture") {
        Some(toml::Value::Table(table)) => table.iter_mut().for_each(|(_, path)| place(path)),
        Some(path) => place(path),
        None => {}
    }
}

fn read(path: &Path) -> Result<Picture, Error> {
    let unread = |error: std::io::Error| {
        Error::io("cannot read the picture of artist lines", error).in_file(path).remedy("check the path")
    };
    if std::fs::metadata(path).map_err(unread)?.len() > GREATEST_FILE {
        return Err(unfit(path, "is too large"));
    }
    let bytes = std::fs::read(path).map_err(unread)?;
    Picture::decode(&bytes).map_err(|message| unfit(path, message))
}

fn unfit(path: &Path, message: impl fmt::Display) -> Error {
    Error::new(format!("the picture of artist lines {message}"))
        .in_file(path)
        .remedy("give a PNG, JPEG or WebP that lies on the texture coordinates of the model")
}
