//! Pictures of artist lines: reads the files that a style names.

use std::path::Path;
use std::sync::Arc;

use super::picture_file::{place, read_picture};
use crate::error::Error;
use crate::scene::ArtistTextures;

/// Reads the pictures of all artist textures.
pub(crate) fn read_artist_textures(textures: &mut ArtistTextures) -> Result<(), Error> {
    for texture in &mut textures.0 {
        texture.picture = Some(Arc::new(read_picture(
            &texture.path,
            "of artist lines",
            "give a PNG, JPEG or WebP that lies on the texture coordinates of the model",
        )?));
    }
    Ok(())
}

/// Makes the paths of artist textures relative to the folder of their sheet.
pub(crate) fn place_artist_textures(sheet: &mut toml::Table, folder: &Path) {
    let Some(toml::Value::Table(lines)) = sheet.get_mut("lines") else { return };
    match lines.get_mut("artist_texture") {
        Some(toml::Value::Table(table)) => {
            let materials: Vec<String> = table.keys().cloned().collect();
            materials.iter().for_each(|material| place(table, material, folder));
        }
        _ => place(lines, "artist_texture", folder),
    }
}
