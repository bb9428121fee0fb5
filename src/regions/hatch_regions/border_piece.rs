//! [`BorderPiece`]: a straight border piece between two cells of the page.

use kurbo::Point;

/// Straight border piece between two cells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct BorderPiece {
    /// End points.
    pub ends: [Point; 2],
    /// Cells on both sides, the one on the right on the page (y down) first.
    pub sides: [u32; 2],
    /// Whether it separates two surfaces, not only light from shade. Strokes end there.
    pub parts_surfaces: bool,
}

/// Number of the paper cell.
pub(crate) const PAPER: u32 = 0;
