//! Defects that were drawn around: counted and named, never fatal.

use std::collections::BTreeMap;
use std::fmt;

/// Counts of defects by their description, in the order of the alphabet.
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

    /// Adds a whole sentence, once.
    pub fn note(&mut self, sentence: impl Into<String>) {
        let sentence = sentence.into();
        if !self.notes.contains(&sentence) {
            self.notes.push(sentence);
        }
    }

    /// Takes over the warnings of another stage.
    pub fn extend(&mut self, other: &Self) {
        for (what, n) in &other.counts {
            self.count(what.clone(), *n);
        }
        for sentence in &other.notes {
            self.note(sentence.clone());
        }
    }

    /// Whether nothing was amiss.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.counts.is_empty() && self.notes.is_empty()
    }

    /// One line a warning: `14 non-manifold edges`.
    #[must_use]
    pub fn lines(&self) -> Vec<String> {
        let counted = self.counts.iter().map(|(what, n)| format!("{n} {what}"));
        counted.chain(self.notes.iter().cloned()).collect()
    }
}

impl fmt::Display for Warnings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.lines().join("; "))
    }
}
