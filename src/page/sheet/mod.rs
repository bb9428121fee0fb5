//! Technical sheets: frame, title block, views.

use std::path::PathBuf;

use serde::Deserialize;

use super::composed::Composed;
use super::size::Size;
use super::source::Source;
use crate::drawing::{Composition, Page, Unit};
use crate::error::Error;
use crate::math::colour::Colour;

/// What a page file tells of a technical sheet.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SheetPage {
    /// Its size.
    pub size: Size,
}

impl SheetPage {
    /// The files it is made from.
    #[must_use]
    pub fn inputs(&self, _source: &Source) -> Vec<PathBuf> {
        Vec::new()
    }
}

/// Draws a sheet.
///
/// # Errors
/// None yet.
pub fn compose(sheet: &SheetPage, _source: &Source) -> Result<Composed, Error> {
    let Size { width, height } = sheet.size;
    let page = Page { width, height, unit: Unit::Mm, background: Some(Colour::WHITE) };
    Ok(Composed { composition: Composition::new("sheet", page, Vec::new()), warnings: Vec::new() })
}
