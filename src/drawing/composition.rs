//! [`Composition`]: several drawings on one page, each in its place and within its frame.
//!
//! ```
//! use ligne::drawing::composition::{Composition, Item};
//! use ligne::drawing::{Drawing, Page, Unit};
//!
//! let page = |width, height| Page { width, height, unit: Unit::Mm, background: None };
//! let panel = Drawing::new("panel", page(80.0, 60.0), Vec::new());
//! let place = kurbo::Affine::translate((10.0, 20.0));
//! let item = Item { name: "panel-1".to_owned(), drawing: panel, place, clip: None };
//! let composition = Composition::new("a page", page(210.0, 297.0), vec![item]);
//! assert_eq!(composition.items.len(), 1);
//! # use ligne::kurbo;
//! ```

use kurbo::{Affine, BezPath, Rect};

use super::{Drawing, Page};

/// A drawing on a page.
#[derive(Debug, Clone, PartialEq)]
pub struct Item {
    /// What it is called: the id of its group in SVG, its layer in PDF. No two of a page are called alike.
    pub name: String,
    /// The drawing, in units of its own page.
    pub drawing: Drawing,
    /// From units of its own page to those of the page it is put on.
    pub place: Affine,
    /// What is shown of it, in units of the page it is put on; all if none.
    pub clip: Option<BezPath>,
}

/// Where a printed page is cut, and how far what is printed reaches beyond; in units of the page, y down.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Boxes {
    /// What is left of the page when it is cut.
    pub trim: Rect,
    /// What is printed, within the page and around `trim`.
    pub bleed: Rect,
}

/// Several drawings on one page.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Composition {
    /// Title, shown by viewers.
    pub title: String,
    /// Size and unit of all of it, what is cut off included.
    pub page: Page,
    /// Where it is cut; none for pages that are not.
    pub boxes: Option<Boxes>,
    /// The drawings, painted first to last.
    pub items: Vec<Item>,
}

impl Composition {
    /// A page that is not cut.
    #[must_use]
    pub fn new(title: impl Into<String>, page: Page, items: Vec<Item>) -> Self {
        Self { title: title.into(), page, boxes: None, items }
    }
}
