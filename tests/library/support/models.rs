//! The shared models: a folder that is not part of the project and may be absent.

use std::path::PathBuf;

/// The folder of the shared models: `LIGNE_MODELS`, or `../shared/models` beside the project.
pub fn folder() -> PathBuf {
    std::env::var_os("LIGNE_MODELS").map_or_else(
        || PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/models")),
        PathBuf::from,
    )
}

/// The path of a shared model, or a printed line that it is absent.
pub fn find(name: &str) -> Option<PathBuf> {
    let path = folder().join(name);
    if !path.is_file() {
        println!("skipped: no model {name} in {}", folder().display());
        return None;
    }
    Some(path)
}
