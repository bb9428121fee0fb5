//! [`SvgOptions`]: how SVG is written.

use crate::colour::srgb::Colour;
use crate::drawing::Unit;

/// What the groups of the document are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum Grouping {
    /// Layers, back to front.
    #[default]
    Layer,
    /// One group for each part of the model, for hot-spots.
    Part,
}

/// How SVG is written.
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
    /// Put before every id, so that several drawings fit into one page. Default: empty.
    pub id_prefix: String,
    /// What the groups are. Default: layers.
    pub group: Grouping,
    /// A colour that is written as `currentColor`: the drawing then takes that of the text around it. Default: none.
    pub ink: Option<Colour>,
    /// What is seen in the drawing, in a sentence or more. Default: nothing.
    pub desc: Option<String>,
    /// Whether readers of screens are told that the drawing is one picture, by its title and description. Default: no.
    pub read_aloud: bool,
}

impl SvgOptions {
    /// With so many decimals of coordinates, at most 8.
    #[must_use]
    pub fn with_precision(self, decimals: u8) -> Self {
        Self { precision: Some(decimals), ..self }
    }

    /// With this before every id.
    #[must_use]
    pub fn with_id_prefix(self, prefix: impl Into<String>) -> Self {
        Self { id_prefix: prefix.into(), ..self }
    }

    /// With these groups.
    #[must_use]
    pub fn grouped_by(self, group: Grouping) -> Self {
        Self { group, ..self }
    }

    /// With what is of this colour in that of the text around the drawing.
    #[must_use]
    pub fn with_current_ink(self, ink: Colour) -> Self {
        Self { ink: Some(ink), ..self }
    }

    /// As one picture for screen readers, with a description, which may be empty. With hot-spots it is a group of buttons.
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
