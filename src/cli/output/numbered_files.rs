//! [`NumberedFiles`]: numbered file names such as `frames/%04d.svg`.

use std::path::{Path, PathBuf};

use super::output_files::{Format, Output};
use crate::error::Error;

/// Numbered files.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct NumberedFiles {
    /// Folder of the files; empty for the working folder.
    pub(crate) folder: PathBuf,
    before: String,
    digits: usize,
    after: String,
    pub(crate) format: Format,
}

impl NumberedFiles {
    /// Reads a numbered file name; none if it has no number. `what` names the numbered thing in errors.
    pub(crate) fn of(
        path: &Path,
        what: &str,
        wrong: impl Fn(String) -> Error,
    ) -> Result<Option<Self>, Error> {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let folder = path.parent().unwrap_or(Path::new("")).to_path_buf();
        if folder.to_string_lossy().contains('%') {
            return Err(wrong(format!(
                "the number of {what} must be in the file name, not in the folder name"
            )));
        }
        if !name.contains('%') {
            return Ok(None);
        }
        let number = number_in(&name)
            .ok_or_else(|| wrong(format!("`{name}` has no place for the number of {what}")))?;
        let [before, digits, after] = number;
        let format = Output::new(PathBuf::from(&name))?.format;
        let digits = digits.parse().unwrap_or(0);
        Ok(Some(Self { folder, before, digits, after, format }))
    }

    /// Path of a frame or page.
    pub(crate) fn path(&self, frame: usize) -> PathBuf {
        let Self { before, digits, after, .. } = self;
        self.folder.join(format!("{before}{frame:0digits$}{after}"))
    }
}

/// Splits a name at `%04d` or `%d`: the text before it, the number of digits, and the text after it. `%%` is
/// a percent sign.
fn number_in(name: &str) -> Option<[String; 3]> {
    let mut parts = [String::new(), String::new()];
    let mut digits = None;
    let mut rest = name;
    while let Some((before, after)) = rest.split_once('%') {
        let part = parts.get_mut(usize::from(digits.is_some()))?;
        part.push_str(before);
        if let Some(after) = after.strip_prefix('%') {
            part.push('%');
            rest = after;
            continue;
        }
        let (own, after) = after.split_once('d')?;
        let padded = own.strip_prefix('0').is_some_and(|width| matches!(width.parse(), Ok(1..=9_u8)));
        if digits.is_some() || !(own.is_empty() || padded) {
            return None;
        }
        digits = Some(own.trim_start_matches('0').to_owned());
        rest = after;
    }
    let [before, mut after] = parts;
    after.push_str(rest);
    Some([before, digits?, after])
}
