//! [`PageSource`]: the text and path of a page file, for errors with a position and for relative paths.

use std::ops::Range;
use std::path::{Path, PathBuf};

use toml::Spanned;

use super::model_reader::ModelReader;
use crate::error::Error;
use crate::error::nearest::{nearest, suggestion};
use crate::style::sheet_errors;
use crate::style::toml_reader::TomlFault;

/// The text of a page file and its path.
#[derive(Debug, Clone)]
pub struct PageSource {
    /// The path as the caller gave it.
    pub path: PathBuf,
    /// The text.
    pub text: String,
    /// Reader for models in formats that ligne does not support itself.
    pub models: ModelReader,
}

impl PageSource {
    /// An error at a position in the file, with the line, a caret and advice.
    #[must_use]
    pub fn fault(&self, span: &Range<usize>, message: &str, advice: &str) -> Error {
        sheet_errors::at_span(&self.text, span, message, Some(advice)).in_file(&self.path)
    }

    /// Returns an error at the first key whose value is not right.
    ///
    /// # Errors
    /// If there is such a key.
    pub(crate) fn check<'k, T: 'k>(
        &self,
        keys: impl IntoIterator<Item = &'k Spanned<T>>,
        is_right: impl Fn(&T) -> bool,
        message: &str,
        advice: &str,
    ) -> Result<(), Error> {
        let wrong = keys.into_iter().find(|key| !is_right(key.get_ref()));
        wrong.map_or(Ok(()), |key| Err(self.fault(&key.span(), message, advice)))
    }

    /// An error from reading the file.
    pub(crate) fn read_error(&self, error: &TomlFault) -> Error {
        sheet_errors::in_sheet(&self.text, error).in_file(&self.path)
    }

    /// An error about something that the file names. It is reported at that position, unless it already names
    /// a file.
    #[must_use]
    pub fn about(&self, span: &Range<usize>, error: Error) -> Error {
        match &error.file {
            Some(_) => error,
            None => {
                let place = error.place.as_ref().map(|place| format!("{place}: ")).unwrap_or_default();
                let advice = error.remedy.as_deref().unwrap_or("check this line");
                self.fault(span, &format!("{place}{}", error.message), advice)
            }
        }
    }

    /// An error about texts of the file. It is reported at the first text that is found in the file.
    #[must_use]
    pub fn about_text<'a>(&self, texts: impl IntoIterator<Item = &'a String>, error: Error) -> Error {
        let lines = texts.into_iter().filter_map(|text| text.lines().find(|line| !line.trim().is_empty()));
        let found = lines.filter_map(|line| Some((self.text.find(line)?, line))).next();
        match found {
            Some((at, line)) if error.file.is_none() => self.about(&(at..at + line.len()), error),
            _ => error,
        }
    }

    /// An error about an unknown word; it names the nearest known word or all of them.
    #[must_use]
    pub fn unknown(&self, word: &Spanned<String>, what: &str, known: &[&str]) -> Error {
        let advice = suggestion(nearest(word.get_ref(), known), || format!("there are {}", known.join(", ")));
        self.fault(&word.span(), &format!("there is no {what} `{}`", word.get_ref()), &advice)
    }

    /// An error at a position within a text of the file; `place` is in bytes of that text.
    #[must_use]
    pub fn within(&self, text: &Spanned<String>, place: &Range<usize>, message: &str, advice: &str) -> Error {
        let span = text.span();
        // A text with escapes does not occur literally in the file.
        let raw = self.text.get(span.clone()).unwrap_or_default();
        let start = raw.find(text.get_ref().as_str()).map(|start| span.start + start);
        let place = start.map_or(span, |start| start + place.start..start + place.end);
        self.fault(&place, message, advice)
    }

    /// A path relative to the folder of the file.
    #[must_use]
    pub fn resolve(&self, path: &str) -> PathBuf {
        self.folder().join(path)
    }

    /// The folder of the file.
    #[must_use]
    pub fn folder(&self) -> &Path {
        self.path.parent().unwrap_or(Path::new(""))
    }

    /// The path of a file that must exist, relative to the folder of the page file.
    ///
    /// # Errors
    /// Returns an error if there is no such file.
    pub fn existing(&self, path: &Spanned<String>, what: &str) -> Result<PathBuf, Error> {
        let found = self.resolve(path.get_ref());
        if found.is_file() {
            return Ok(found);
        }
        let message = format!("there is no {what} `{}`", path.get_ref());
        let folder = match self.folder() {
            folder if folder == Path::new("") => "the working folder".to_owned(),
            folder => folder.display().to_string(),
        };
        let advice = format!("paths are relative to the folder of the page file, {folder}");
        Err(self.fault(&path.span(), &message, &advice))
    }
}
