//! [`Hotspot`]: where one sees a part, so that it can be clicked.

use std::sync::Arc;

use kurbo::BezPath;

/// Where a part is seen.
#[derive(Debug, Clone, PartialEq)]
pub struct Hotspot {
    /// The name of the part.
    pub part: Arc<str>,
    /// Closed paths around all of it that is seen, in user units; holes run the other way round.
    pub outline: BezPath,
}
