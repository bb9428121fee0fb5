//! [`CaseFolder`]: cases of a folder, and drawings that belong to no case.

use std::fs;
use std::path::{Path, PathBuf};

use super::failure_files::FAILURE_FILE_ENDINGS;
use super::test_case::TestCase;
use crate::cli::request::draw_request::same_file;
use crate::error::Error;
use crate::geometry::names::glob::Glob;

/// Contents of a folder of cases.
#[derive(Debug, Default)]
pub(crate) struct CaseFolder {
    /// Cases, sorted by name.
    pub(crate) cases: Vec<TestCase>,
    /// SVG files that no case uses.
    pub(crate) orphans: Vec<PathBuf>,
}

impl CaseFolder {
    /// Reads all cases of a folder and its sub-folders, or a single case file. Keeps only cases whose name
    /// matches one of `only`, unless it is empty.
    pub(crate) fn read(path: &Path, only: &[Glob]) -> Result<Self, Error> {
        let mut found = FoundFiles::default();
        if path.is_dir() {
            found.search(path, "")?;
        } else if !path.exists() {
            return Err(Error::new("there is no such folder").in_file(path).remedy("check the path"));
        } else {
            let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            found.cases.push((name, path.to_path_buf()));
        }
        found.cases.sort();
        found.drawings.sort();
        let mut folder = Self::default();
        for (name, path) in found.cases {
            folder.cases.push(TestCase::read(name, &path));
        }
        folder.refuse_shared();
        let of_no_case =
            |drawing: &PathBuf| folder.cases.iter().all(|case| !same_file(&case.drawing, drawing));
        folder.orphans = found.drawings.into_iter().filter(of_no_case).collect();
        if folder.cases.is_empty() {
            return Err(Error::new("this folder contains no case")
                .in_file(path)
                .remedy("write a file such as gear.toml with model = \"gear.obj\", then approve its drawing with --bless"));
        }
        folder.cases.retain(|case| only.is_empty() || only.iter().any(|glob| glob.matches(&case.name)));
        if folder.cases.is_empty() {
            return Err(Error::new("no case has a matching name").at("--cases").in_file(path));
        }
        Ok(folder)
    }

    /// Refuses cases that share an approved drawing.
    fn refuse_shared(&mut self) {
        let shared = |i: usize| {
            let case = self.cases.get(i)?;
            let other_cases =
                self.cases.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, other_case)| other_case);
            let other_case =
                other_cases.into_iter().find(|other| same_file(&other.drawing, &case.drawing))?;
            Some(
                Error::new(format!("the case `{}` uses the same drawing", other_case.name))
                    .in_file(&case.drawing)
                    .remedy("give each case its own drawing"),
            )
        };
        let faults: Vec<Option<Error>> = (0..self.cases.len()).map(shared).collect();
        for (case, fault) in self.cases.iter_mut().zip(faults) {
            if let Some(error) = fault {
                case.order = Err(error);
            }
        }
    }
}

/// Files found in a folder.
#[derive(Debug, Default)]
struct FoundFiles {
    /// Name and path of each case file.
    cases: Vec<(String, PathBuf)>,
    drawings: Vec<PathBuf>,
}

impl FoundFiles {
    /// Searches a folder. `prefix` is its relative path for case names. Skips names that begin with `.` or
    /// `_`, and `ligne.toml`.
    fn search(&mut self, folder: &Path, prefix: &str) -> Result<(), Error> {
        let unread = |error: std::io::Error| {
            Error::io("cannot read the folder", error).in_file(folder).remedy("check the path")
        };
        for entry in fs::read_dir(folder).map_err(unread)? {
            let path = entry.map_err(unread)?.path();
            let file_name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            if file_name.starts_with(['.', '_']) || file_name == "ligne.toml" {
                continue;
            }
            // A linked folder could create a cycle.
            if path.is_dir() && !path.is_symlink() {
                self.search(&path, &format!("{prefix}{file_name}/"))?;
            } else if let Some(name) = file_name.strip_suffix(".toml") {
                self.cases.push((format!("{prefix}{name}"), path));
            } else if file_name.ends_with(".svg")
                && !FAILURE_FILE_ENDINGS.iter().any(|end| file_name.ends_with(end))
            {
                self.drawings.push(path);
            }
        }
        Ok(())
    }
}
