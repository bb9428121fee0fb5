//! The one error of the crate: which file, which place in it, what is wrong, what to do.

use std::fmt;
use std::path::{Path, PathBuf};

/// Why an input was refused.
///
/// Shown as `FILE: PLACE: MESSAGE; REMEDY`, leaving out what is not known. Defects of a model
/// that can be drawn around are not errors: they are counted as [`crate::scene::Warnings`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Error {
    /// The file that is wrong, as the caller named it.
    pub file: Option<PathBuf>,
    /// The place in it: `line 12`, `byte 80`, `accessor 3`, `key lines.crease_deg`.
    pub place: Option<String>,
    /// What is wrong.
    pub message: String,
    /// What the reader can do about it.
    pub remedy: Option<String>,
}

impl Error {
    /// An error that knows only what is wrong.
    pub fn new(message: impl Into<String>) -> Self {
        Self { file: None, place: None, message: message.into(), remedy: None }
    }

    /// Names the file the error is about.
    #[must_use]
    pub fn in_file(mut self, file: impl AsRef<Path>) -> Self {
        self.file = Some(file.as_ref().to_path_buf());
        self
    }

    /// Names the place inside the file.
    #[must_use]
    pub fn at(mut self, place: impl Into<String>) -> Self {
        self.place = Some(place.into());
        self
    }

    /// Says what to do.
    #[must_use]
    pub fn remedy(mut self, remedy: impl Into<String>) -> Self {
        self.remedy = Some(remedy.into());
        self
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(file) = &self.file {
            write!(f, "{}: ", file.display())?;
        }
        if let Some(place) = &self.place {
            write!(f, "{place}: ")?;
        }
        write!(f, "{}", self.message)?;
        if let Some(remedy) = &self.remedy {
            write!(f, "; {remedy}")?;
        }
        Ok(())
    }
}

impl std::error::Error for Error {}
