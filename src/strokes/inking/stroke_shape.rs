//! [`Shape`]: what is painted for a piece of a line.

use std::sync::Arc;

use kurbo::BezPath;

use crate::drawing::ImagePiece;
use crate::strokes::brushes::brush_strip::Strip;

/// What is painted for a piece of a chain.
#[derive(Debug, Clone)]
pub(crate) enum Shape {
    /// A path of the pen's width, and whether it is closed.
    Path(BezPath, bool),
    /// The outline of a line, its axis and its mean width.
    Outline { path: BezPath, axis: BezPath, width: f64 },
    /// The outline of a line within which the picture of a stroke is seen, that picture, its pixels along and across, and the
    /// pieces in which it is seen.
    Image { path: BezPath, strip: Arc<Strip>, pixels: [usize; 2], pieces: Vec<ImagePiece> },
}
