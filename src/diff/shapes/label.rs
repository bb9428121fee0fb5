//! [`Label`]: what a mark is, by what the file says of it.

use std::fmt;
use std::sync::Arc;

/// What a mark is: its layer, its classes and the part of the model that it belongs to. Foreign files have at most
/// layers and classes.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord, Default)]
pub struct Label {
    /// Id of the layer's group, such as `lines`; empty outside of layers.
    pub layer: Arc<str>,
    /// Which drawing of a page it is in; none outside of pages.
    pub drawing: Option<Arc<str>>,
    /// Classes in alphabetical order, but for the tone.
    pub classes: Vec<Arc<str>>,
    /// Name of the part.
    pub part: Option<Arc<str>>,
}

impl Label {
    /// The kind of the mark in a word: its first class that says more than `silhouette` does, or its layer.
    #[must_use]
    pub fn kind(&self) -> &str {
        let class = self.classes.iter().find(|class| class.as_ref() != "silhouette").or(self.classes.first());
        match class {
            Some(class) => class,
            None if self.layer.is_empty() => "mark",
            None => &self.layer,
        }
    }

    /// The part as it is shown.
    #[must_use]
    pub fn part_name(&self) -> &str {
        self.part.as_deref().unwrap_or("no part")
    }
}

impl fmt::Display for Label {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.kind())?;
        if let Some(part) = &self.part {
            write!(f, " of `{part}`")?;
        }
        if let Some(drawing) = &self.drawing {
            write!(f, " in `{drawing}`")?;
        }
        Ok(())
    }
}
