//! [`Composition`]: several drawings on one page, each placed and clipped.
//!
//! ```
//! use ligne::drawing::{Composition, Drawing, Page, PlacedDrawing};
//!
//! let panel = Drawing::new("panel", Page::mm(80.0, 60.0), Vec::new());
//! let place = kurbo::Affine::translate((10.0, 20.0));
//! let item = PlacedDrawing { name: "panel-1".to_owned(), drawing: panel, place, clip: None };
//! let composition = Composition::new("a page", Page::mm(210.0, 297.0), vec![item]);
//! assert_eq!(composition.items.len(), 1);
//! # use ligne::kurbo;
//! ```

use kurbo::{Affine, BezPath, Rect};

use super::{Drawing, Page};

/// A drawing on a page.
#[derive(Debug, Clone, PartialEq)]
pub struct PlacedDrawing {
    /// Unique name on the page: group id in SVG, layer name in PDF.
    pub name: String,
    /// The drawing, in user units of its page.
    pub drawing: Drawing,
    /// Transform from its own page to the page of the composition.
    pub place: Affine,
    /// Clip path in user units of the composition; `None` shows everything.
    pub clip: Option<BezPath>,
}

/// The trim and bleed of a printed page, in user units, y down.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrintBoxes {
    /// The page after trimming.
    pub trim: Rect,
    /// The printed area, inside the page and around `trim`.
    pub bleed: Rect,
}

/// Several drawings on one page.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Composition {
    /// Title shown by viewers.
    pub title: String,
    /// Size and unit of the whole page, including the area that is trimmed off.
    pub page: Page,
    /// Trim and bleed; `None` for pages that are not trimmed.
    pub boxes: Option<PrintBoxes>,
    /// The drawings, painted first to last.
    pub items: Vec<PlacedDrawing>,
}

impl Composition {
    /// A page without trim and bleed.
    #[must_use]
    pub fn new(title: impl Into<String>, page: Page, items: Vec<PlacedDrawing>) -> Self {
        Self { title: title.into(), page, boxes: None, items }
    }
}
