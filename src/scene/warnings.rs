//! [`Warnings`]: defects of a model that did not prevent drawing, counted by kind.

use std::collections::BTreeMap;
use std::fmt;

/// Kind of a warning.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum WarningKind {
    /// Elements that are damaged, repaired or left out, with their number.
    Defect,
    /// A file that the model names was not found, or another one was used in its place.
    MissingFile,
    /// The drawing shows nothing; the text says why.
    EmptyDrawing,
    /// Anything else.
    Note,
}

/// One warning.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Warning {
    /// Its kind.
    pub kind: WarningKind,
    /// Number of elements of a defect; 1 for other kinds.
    pub count: u64,
    /// Description: for a defect the elements in the plural, `triangles without area`, otherwise a sentence.
    pub text: String,
}

impl Warning {
    /// A warning of one kind that counts nothing.
    pub(crate) fn of_kind(kind: WarningKind, text: impl Into<String>) -> Self {
        Self { kind, count: 1, text: text.into() }
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.kind {
            WarningKind::Defect => write!(f, "{} {}", self.count, self.text),
            _ => f.write_str(&self.text),
        }
    }
}

/// Counts of defects by description, in alphabetical order, and further notes.
///
/// ```
/// use ligne::scene::{WarningKind, Warnings};
///
/// let mut warnings = Warnings::default();
/// warnings.count("triangles without area", 3);
/// warnings.count("triangles without area", 2);
/// assert_eq!(warnings.lines(), ["5 triangles without area"]);
/// assert!(warnings.iter().all(|warning| warning.kind == WarningKind::Defect && warning.count == 5));
/// ```
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Warnings {
    counts: BTreeMap<String, u64>,
    notes: Vec<(WarningKind, String)>,
}

/// Adds the items that a list lacks.
pub(crate) fn add_new<T: PartialEq>(list: &mut Vec<T>, items: impl IntoIterator<Item = T>) {
    for item in items {
        if !list.contains(&item) {
            list.push(item);
        }
    }
}

impl Warnings {
    /// Adds `n` defects of one kind, described in the plural: `triangles without area`.
    pub fn count(&mut self, what: impl Into<String>, n: u64) {
        if n > 0 {
            *self.counts.entry(what.into()).or_default() += n;
        }
    }

    /// Adds a sentence, once.
    pub fn note(&mut self, sentence: impl Into<String>) {
        add_new(&mut self.notes, [(WarningKind::Note, sentence.into())]);
    }

    /// Adds a sentence about a file that is not there, once.
    pub(crate) fn missing_file(&mut self, sentence: impl Into<String>) {
        add_new(&mut self.notes, [(WarningKind::MissingFile, sentence.into())]);
    }

    /// All warnings: defects first.
    pub fn iter(&self) -> impl Iterator<Item = Warning> + '_ {
        let defect = |(text, count): (&String, &u64)| Warning {
            kind: WarningKind::Defect,
            count: *count,
            text: text.clone(),
        };
        let note = |(kind, text): &(WarningKind, String)| Warning::of_kind(*kind, text.as_str());
        self.counts.iter().map(defect).chain(self.notes.iter().map(note))
    }

    /// Adds the warnings of another stage.
    pub fn extend(&mut self, other: &Self) {
        for (what, n) in &other.counts {
            self.count(what.clone(), *n);
        }
        add_new(&mut self.notes, other.notes.iter().cloned());
    }

    /// Whether there are no warnings.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.counts.is_empty() && self.notes.is_empty()
    }

    /// One line per warning: `14 non-manifold edges`.
    #[must_use]
    pub fn lines(&self) -> Vec<String> {
        self.iter().map(|warning| warning.to_string()).collect()
    }
}

/// Defects of one kind in a file. The first is described with its location; the others are only counted, so
/// a file with many defects gives one short warning.
#[derive(Debug, Clone, Default)]
pub(crate) struct WarningExamples {
    first: Option<String>,
    others: u64,
}

impl WarningExamples {
    /// Adds a defect; the sentence is built only for the first.
    pub(crate) fn add(&mut self, sentence: impl FnOnce() -> String) {
        match self.first {
            None => self.first = Some(sentence()),
            Some(_) => self.others += 1,
        }
    }

    /// Description of the defects, if there are any.
    pub(crate) fn sentence(self) -> Option<String> {
        let first = self.first?;
        Some(match self.others {
            0 => first,
            others => format!("{first}; {others} more like it"),
        })
    }

    /// Adds the description to warnings, if there are any defects.
    pub(crate) fn warn(self, warnings: &mut Warnings) {
        if let Some(sentence) = self.sentence() {
            warnings.note(sentence);
        }
    }
}

impl fmt::Display for Warnings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.lines().join("; "))
    }
}
