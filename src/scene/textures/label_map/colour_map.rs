//! [`ColourMap`]: a picture reduced to a few colours, at the resolution of a view.

use std::sync::OnceLock;

use super::colour_labels::ColourLabels;
use super::label_borders::trace_label_borders;
use crate::scene::textures::texel_plane::TracedBorders;

/// A picture reduced to a few colours, at the resolution of a view: the colour of each texel, and the borders
/// between them.
#[derive(Debug)]
pub(crate) struct ColourMap {
    pub labels: ColourLabels,
    borders: OnceLock<Option<TracedBorders>>,
    /// Share of the picture's texels that were specks.
    pub(crate) lost: f64,
}

/// Parameters of a map besides the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct MapKey {
    pub sight: MapScale,
    /// Standard deviation of the blur of borders, texels.
    pub blur: f64,
    /// Minimum texels of a connected region; smaller ones are specks.
    pub least: f64,
}

/// Resolution and colours of a reduced picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct MapScale {
    /// Number of times that width and height are halved.
    pub halvings: usize,
    /// Whether the mean of the picture is one of the colours.
    pub with_mean: bool,
    /// Whether texels are drawn as blocks.
    pub blocks: bool,
}

impl ColourMap {
    pub(crate) fn new(labels: ColourLabels, lost: usize) -> Self {
        let mut map = Self { borders: OnceLock::new(), lost: 0.0, labels };
        map.lost = lost as f64 / map.texels() as f64;
        map
    }

    /// Number of texels.
    pub(crate) fn texels(&self) -> usize {
        let [width, height] = self.labels.texels.size;
        width * height
    }

    /// Borders between colours, traced on first use; `None` if there are too many.
    pub(crate) fn borders(&self) -> Option<&TracedBorders> {
        self.borders.get_or_init(|| trace_label_borders(&self.labels)).as_ref()
    }
}
