//! [`VaryingSurface`]: a surface whose colour varies from point to point, by a picture, vertex colours, or both.

use super::vertex_colours::VertexColourPalette;
use crate::mesh::PaintId;
use crate::scene::textures::PaintedTexture;

/// A surface whose colour varies from point to point. With both a picture and vertex colours, each is reduced
/// to a few colours separately, and these are multiplied.
#[derive(Debug, Clone)]
pub(crate) struct VaryingSurface {
    /// Its picture.
    pub picture: Option<PaintedTexture>,
    /// Its vertex colours.
    pub tints: Option<VertexColourPalette>,
    paints: PaintTable,
}

/// Table of paints: one for each combination of picture colour and vertex colour.
#[derive(Debug, Clone)]
pub(crate) struct PaintTable {
    /// Rows by picture colour, the last row for points without a picture; columns by vertex colour.
    pub paints: Vec<PaintId>,
    /// Number of columns, at least 1.
    pub tints: usize,
}

impl PaintTable {
    /// Paint for a picture colour (or none) and a vertex colour (or none).
    pub(crate) fn paint(&self, colour: Option<u8>, tint: Option<u8>) -> Option<PaintId> {
        let row = colour.map_or((self.paints.len() / self.tints).checked_sub(1)?, usize::from);
        self.paints.get(row * self.tints + usize::from(tint.unwrap_or_default())).copied()
    }
}

impl VaryingSurface {
    pub(crate) fn new(
        picture: Option<PaintedTexture>,
        tints: Option<VertexColourPalette>,
        paints: Vec<PaintId>,
    ) -> Self {
        let columns = tints.as_ref().map_or(1, |tints| tints.palette().len().max(1));
        Self { picture, tints, paints: PaintTable { paints, tints: columns } }
    }

    /// Paints for all combinations of picture colour and vertex colour.
    pub(crate) fn paints(&self) -> &PaintTable {
        &self.paints
    }
}
