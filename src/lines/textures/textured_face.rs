//! [`TexturedFace`]: a face with varying colours, evaluated point by point.

use super::picture_levels::PictureFace;
use crate::mesh::PaintId;
use crate::scene::paints::varying_surface::PaintTable;
use crate::scene::paints::vertex_colours::VertexColourPalette;

/// Face with varying colours.
pub(crate) struct TexturedFace<'a> {
    pub paints: &'a PaintTable,
    /// Position on a picture.
    pub picture: Option<PictureFace<'a>>,
    /// Light at its corners.
    pub tints: Option<(&'a VertexColourPalette, [[f32; 3]; 3])>,
}

impl TexturedFace<'_> {
    /// Paint at a point of the face.
    pub(crate) fn paint(&self, weights: [f64; 3]) -> Option<PaintId> {
        self.paints.paint(self.colour(weights), self.tint(weights))
    }

    /// Palette index of the picture at a point of the face.
    fn colour(&self, weights: [f64; 3]) -> Option<u8> {
        self.picture?.colour(weights)
    }

    /// Index of the tint at a point of the face.
    fn tint(&self, weights: [f64; 3]) -> Option<u8> {
        let (tints, corners) = self.tints?;
        let sum = |k: usize| (0..3).map(|c| f64::from(corners[c][k]) * weights[c]).sum::<f64>();
        Some(tints.at([sum(0), sum(1), sum(2)]))
    }

    /// Paints on both sides of a border between two colours of the picture, near a point of the face.
    pub(crate) fn border_paints(&self, colours: [u8; 2], near: [f64; 3]) -> Option<[PaintId; 2]> {
        let tint = self.tint(near);
        let [a, b] = colours.map(|colour| self.paints.paint(Some(colour), tint));
        Some([a?, b?])
    }

    /// Paints on both sides of a border between two tints, near a point of the face.
    pub(crate) fn tint_border_paints(&self, tints: [u8; 2], near: [f64; 3]) -> Option<[PaintId; 2]> {
        let colour = self.colour(near);
        let [a, b] = tints.map(|tint| self.paints.paint(colour, Some(tint)));
        Some([a?, b?])
    }

    /// All paints that any such face may have.
    pub(crate) fn palette(&self) -> &[PaintId] {
        &self.paints.paints
    }

    /// Paints that may be visible on the face.
    pub(crate) fn paints(&self) -> Vec<PaintId> {
        let Some(on) = self.picture.filter(|_| self.tints.is_none()) else {
            return self.paints.paints.clone();
        };
        let third = 1.0 / 3.0;
        let places = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [third; 3]];
        let within = places.into_iter().filter_map(|at| on.colour(at));
        let parted = on.levels().flat_map(|level| on.borders(level)).flat_map(|(_, colours)| colours);
        // Where the level changes, a colour without a border may appear.
        let all = on.levels().flat_map(|level| on.middle_colour(level));
        let colours = within.chain(parted).chain(all);
        let mut paints: Vec<PaintId> =
            colours.filter_map(|colour| self.paints.paint(Some(colour), None)).collect();
        paints.sort_unstable();
        paints.dedup();
        paints
    }
}
