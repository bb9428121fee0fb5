//! [`BorderPiece`]: a straight piece of border between cells of a ground.

use kurbo::Point;

/// A straight piece of border.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BorderPiece {
    /// Its ends.
    pub ends: [Point; 2],
    /// The cells on both sides: first that to the right of its way as the page is seen (y down).
    pub sides: [u32; 2],
    /// Whether it parts two surfaces, not only light from shade; strokes end there.
    pub parts_surfaces: bool,
}

/// The cell of paper.
pub const PAPER: u32 = 0;
