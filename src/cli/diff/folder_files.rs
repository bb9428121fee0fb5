//! Drawings and models of a folder, searched recursively.

use std::path::{Path, PathBuf};

use crate::error::Error;

/// File endings of models.
pub(crate) const MODEL_ENDINGS: [&str; 7] = ["obj", "gltf", "glb", "stl", "ply", "step", "stp"];

/// Maximum depth of nested folders. Stops at cyclic links.
const MAX_FOLDER_DEPTH: usize = 32;

/// Comparable files of a folder and its sub-folders. Returns the relative path with `/`, and the path.
pub(crate) fn drawings(folder: &Path) -> Result<Vec<(String, PathBuf)>, Error> {
    let mut found = Vec::new();
    let mut open = vec![(folder.to_path_buf(), 0)];
    while let Some((inner, depth)) = open.pop() {
        let unread = |error: std::io::Error| {
            Error::io("cannot read the folder", error).in_file(&inner).remedy("check the path")
        };
        for entry in std::fs::read_dir(&inner).map_err(unread)? {
            let path = entry.map_err(unread)?.path();
            if path.is_dir() && depth < MAX_FOLDER_DEPTH {
                open.push((path, depth + 1));
            } else if path.is_file() && can_be_compared(&path) {
                let parts = path.strip_prefix(folder).unwrap_or(&path).components();
                let parts: Vec<_> = parts.map(|part| part.as_os_str().to_string_lossy()).collect();
                found.push((parts.join("/"), path));
            }
        }
    }
    found.sort();
    Ok(found)
}

fn can_be_compared(path: &Path) -> bool {
    let ending = path.extension().unwrap_or_default();
    MODEL_ENDINGS.iter().chain(&["svg"]).any(|known| ending.eq_ignore_ascii_case(known))
}
