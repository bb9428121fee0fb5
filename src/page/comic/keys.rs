//! What a page file tells of a comic page.

use std::path::PathBuf;

use serde::Deserialize;

use crate::page::size::Size;
use crate::page::source::Source;

/// What a page file tells of a comic page.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ComicPage {
    /// How large it is when it is cut. Default: A4.
    pub size: Size,
    /// How panels part the page.
    pub layout: String,
}

impl ComicPage {
    /// The files it is made from.
    #[must_use]
    pub fn inputs(&self, _source: &Source) -> Vec<PathBuf> {
        Vec::new()
    }
}
