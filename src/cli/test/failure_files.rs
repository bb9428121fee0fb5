//! Files for inspection: actual drawings and difference pictures of failing cases.

use std::fs;
use std::path::{Path, PathBuf};

use super::case_outcome::CaseOutcome;
use crate::cli::output::output_files::Staging;
use crate::error::Error;

/// Name endings of these files. Approved drawings never have them.
pub(crate) const FAILURE_FILE_ENDINGS: [&str; 2] = [".actual.svg", ".diff.svg"];

/// Writes the drawings of failing cases to a folder, and removes old files of cases that pass.
pub(crate) fn write_failures(
    folder: &Path,
    outcomes: &[CaseOutcome<'_>],
    passed: impl Fn(&CaseOutcome<'_>) -> bool,
) -> Result<(), Error> {
    let mut staging = Staging::default();
    for outcome in outcomes {
        let place = |end: &str| -> PathBuf { folder.join(format!("{}{end}", outcome.case.name)) };
        let texts =
            if passed(outcome) { [None, None] } else { [outcome.after.clone(), outcome.difference()] };
        for (end, text) in FAILURE_FILE_ENDINGS.into_iter().zip(texts) {
            let path = place(end);
            match text {
                None => {
                    // The file may not exist. Failures are ignored.
                    let _ = fs::remove_file(&path);
                }
                Some(text) => {
                    let inner = path.parent().unwrap_or(folder);
                    fs::create_dir_all(inner).map_err(|error| {
                        Error::new(format!("cannot create this folder: {error}"))
                            .in_file(inner)
                            .remedy("check the path")
                    })?;
                    staging.add(&path, text.as_bytes())?;
                }
            }
        }
    }
    staging.commit()
}
