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

pub(crate) mod composition;
mod flat_composition;
pub(crate) mod hotspot;
pub(crate) mod length;
pub(crate) mod mark;
mod mark_transform;
pub(crate) mod page;
pub(crate) mod region_clip;
#[cfg(feature = "cli")]
pub(crate) mod stroke_font;
pub(crate) mod text_run;

pub use crate::colour::pixel_picture::Picture;
pub use composition::{Composition, PlacedDrawing, PrintBoxes};
pub use hotspot::Hotspot;
pub use length::Length;
pub use mark::{
    Cap, Gradient, ImagePaint, ImagePiece, Join, Mark, OutlinePaint, Paint, PieceContent, Provenance,
    StrokePaint,
};
pub use page::{Page, Unit};
pub use text_run::{FontFile, SetGlyph, TextRun};

use crate::scene::Warning;

/// Kinds of layers, back to front.
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
    /// The grain of the paper, which shows through all layers below.
    Tooth,
    /// Call-outs.
    Callouts,
}

impl LayerKind {
    /// Id of the layer's group in SVG.
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

/// A layer: marks that are painted in order.
#[derive(Debug, Clone, PartialEq)]
pub struct Layer {
    /// Kind of the layer.
    pub kind: LayerKind,
    /// Its pen, if the drawing has one layer per pen: `1 0.35 mm #1a1a1a`.
    pub pen: Option<String>,
    /// Whether order and direction of the marks matter, for example for a short pen path. Otherwise marks may
    /// be reordered and reversed if that does not change the picture.
    pub ordered: bool,
    /// Its marks in painting order.
    pub marks: Vec<Mark>,
}

/// A 2-D document: a page with layers of marks, back to front. Empty layers are absent.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Drawing {
    /// Title shown by viewers: the name of the model.
    pub title: String,
    /// Size and unit.
    pub page: Page,
    /// Layers, back to front.
    pub layers: Vec<Layer>,
    /// Visible areas of parts, for clicks on web pages; SVG only.
    pub hotspots: Vec<Hotspot>,
    /// Defects of the model, and what could not be drawn. They are not written to files.
    pub warnings: Vec<Warning>,
}

impl Drawing {
    /// A drawing without warnings.
    #[must_use]
    pub fn new(title: impl Into<String>, page: Page, layers: Vec<Layer>) -> Self {
        Self { title: title.into(), page, layers, hotspots: Vec::new(), warnings: Vec::new() }
    }
}
