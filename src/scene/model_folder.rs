//! Files that a model refers to: read only from the folder of the model, and found there by similar names.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use crate::error::Error;

/// Maximum number of names that are read from a folder.
const MAX_FOLDER_NAMES: usize = 1 << 16;

/// Maximum number of steps of a path, counted from its end, that are searched in the model's folder.
const MAX_PATH_STEPS: usize = 16;

/// Reads a file next to the model, by the name that the model uses.
///
/// # Errors
/// If the name, or a link that it stands for, leads outside the model's folder, or if the file cannot be
/// read.
pub(crate) fn read_from_model_folder(model: &Path, name: &str) -> Result<Vec<u8>, Error> {
    if !stays_inside(name) {
        return Err(Error::new(format!("{name} is outside the model's folder")).in_file(model));
    }
    let folder = folder_of(model);
    let path = folder.join(name);
    if !path.is_file() {
        return Err(Error::new(format!("{name} is missing")).in_file(model));
    }
    if !is_within(folder, &path) {
        return Err(Error::new(format!("{name} is a link out of the model's folder")).in_file(model));
    }
    fs::read(&path).map_err(|e| Error::io("cannot be read", e).in_file(path))
}

/// Whether a relative path, written with slashes, stays inside the folder that it starts from.
#[must_use]
pub(crate) fn stays_inside(path: &str) -> bool {
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
    // A colon belongs to a drive or a protocol.
    !path.starts_with(['/', '\\']) && !path.contains([':', '\0'])
}

/// The folder of a model.
fn folder_of(model: &Path) -> &Path {
    model.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Whether a file is in a folder, after links are resolved.
fn is_within(folder: &Path, file: &Path) -> bool {
    match (folder.canonicalize(), file.canonicalize()) {
        (Ok(folder), Ok(file)) => file.starts_with(folder),
        _ => false,
    }
}

/// The files in a model's folder and its sub-folders. Each folder is listed once.
#[derive(Debug)]
pub(crate) struct ModelFolder {
    folder: PathBuf,
    /// Names in each listed folder, keyed by their lower case. Folders are relative to the model.
    listed: RefCell<BTreeMap<String, BTreeMap<String, Vec<String>>>>,
}

impl ModelFolder {
    /// Starts with no folder listed.
    pub(crate) fn of(model: &Path) -> Self {
        Self { folder: folder_of(model).to_path_buf(), listed: RefCell::default() }
    }

    /// Whether a path relative to the model, written with slashes, is a file inside its folder.
    pub(crate) fn has(&self, path: &str) -> bool {
        let file = self.folder.join(path);
        stays_inside(path) && file.is_file() && is_within(&self.folder, &file)
    }

    /// Finds the file that a name may refer to if no file has exactly this name. Returns its path relative to
    /// the model.
    ///
    /// Takes the longest end of the path that exists, in any letter case: `C:\work\maps\Wall.PNG` is
    /// `maps/wall.png`, or else `wall.png`. The search begins in `below`, the folder of the file that
    /// contains the name (empty, or ending with a slash), and continues next to the model. Of several names
    /// that differ only in case, it takes the first in alphabetical order.
    pub(crate) fn find(&self, below: &str, name: &str) -> Option<String> {
        let mut steps: Vec<&str> = Vec::new();
        for step in name.split(['/', '\\']) {
            match step {
                "" | "." => {}
                // The steps before `..` lead elsewhere.
                ".." => steps.clear(),
                // Drive or protocol.
                _ if step.contains([':', '\0']) => steps.clear(),
                _ => steps.push(step),
            }
        }
        let steps = steps.get(steps.len().saturating_sub(MAX_PATH_STEPS)..)?;
        let mut folders = vec![below.trim_end_matches('/')];
        folders.extend((!below.is_empty()).then_some(""));
        (0..steps.len()).find_map(|from| {
            let end = steps.get(from..)?;
            folders.iter().find_map(|folder| self.find_any_case(folder, end))
        })
    }

    /// Path of the file at the end of some steps below a folder, in any letter case.
    fn find_any_case(&self, folder: &str, steps: &[&str]) -> Option<String> {
        let mut path = folder.to_owned();
        for step in steps {
            let alike = self.names(&path, &step.to_lowercase());
            let name = alike.iter().find(|name| name == step).or(alike.first())?;
            if !path.is_empty() {
                path.push('/');
            }
            path.push_str(name);
        }
        self.has(&path).then_some(path)
    }

    /// Names in a folder that differ from each other only in case, in alphabetical order.
    fn names(&self, folder: &str, lower: &str) -> Vec<String> {
        let mut listed = self.listed.borrow_mut();
        if !listed.contains_key(folder) {
            listed.insert(folder.to_owned(), self.list(folder));
        }
        listed.get(folder).and_then(|names| names.get(lower)).cloned().unwrap_or_default()
    }

    fn list(&self, folder: &str) -> BTreeMap<String, Vec<String>> {
        let mut names: BTreeMap<String, Vec<String>> = BTreeMap::new();
        let path = self.folder.join(folder);
        if !(folder.is_empty() || is_within(&self.folder, &path)) {
            return names;
        }
        let entries = fs::read_dir(path).into_iter().flatten().flatten().take(MAX_FOLDER_NAMES);
        for name in entries.filter_map(|entry| entry.file_name().into_string().ok()) {
            names.entry(name.to_lowercase()).or_default().push(name);
        }
        names.values_mut().for_each(|alike| alike.sort_unstable());
        names
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stays_inside_refuses_paths_out_of_the_folder() {
        for good in ["a.mtl", "a/b.mtl", "a/../b.mtl", "./a b.mtl", ".a"] {
            assert!(stays_inside(good), "{good}");
        }
        for bad in ["../a", "a/../../b", "/a", "\\a", "C:\\a", "http://a/b", "a\\..\\..\\b", "a\0"] {
            assert!(!stays_inside(bad), "{bad}");
        }
    }

    /// Temporary folder, deleted when dropped.
    struct TempFolder(PathBuf);

    impl TempFolder {
        fn new(name: &str, files: &[&str]) -> Self {
            let folder = std::env::temp_dir().join(format!("ligne-{name}-{}", std::process::id()));
            for file in files {
                let path = folder.join(file);
                fs::create_dir_all(path.parent().unwrap()).unwrap();
                fs::write(path, file).unwrap();
            }
            Self(folder)
        }
    }

    impl Drop for TempFolder {
        fn drop(&mut self) {
            _ = fs::remove_dir_all(&self.0);
        }
    }

    #[test]
    fn model_folder_finds_files_by_path_suffix_ignoring_case() {
        let files = [
            "models/Wall.PNG",
            "models/maps/wood.png",
            "models/maps/Wall.png",
            "models/lib/wood.PNG",
            "secret.png",
        ];
        let folder = TempFolder::new("beside", &files);
        let beside = ModelFolder::of(&folder.0.join("models/a.obj"));
        for (below, name, wanted) in [
            ("", "wall.png", Some("Wall.PNG")),
            ("", "C:\\work\\wall.png", Some("Wall.PNG")),
            ("", "C:\\work\\MAPS\\wall.png", Some("maps/Wall.png")),
            ("", "/home/a/Maps/Wood.Png", Some("maps/wood.png")),
            ("", "../textures/wall.png", Some("Wall.PNG")),
            ("", "maps/../../wall.png", Some("Wall.PNG")),
            ("", "http://example.org/wall.png", Some("Wall.PNG")),
            ("", "\\\\server\\share\\wall.png", Some("Wall.PNG")),
            ("lib/", "wood.png", Some("lib/wood.PNG")),
            ("lib/", "wall.png", Some("Wall.PNG")),
            ("", "wood.png", None),
            ("", "../secret.png", None),
            ("", "C:secret.png", None),
            ("", "maps", None),
            ("", "..", None),
            ("", "", None),
        ] {
            assert_eq!(beside.find(below, name).as_deref(), wanted, "{below} {name}");
        }
        assert!(beside.has("maps/wood.png") && !beside.has("../secret.png") && !beside.has("maps"));
        let long = "a/".repeat(100_000) + "wall.png";
        assert_eq!(beside.find("", &long).as_deref(), Some("Wall.PNG"));
    }

    #[cfg(unix)]
    #[test]
    fn model_folder_does_not_follow_links_to_the_outside() {
        use std::os::unix::fs::symlink;
        let folder = TempFolder::new("links", &["models/real.png", "outside/secret.png"]);
        let models = folder.0.join("models");
        symlink(folder.0.join("outside/secret.png"), models.join("linked.png")).unwrap();
        symlink(folder.0.join("outside"), models.join("maps")).unwrap();
        symlink("real.png", models.join("same.png")).unwrap();
        let model = models.join("a.obj");
        let beside = ModelFolder::of(&model);
        for name in ["linked.png", "LINKED.png", "maps/secret.png", "C:\\maps\\secret.png"] {
            assert_eq!(beside.find("", name), None, "{name}");
        }
        for name in ["linked.png", "maps/secret.png"] {
            let error = read_from_model_folder(&model, name).unwrap_err().to_string();
            assert!(error.contains("is a link out of the model's folder"), "{error}");
        }
        assert_eq!(beside.find("", "SAME.PNG").as_deref(), Some("same.png"));
        assert_eq!(read_from_model_folder(&model, "same.png").unwrap(), b"models/real.png");
    }
}
