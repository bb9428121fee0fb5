//! Comic pages: panels in a layout, each the drawing of a scene.

pub mod keys;

use super::composed::Composed;
use super::source::Source;
use crate::drawing::{Composition, Page, Unit};
use crate::error::Error;

pub use keys::ComicPage;

/// Draws a comic page.
///
/// # Errors
/// Each names the line of what is wrong.
pub fn compose(comic: &ComicPage, _source: &Source) -> Result<Composed, Error> {
    let page = Page { width: comic.size.width, height: comic.size.height, unit: Unit::Mm, background: None };
    Ok(Composed { composition: Composition::new("page", page, Vec::new()), warnings: Vec::new() })
}
