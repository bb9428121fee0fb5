//! `ligne page --new`: commented page files to start from, with the models they show.

use std::path::Path;

use crate::cli::output::output_files::{Staging, check_place};
use crate::cli::say;
use crate::error::Error;

/// Model file that is written next to the page file: name and bytes.
type ModelFile = (&'static str, &'static [u8]);

/// Page file of a comic page, with its models.
const COMIC: (&str, &[ModelFile]) = (
    include_str!("new-comic.toml"),
    &[
        ("example-crane.glb", include_bytes!("../../../examples/models/crane.glb")),
        ("example-goose.obj", include_bytes!("../../../examples/models/goose.obj")),
    ],
);

/// Page file of a technical sheet, with its models.
const SHEET: (&str, &[ModelFile]) = (
    include_str!("new-sheet.toml"),
    &[("example-pump.glb", include_bytes!("../../../examples/models/pump.glb"))],
);

/// Writes a page file of a kind, and its models next to it. Existing models stay unchanged.
pub(crate) fn write(kind: &str, out: &Path, quiet: bool) -> Result<(), Error> {
    check_place(out)?;
    if out.exists() {
        return Err(Error::new("the file exists already")
            .in_file(out)
            .remedy("choose another name, or remove the file"));
    }
    let (text, models) = if kind == "sheet" { SHEET } else { COMIC };
    let mut staging = Staging::default();
    staging.add(out, text.as_bytes())?;
    let missing = models.iter().map(|(name, bytes)| (out.with_file_name(name), bytes));
    let missing: Vec<_> = missing.filter(|(path, _)| !path.exists()).collect();
    for (path, bytes) in &missing {
        staging.add(path, bytes)?;
    }
    staging.commit()?;
    if !quiet {
        let beside: Vec<String> = missing.iter().map(|(path, _)| path.display().to_string()).collect();
        let beside = if beside.is_empty() { String::new() } else { format!(", with {}", beside.join(", ")) };
        say(&format!("{}{beside}: `ligne page {}` draws it", out.display(), out.display()));
    }
    Ok(())
}
