//! Options of SVG.

use crate::colour::srgb::Colour;
use crate::drawing::Unit;

/// Meaning of the groups in the document.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum Grouping {
    /// Layers, back to front.
    #[default]
    Layer,
    /// One group for each part of the model, for hot-spots.
    Part,
}

/// Options of SVG.
///
/// ```
/// use ligne::export::{Grouping, SvgOptions};
///
/// let options = SvgOptions::default().with_precision(1).with_id_prefix("fig-1-").grouped_by(Grouping::Part);
/// assert_eq!(options.precision, Some(1));
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct SvgOptions {
    /// Decimals of coordinates, at most 8. Default: 2 for pixels, 3 for millimetres.
    pub precision: Option<u8>,
    /// Prefix of all ids, so that several drawings can share a page. Default: empty.
    pub id_prefix: String,
    /// Meaning of the groups. Default: layers.
    pub group: Grouping,
    /// Colour written as `currentColor`, so that it takes the colour of the surrounding text. Default: none.
    pub ink: Option<Colour>,
    /// Description of the drawing in one or more sentences. Default: none.
    pub desc: Option<String>,
    /// Whether the drawing has a role, title and description for screen readers. Default: no.
    pub read_aloud: bool,
}

impl SvgOptions {
    /// Sets the decimals of coordinates, at most 8.
    #[must_use]
    pub fn with_precision(self, decimals: u8) -> Self {
        Self { precision: Some(decimals), ..self }
    }

    /// Sets the prefix of all ids.
    #[must_use]
    pub fn with_id_prefix(self, prefix: impl Into<String>) -> Self {
        Self { id_prefix: prefix.into(), ..self }
    }

    /// Sets the meaning of the groups.
    #[must_use]
    pub fn grouped_by(self, group: Grouping) -> Self {
        Self { group, ..self }
    }

    /// Writes marks of this colour in the colour of the surrounding text.
    #[must_use]
    pub fn with_current_ink(self, ink: Colour) -> Self {
        Self { ink: Some(ink), ..self }
    }

    /// Adds a role and a description, which may be empty, for screen readers. The drawing is one picture, or
    /// a group of buttons if it has hot-spots.
    #[must_use]
    pub fn read_aloud(self, desc: impl Into<String>) -> Self {
        Self { desc: Some(desc.into()), read_aloud: true, ..self }
    }

    /// Decimals of the coordinates of a drawing in this unit.
    #[must_use]
    pub fn decimals(&self, unit: Unit) -> u8 {
        self.precision.unwrap_or(match unit {
            Unit::Px => 2,
            Unit::Mm => 3,
        })
    }
}
