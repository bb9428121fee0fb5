//! Files that a model names.

use std::fs;
use std::path::Path;

use crate::error::Error;

/// The bytes of a file beside the model, by the name the model calls it.
///
/// # Errors
/// If the name leads outside the model's folder, or the file cannot be read.
pub fn read_beside(model: &Path, name: &str) -> Result<Vec<u8>, Error> {
    if !stays_inside(name) {
        return Err(Error::new(format!("{name} lies outside the model's folder")).in_file(model));
    }
    let path = model.parent().unwrap_or(Path::new("")).join(name);
    if !path.is_file() {
        return Err(Error::new(format!("{name} is missing")).in_file(model));
    }
    fs::read(&path).map_err(|e| Error::io("cannot be read", e).in_file(path))
}

/// Whether a relative path, written with slashes, stays inside the folder it starts from.
#[must_use]
pub fn stays_inside(path: &str) -> bool {
    let mut depth = 0_i32;
    for step in path.split(['/', '\\']) {
        match step {
            "" | "." => {}
            ".." => depth -= 1,
            _ => depth += 1,
        }
        if depth < 0 {
            return false;
        }
    }
    // A colon is a drive or a protocol.
    !path.starts_with(['/', '\\']) && !path.contains([':', '\0'])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_stay_inside() {
        for good in ["a.mtl", "a/b.mtl", "a/../b.mtl", "./a b.mtl", ".a"] {
            assert!(stays_inside(good), "{good}");
        }
        for bad in ["../a", "a/../../b", "/a", "\\a", "C:\\a", "http://a/b", "a\\..\\..\\b", "a\0"] {
            assert!(!stays_inside(bad), "{bad}");
        }
    }
}
