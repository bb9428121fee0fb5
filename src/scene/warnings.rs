//! [`Warnings`]: defects of a model that did not prevent drawing, counted by kind.

use std::collections::BTreeMap;
use std::fmt;

/// Counts of defects by description, in alphabetical order, and further notes.
///
/// ```
/// let mut warnings = ligne::scene::Warnings::default();
/// warnings.count("triangles without area", 3);
/// warnings.count("triangles without area", 2);
/// assert_eq!(warnings.lines(), ["5 triangles without area"]);
/// ```
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Warnings {
    counts: BTreeMap<String, u64>,
    notes: Vec<String>,
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
        let sentence = sentence.into();
        if !self.notes.contains(&sentence) {
            self.notes.push(sentence);
        }
    }

    /// Adds the warnings of another stage.
    pub fn extend(&mut self, other: &Self) {
        for (what, n) in &other.counts {
            self.count(what.clone(), *n);
        }
        for sentence in &other.notes {
            self.note(sentence.clone());
        }
    }

    /// Whether there are no warnings.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.counts.is_empty() && self.notes.is_empty()
    }

    /// One line per warning: `14 non-manifold edges`.
    #[must_use]
    pub fn lines(&self) -> Vec<String> {
        let counted = self.counts.iter().map(|(what, n)| format!("{n} {what}"));
        counted.chain(self.notes.iter().cloned()).collect()
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
