//! [`InkContext`]: scene and page data for strokes.

use std::sync::Arc;

use kurbo::Rect;

use crate::colour::srgb::Colour;
use crate::drawing::{Length, Unit};
use crate::lines::HiddenLines;

/// Scene and page data for strokes: names, colours and units.
#[derive(Debug, Clone, Copy)]
pub(crate) struct InkContext<'a> {
    /// Unit of chain points and of the drawing.
    pub unit: Unit,
    /// Names of the parts, by [`crate::mesh::PartId`].
    pub parts: &'a [Arc<str>],
    /// Names and base colours of the materials, by [`crate::mesh::MaterialId`].
    pub materials: &'a [(Arc<str>, Colour)],
    /// Treatment of hidden chains.
    pub hidden: HiddenLines,
    /// Width of veiled chains as a share of their pen's width.
    pub behind_glass: f64,
    /// Random seed for hand-drawn effects.
    pub seed: u64,
    /// Whether surfaces are painted under the lines. Lines must then cover the borders of the paint.
    pub painted: bool,
    /// Depths that count as near and far.
    pub depths: [f64; 2],
    /// A stable number for each feature segment, independent of the camera; 0 means none. May be empty.
    pub names: &'a [u64],
    /// The gap between spot blacks, if there is one.
    pub parting: Option<Parting>,
    /// The camera's frame on the page, which cuts lines that leave it. Without it they end there like others.
    pub frame: Option<Rect>,
}

/// Paper-coloured line between two spot blacks, where ink would be invisible.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Parting {
    /// Colour of the paper.
    pub colour: Colour,
    /// Width as a share of the pen's width.
    pub width: f64,
}

impl InkContext<'_> {
    /// The length of a px in user units.
    pub(crate) fn px(&self) -> f64 {
        Length::px(1.0).in_unit(self.unit)
    }
}
