//! [`InkContext`]: what strokes need of the scene and the page.

use std::sync::Arc;

use kurbo::Rect;

use crate::colour::srgb::Colour;
use crate::drawing::{Length, Unit};
use crate::lines::HiddenLines;

/// What strokes need of the scene and the page: names, colours and the unit.
#[derive(Debug, Clone, Copy)]
pub struct InkContext<'a> {
    /// Unit of the chains' points and of the drawing.
    pub unit: Unit,
    /// Names of the parts, by [`crate::mesh::PartId`].
    pub parts: &'a [Arc<str>],
    /// Names and base colours of the materials, by [`crate::mesh::MaterialId`].
    pub materials: &'a [(Arc<str>, Colour)],
    /// What becomes of hidden chains.
    pub hidden: HiddenLines,
    /// The part of their pen's width that veiled chains have.
    pub behind_glass: f64,
    /// The hand: seeds all that varies by chance.
    pub seed: u64,
    /// Whether surfaces are painted under the lines, so that lines must not leave their borders.
    pub painted: bool,
    /// The depths of what counts as near and as far.
    pub depths: [f64; 2],
    /// For feature segments, by their number, what lasts while the eye moves; 0 = nothing. May be empty.
    pub names: &'a [u64],
    /// What parts spot blacks, where there are any.
    pub parting: Option<Parting>,
    /// The camera's frame on the page, which cuts lines that leave it; without it they end there as others do.
    pub frame: Option<Rect>,
}

/// The line between two spot blacks, on which ink would not be seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parting {
    /// Its colour: that of the paper.
    pub colour: Colour,
    /// Its width, in parts of the pen's.
    pub width: f64,
}

impl InkContext<'_> {
    /// User units in a px.
    pub(crate) fn px(&self) -> f64 {
        Length::px(1.0).in_unit(self.unit)
    }
}
