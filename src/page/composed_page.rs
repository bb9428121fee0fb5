//! [`Composed`]: a page with its drawings, and what there is to say of them.

use crate::drawing::Composition;

/// A page with its drawings.
#[derive(Debug, Clone)]
pub struct Composed {
    /// The page, in mm.
    pub composition: Composition,
    /// What could not be drawn as it was told, in words.
    pub warnings: Vec<String>,
}
