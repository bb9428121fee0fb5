//! [`Varied`]: a surface whose colour varies from point to point, by a picture, by the colours of its vertices, or by both.

use super::vertex_colours::Tints;
use crate::mesh::PaintId;
use crate::scene::textures::Painted;

/// A surface whose colour varies from point to point. Where a picture and the colours of vertices meet, each falls into few
/// colours by itself, and those are multiplied.
#[derive(Debug, Clone)]
pub(crate) struct Varied {
    /// The picture that it shows.
    pub picture: Option<Painted>,
    /// The colours of its vertices.
    pub tints: Option<Tints>,
    paints: PaintTable,
}

/// The paint of each colour of a picture in each tint.
#[derive(Debug, Clone)]
pub(crate) struct PaintTable {
    /// Picture by picture colour, and behind those what shows no picture; in each the tints in their order.
    pub paints: Vec<PaintId>,
    /// Tints in a row, at least 1.
    pub tints: usize,
}

impl PaintTable {
    /// The paint of a colour of the picture, or of none, in a tint, or in none.
    pub fn paint(&self, colour: Option<u8>, tint: Option<u8>) -> Option<PaintId> {
        let row = colour.map_or((self.paints.len() / self.tints).checked_sub(1)?, usize::from);
        self.paints.get(row * self.tints + usize::from(tint.unwrap_or_default())).copied()
    }
}

impl Varied {
    pub(crate) fn new(picture: Option<Painted>, tints: Option<Tints>, paints: Vec<PaintId>) -> Self {
        let columns = tints.as_ref().map_or(1, |tints| tints.palette().len().max(1));
        Self { picture, tints, paints: PaintTable { paints, tints: columns } }
    }

    /// The paint of each colour of the picture in each tint.
    pub fn paints(&self) -> &PaintTable {
        &self.paints
    }
}
