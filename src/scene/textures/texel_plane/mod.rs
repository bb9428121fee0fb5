//! The plane of a picture's texels: where texture coordinates lie in it, and how the picture repeats.
//!
//! Cut-outs and painted surfaces trace borders in this plane and carry them over to the triangles.
//!
//! Files: [`texel_borders`] traced borders, simplified and indexed by a grid; [`side_crossings`] where
//! borders cross the sides of a triangle, identical for both triangles that share a side.

pub(crate) mod side_crossings;
pub(crate) mod texel_borders;

use glam::DVec2;

use crate::colour::pixel_picture::Picture;
use crate::scene::material::{Placing, Wrap};
use crate::scene::{Material, Scene};

/// Layout of a picture's texels in the plane, and its continuation outside the borders.
///
/// The centre of the first texel is the origin; x runs along a row and y from the top row down. The unit is a
/// texel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TexelPlane {
    /// Width and height in texels; at least 1.
    pub size: [usize; 2],
    /// Wrapping along x and along y.
    pub wrap: [Wrap; 2],
    /// Whether v grows upwards from the bottom row, as in OBJ and PLY, or downwards from the top row.
    pub upward: bool,
    /// Scale and offset of the material's texture coordinates.
    pub placing: Placing,
}

impl TexelPlane {
    /// Layout of a material's picture.
    pub(crate) fn of(scene: &Scene, material: &Material, picture: &Picture) -> Self {
        let size = [picture.width, picture.height];
        let Material { wrap, placing, .. } = *material;
        Self { size, wrap, upward: scene.format != "glTF", placing }
    }

    /// Point of the plane for a pair of texture coordinates; `None` if it is not finite or too far away.
    pub(crate) fn place(&self, uv: [f32; 2]) -> Option<DVec2> {
        let Placing { scale, offset } = self.placing;
        let [u, v] = [0, 1]
            .map(|k| if self.placing == Placing::default() { uv[k] } else { uv[k] * scale[k] + offset[k] });
        let v = if self.upward { 1.0 - f64::from(v) } else { f64::from(v) };
        let [width, height] = self.size.map(|count| count as f64);
        let place = DVec2::new(f64::from(u) * width - 0.5, v * height - 0.5);
        // At this distance single precision can no longer distinguish texels.
        (place.is_finite() && place.abs().max_element() < 1e9).then_some(place)
    }

    /// Period of the pattern along x and along y, in texels; `None` if the border is repeated.
    pub(crate) fn periods(&self) -> [Option<usize>; 2] {
        [0, 1].map(|k| match self.wrap[k] {
            Wrap::Repeat => Some(self.size[k]),
            Wrap::Mirror => Some(2 * self.size[k]),
            Wrap::Clamp => None,
        })
    }

    /// Number of cells between texel centres in one period, along x and along y.
    pub(crate) fn reach(&self) -> [usize; 2] {
        let periods = self.periods();
        // With a repeated border, one cell is enough to show the direction of lines outside.
        [0, 1].map(|k| periods[k].unwrap_or((self.size[k] - 1).max(1)))
    }

    /// Indices of the texels to the right, to the left, below and above.
    #[inline]
    pub(crate) fn beside(&self, texel: usize) -> [usize; 4] {
        let [width, height] = self.size;
        let (column, row) = (texel % width, texel / width);
        if column > 0 && row > 0 && column + 1 < width && row + 1 < height {
            return [texel + 1, texel - 1, texel + width, texel - width];
        }
        let (column, row) = (column as i64, row as i64);
        [(1, 0), (-1, 0), (0, 1), (0, -1)].map(|(i, j)| self.index(column + i, row + j))
    }

    /// Index of the texel at a column and a row, which may be outside the picture.
    #[inline]
    pub(crate) fn index(&self, column: i64, row: i64) -> usize {
        let [width, height] = self.size;
        wrap_index(row, height as i64, self.wrap[1]) * width + wrap_index(column, width as i64, self.wrap[0])
    }
}

/// Wraps an index into `0..count`.
#[inline]
fn wrap_index(at: i64, count: i64, wrap: Wrap) -> usize {
    if (0..count).contains(&at) {
        return at as usize;
    }
    let within = match wrap {
        Wrap::Repeat => at.rem_euclid(count),
        Wrap::Clamp => at.clamp(0, count - 1),
        Wrap::Mirror => {
            let at = at.rem_euclid(2 * count);
            at.min(2 * count - 1 - at)
        }
    };
    within as usize
}

/// Traced borders between areas of a picture, one period of them.
#[derive(Debug, Clone, Default)]
pub(crate) struct TracedBorders {
    /// Linked polylines. Open ones end where three borders meet, or at the border of the picture or period.
    pub lines: Vec<Vec<DVec2>>,
    /// The two colours on the sides of each line, or empty.
    pub parted: Vec<[u8; 2]>,
    /// Number of cells along x and along y.
    pub reach: [usize; 2],
    /// Period along x and along y.
    pub periods: [Option<usize>; 2],
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texel_plane_puts_texel_centres_at_whole_numbers() {
        let texels =
            TexelPlane { size: [2, 2], wrap: [Wrap::Repeat; 2], upward: false, placing: Placing::default() };
        assert_eq!(texels.place([0.25, 0.75]), Some(DVec2::new(0.0, 1.0)));
        assert_eq!(texels.place([f32::NAN, 0.0]), None);
        assert_eq!(TexelPlane { upward: true, ..texels }.place([0.25, 0.75]), Some(DVec2::ZERO));
        let placing = Placing { scale: [2.0, 1.0], offset: [0.5, 0.0] };
        assert_eq!(TexelPlane { placing, ..texels }.place([0.25, 0.75]), Some(DVec2::new(1.5, 1.0)));
        assert_eq!([-1, 0, 1, 2].map(|k| texels.index(k, 1)), [3, 2, 3, 2]);
    }
}
