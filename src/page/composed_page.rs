//! [`ComposedPage`]: a page with its drawings and warnings.

use crate::drawing::Composition;

/// A page with its drawings.
#[derive(Debug, Clone)]
pub struct ComposedPage {
    /// The page, in mm.
    pub composition: Composition,
    /// Warnings: keys that could not be followed.
    pub warnings: Vec<String>,
}
