//! [`Page`]: size, unit and background of a drawing.

use serde::{Deserialize, Serialize};

use crate::colour::srgb::Colour;

/// Unit of a drawing's coordinates.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Unit {
    /// CSS pixels, 96 to the inch.
    #[default]
    Px,
    /// Millimetres.
    Mm,
}

impl Unit {
    /// `px` or `mm`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Px => "px",
            Self::Mm => "mm",
        }
    }
}

/// The page of a drawing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Page {
    /// Width in user units.
    pub width: f64,
    /// Height in user units.
    pub height: f64,
    /// Unit of all coordinates.
    pub unit: Unit,
    /// Background colour; `None` for transparent.
    pub background: Option<Colour>,
}

impl Page {
    /// A transparent page in px.
    #[must_use]
    pub const fn px(width: f64, height: f64) -> Self {
        Self { width, height, unit: Unit::Px, background: None }
    }

    /// A transparent page in millimetres.
    #[must_use]
    pub const fn mm(width: f64, height: f64) -> Self {
        Self { width, height, unit: Unit::Mm, background: None }
    }
}
