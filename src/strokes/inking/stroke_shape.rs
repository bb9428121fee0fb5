//! [`StrokeShape`]: the painted shape of a piece of a line.

use std::sync::Arc;

use kurbo::BezPath;

use crate::drawing::ImagePiece;
use crate::strokes::brushes::brush_strip::BrushStrip;

/// Painted shape of a piece of a chain.
#[derive(Debug, Clone)]
pub(crate) enum StrokeShape {
    /// Path of the pen's width, and whether it is closed.
    Path(BezPath, bool),
    /// The outline of a line, its axis and its mean width.
    Outline { path: BezPath, axis: BezPath, width: f64 },
    /// The outline of a line that shows the picture of a stroke inside. Also the strip, its pixels along and
    /// across, and the pieces of the picture.
    Image { path: BezPath, strip: Arc<BrushStrip>, pixels: [usize; 2], pieces: Vec<ImagePiece> },
}
