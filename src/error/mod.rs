//! [`Error`], the error type of the crate: kind, file, place, message and remedy.
//!
//! Files:
//! - [`bounded_read`]: reads files that are not too large.
//! - [`messages`]: rewrites messages of the TOML and JSON parsers in plain words.
//! - [`nearest`]: finds the known word nearest to a misspelt one.
//! - [`spelling`]: maps American to British spelling of keys and options.

#[cfg(feature = "page")]
pub(crate) mod bounded_read;
pub(crate) mod messages;
pub(crate) mod nearest;
pub(crate) mod spelling;

use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Kind of an error, for programs that react to it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[non_exhaustive]
pub enum ErrorKind {
    /// The input is wrong: a damaged file, a value out of range, an unknown key.
    #[default]
    Invalid,
    /// A file could not be read or written.
    Io,
    /// The input may be correct, but ligne cannot read or write it, or was built without this feature.
    Unsupported,
    /// There is nothing to draw.
    Empty,
    /// A function of the program cancelled the drawing.
    Cancelled,
}

/// Error about an input or output.
///
/// Displayed as `FILE: PLACE: MESSAGE; REMEDY`, without missing fields. Defects of a model that can still be
/// drawn are not errors. They are counted as [`crate::scene::Warnings`].
///
/// ```
/// use ligne::{ErrorKind, Scene};
///
/// let error = Scene::open("lid.obj").unwrap_err();
/// assert_eq!(error.kind, ErrorKind::Io);
/// assert!(error.to_string().starts_with("lid.obj: cannot be read: "));
/// assert!(std::error::Error::source(&error).is_some());
/// ```
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Error {
    /// Kind of the error.
    pub kind: ErrorKind,
    /// File with the error, as named by the caller.
    pub file: Option<PathBuf>,
    /// Position in the file: `line 12`, `byte 80`, `accessor 3`, `key lines.crease_deg`.
    pub place: Option<String>,
    /// Description of the error.
    pub message: String,
    /// Action that fixes it.
    pub remedy: Option<String>,
    /// Underlying error.
    source: Option<Arc<dyn std::error::Error + Send + Sync>>,
}

impl Error {
    /// Error of the kind `Invalid` with a message only.
    pub fn new(message: impl Into<String>) -> Self {
        let kind = ErrorKind::Invalid;
        Self { kind, file: None, place: None, message: message.into(), remedy: None, source: None }
    }

    /// Error of reading or writing: the attempted action and its cause.
    pub fn io(tried: impl fmt::Display, error: std::io::Error) -> Self {
        let message = format!("{tried}: {error}");
        Self { kind: ErrorKind::Io, source: Some(Arc::new(error)), ..Self::new(message) }
    }

    /// Reads the text of a file; `what` names the file in the advice.
    #[cfg(feature = "page")]
    pub(crate) fn utf8_text(bytes: Vec<u8>, path: &Path, what: &str) -> Result<String, Self> {
        String::from_utf8(bytes).map_err(|error| {
            Self::new("is not UTF-8 text")
                .in_file(path)
                .at(format!("byte {}", error.utf8_error().valid_up_to()))
                .remedy(format!("save {what} as UTF-8"))
        })
    }

    /// Error of the JSON parser with its line and column. `what` precedes the message; it may be empty.
    pub(crate) fn json(what: &str, error: &serde_json::Error) -> Self {
        let message = error.to_string();
        // The parser ends its message with the position.
        let message = message.rsplit_once(" at line ").map_or(&*message, |(message, _)| message);
        let messages::Explained { message, advice, .. } = messages::explain(message);
        let made = Self::new(if what.is_empty() { message } else { format!("{what}: {message}") });
        let made = match error.line() {
            0 => made,
            line => made.at(format!("line {line}, column {}", error.column())),
        };
        // The advice about a missing key is written for TOML.
        let missing = |advice: &str| Some(advice.strip_prefix("add ")?.strip_suffix(" = …")?.to_owned());
        match advice {
            Some(advice) => made.remedy(missing(&advice).map_or(advice, |key| format!("add \"{key}\": …"))),
            None => made,
        }
    }

    /// Sets the kind.
    #[must_use]
    pub fn of_kind(mut self, kind: ErrorKind) -> Self {
        self.kind = kind;
        self
    }

    /// Sets the file.
    #[must_use]
    pub fn in_file(mut self, file: impl AsRef<Path>) -> Self {
        self.file = Some(file.as_ref().to_path_buf());
        self
    }

    /// Sets the file, unless the error names one already.
    #[must_use]
    pub(crate) fn or_in_file(self, file: impl AsRef<Path>) -> Self {
        if self.file.is_some() { self } else { self.in_file(file) }
    }

    /// Sets the position in the file.
    #[must_use]
    pub fn at(mut self, place: impl Into<String>) -> Self {
        self.place = Some(place.into());
        self
    }

    /// Puts an enclosing element before the position: `accessor 3` before `bufferView 1`.
    #[must_use]
    pub(crate) fn within(self, holder: impl Into<String>) -> Self {
        let holder = holder.into();
        let place = self.place.as_ref().map_or_else(|| holder.clone(), |place| format!("{holder}: {place}"));
        self.at(place)
    }

    /// Sets the remedy.
    #[must_use]
    pub fn remedy(mut self, remedy: impl Into<String>) -> Self {
        self.remedy = Some(remedy.into());
        self
    }
}

/// Compares everything except the underlying error.
impl PartialEq for Error {
    fn eq(&self, other: &Self) -> bool {
        let said = |e: &Self| (e.kind, e.file.clone(), e.place.clone(), e.message.clone(), e.remedy.clone());
        said(self) == said(other)
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

impl std::error::Error for Error {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        self.source.as_deref().map(|source| source as _)
    }
}
