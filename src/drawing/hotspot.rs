//! [`Hotspot`]: the visible area of a part, for clicks.

use std::sync::Arc;

use kurbo::BezPath;

/// The visible area of a part.
#[derive(Debug, Clone, PartialEq)]
pub struct Hotspot {
    /// The name of the part.
    pub part: Arc<str>,
    /// Closed paths around the visible area, in user units; holes run in the opposite direction.
    pub outline: BezPath,
}
