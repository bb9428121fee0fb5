//! [`Drawing`]: a 2-D document of painted paths, all that an exporter needs. It contains nothing of the 3-D
//! scene.
//!
//! Files, in reading order: [`page`] (size and unit), [`length`], [`mark`] (one painted path), [`text_run`]
//! (its words), [`hotspot`] (clickable areas), [`composition`] (several drawings on one page);
//! `mark_transform`, `region_clip` (clipping) and `flat_composition` (a composition as one drawing);
//! `stroke_font` (single-stroke letters).
//!
//! ```
//! use ligne::SvgOptions;
//! use ligne::drawing::{Drawing, Page, Unit};
//!
//! let page = Page { width: 210.0, height: 297.0, unit: Unit::Mm, background: None };
//! let sheet = Drawing::new("empty sheet", page, Vec::new());
//! assert!(sheet.to_svg(&SvgOptions::default()).contains(r#"width="210mm""#));
//! ```

pub mod composition;
mod flat_composition;
pub mod hotspot;
pub mod length;
pub mod mark;
mod mark_transform;
pub mod page;
pub(crate) mod region_clip;
#[cfg(feature = "cli")]
pub(crate) mod stroke_font;
pub mod text_run;

pub use composition::{Boxes, Composition, Item};
pub use hotspot::Hotspot;
pub use length::Length;
pub use mark::{
    Cap, Gradient, ImagePaint, ImagePiece, Join, Mark, OutlinePaint, Paint, Provenance, Shows, StrokePaint,
};
pub use page::{Page, Unit};
pub use text_run::{FontFile, SetGlyph, TextRun};

/// The layers of a drawing, back to front.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum LayerKind {
    /// The paper and its texture.
    Paper,
    /// Flat colour regions.
    Fills,
    /// Cast shadows.
    Shadows,
    /// Hatching.
    Hatching,
    /// Motion lines.
    Motion,
    /// Lines behind surfaces.
    HiddenLines,
    /// Visible lines.
    Lines,
    /// What shows of the paper through all that is drawn on it.
    Tooth,
    /// Call-outs.
    Callouts,
}

impl LayerKind {
    /// The group's id in SVG.
    #[must_use]
    pub const fn id(self) -> &'static str {
        match self {
            Self::Paper => "paper",
            Self::Fills => "fills",
            Self::Shadows => "shadows",
            Self::Hatching => "hatching",
            Self::Motion => "motion",
            Self::HiddenLines => "hidden-lines",
            Self::Lines => "lines",
            Self::Tooth => "tooth",
            Self::Callouts => "callouts",
        }
    }
}

/// One layer: marks painted in order.
#[derive(Debug, Clone, PartialEq)]
pub struct Layer {
    /// Which layer it is.
    pub kind: LayerKind,
    /// Which pen draws it, where the drawing has one layer a pen: `1 0.35 mm #1a1a1a`.
    pub pen: Option<String>,
    /// Whether its marks have an order and directions that matter, such as a short way for a pen; others may be
    /// exchanged and turned round where that changes nothing of what is seen.
    pub ordered: bool,
    /// Its marks, painted first to last.
    pub marks: Vec<Mark>,
}

/// A 2-D document: a page and layers of marks, back to front; empty layers are absent.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Drawing {
    /// Title, shown by viewers: the model's name.
    pub title: String,
    /// Size and unit.
    pub page: Page,
    /// Layers, back to front.
    pub layers: Vec<Layer>,
    /// Where parts are seen, for web pages to answer clicks; only SVG has them.
    pub hotspots: Vec<Hotspot>,
    /// What of the model could not be drawn as it is, in words; no file holds them.
    pub warnings: Vec<String>,
}

impl Drawing {
    /// A drawing without warnings.
    #[must_use]
    pub fn new(title: impl Into<String>, page: Page, layers: Vec<Layer>) -> Self {
        Self { title: title.into(), page, layers, hotspots: Vec::new(), warnings: Vec::new() }
    }
}
