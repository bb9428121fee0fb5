//! [`HatchContext`]: what hatching needs beside the ground.

use std::sync::Arc;

use kurbo::Rect;

use super::tone::Tone;
use crate::colour::srgb::Colour;
use crate::drawing::Unit;
use crate::hatching::guides::direction_field::Flow;
use crate::hatching::guides::guide::Guide;
use crate::regions::Samples;

/// What hatching needs beside the ground.
#[derive(Clone, Copy)]
pub struct HatchContext<'a> {
    /// Unit of the page.
    pub unit: Unit,
    /// The hand: [`crate::Style::seed`].
    pub seed: u64,
    /// Names of the parts, by [`crate::mesh::PartId`].
    pub parts: &'a [Arc<str>],
    /// Names and base colours of the materials, by [`crate::mesh::MaterialId`].
    pub materials: &'a [(Arc<str>, Colour)],
    /// Colours of the paints, by [`crate::mesh::PaintId`]; where there is none, the material's counts.
    pub paints: &'a [Colour],
    /// The tone of each paint, by [`crate::mesh::PaintId`].
    pub tones: &'a [Tone],
    /// The page asked at the points of a lattice, for layers that need it: see [`super::HatchLayer::samples`].
    pub samples: Option<&'a Samples>,
    /// Colour of the paper.
    pub paper: Colour,
    /// For each layer that follows the surface or its light, the flow of its strokes.
    pub flows: &'a [Option<Flow<'a>>],
    /// For each layer that is fixed to the model, its guides.
    pub fixed: &'a [Option<Vec<Guide>>],
    /// The camera's frame on the page: strokes that end at its border go on outside, and do not taper there.
    pub frame: Option<Rect>,
}
