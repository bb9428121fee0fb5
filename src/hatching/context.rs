//! [`HatchContext`]: names, colours and guides that hatching needs besides the ground.

use std::sync::Arc;

use kurbo::Rect;

use super::tone::ToneCoverage;
use crate::colour::srgb::Colour;
use crate::drawing::Unit;
use crate::hatching::guides::guide::Guide;
use crate::hatching::guides::guide_directions::GuideDirections;
use crate::regions::LightLattice;

/// Scene and page data that hatching needs besides the ground.
#[derive(Clone, Copy)]
pub(crate) struct HatchContext<'a> {
    /// Unit of the page.
    pub unit: Unit,
    /// Random seed: [`crate::Style::seed`].
    pub seed: u64,
    /// Names of the parts, by [`crate::mesh::PartId`].
    pub parts: &'a [Arc<str>],
    /// Names and base colours of the materials, by [`crate::mesh::MaterialId`].
    pub materials: &'a [(Arc<str>, Colour)],
    /// Colours of the paints, by [`crate::mesh::PaintId`]. A missing entry falls back to the material's
    /// colour.
    pub paints: &'a [Colour],
    /// The tone of each paint, by [`crate::mesh::PaintId`].
    pub tones: &'a [ToneCoverage],
    /// The page sampled at a lattice, for layers that need it: see [`super::HatchLayer::samples`].
    pub samples: Option<&'a LightLattice>,
    /// Colour of the paper.
    pub paper: Colour,
    /// The direction field of each layer that follows the surface or the light; `None` for the others.
    pub flows: &'a [Option<GuideDirections<'a>>],
    /// The guides of each layer that is fixed to the model; `None` for the others.
    pub fixed: &'a [Option<Vec<Guide>>],
    /// The camera's frame on the page. Strokes that end on its border continue outside, so they do not taper
    /// there.
    pub frame: Option<Rect>,
}
