//! `ligne page --new`: a page file to start from, with a word on each key.

use std::path::Path;

use crate::cli::output::{Staging, check_place};
use crate::cli::say;
use crate::error::Error;

/// Writes a page file of that kind; one that is there stays.
pub(super) fn write(kind: &str, out: &Path, quiet: bool) -> Result<(), Error> {
    check_place(out)?;
    if out.exists() {
        return Err(Error::new("this file is there already")
            .in_file(out)
            .remedy("give the page file another name, or remove the old one"));
    }
    let text = text(kind);
    let mut staging = Staging::default();
    staging.add(out, text.as_bytes())?;
    staging.commit()?;
    if !quiet {
        say(&format!("{}: `ligne page {}` draws it", out.display(), out.display()));
    }
    Ok(())
}

fn text(kind: &str) -> String {
    match kind {
        "sheet" => "[page]\nkind = \"sheet\"\n".to_owned(),
        _ => "[page]\nkind = \"comic\"\n".to_owned(),
    }
}
