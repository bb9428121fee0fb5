//! Label of a mark, from the attributes in its file.

use std::fmt;
use std::sync::Arc;

/// Identity of a mark: layer, classes and part of the model. Files of other programs have at most layers and
/// classes.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord, Default)]
pub struct Label {
    /// Id of the layer's group, such as `lines`; empty outside layers.
    pub layer: Arc<str>,
    /// Name of the drawing on a page of several drawings.
    pub drawing: Option<Arc<str>>,
    /// Classes in alphabetical order, without the tone.
    pub classes: Vec<Arc<str>>,
    /// Name of the part.
    pub part: Option<Arc<str>>,
}

impl Label {
    /// Kind of the mark in one word: its first class other than `silhouette`, or else its layer.
    #[must_use]
    pub fn kind(&self) -> &str {
        let class = self.classes.iter().find(|class| class.as_ref() != "silhouette").or(self.classes.first());
        match class {
            Some(class) => class,
            None if self.layer.is_empty() => "mark",
            None => &self.layer,
        }
    }

    /// Name of the part as displayed.
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
