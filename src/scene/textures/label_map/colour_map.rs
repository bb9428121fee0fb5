//! [`ColourMap`]: a picture in a few colours, as large as its texels are seen.

use std::sync::OnceLock;

use super::colour_labels::Labels;
use super::label_borders::trace;
use crate::scene::textures::texel_plane::Traced;

/// A picture in a few colours, as large as its texels are seen: which colour is where, and the borders between them.
#[derive(Debug)]
pub(crate) struct ColourMap {
    pub labels: Labels,
    borders: OnceLock<Option<Traced>>,
    /// On how much of the picture specks were lost, as a part of it.
    pub(crate) lost: f64,
}

/// What a map depends on but for the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct MapOf {
    pub sight: Sight,
    /// The deviation of the blur of borders, texels.
    pub blur: f64,
    /// What hangs together on fewer texels is a speck.
    pub least: f64,
}

/// How a picture is looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Sight {
    /// How often its texels are halved along each side.
    pub halvings: usize,
    /// Whether how all of it looks from afar is one of the colours.
    pub with_mean: bool,
    /// Whether texels are blocks.
    pub blocks: bool,
}

impl ColourMap {
    pub(crate) fn new(labels: Labels, lost: usize) -> Self {
        let mut map = Self { borders: OnceLock::new(), lost: 0.0, labels };
        map.lost = lost as f64 / map.texels() as f64;
        map
    }

    /// The number of its texels.
    pub(crate) fn texels(&self) -> usize {
        let [width, height] = self.labels.texels.size;
        width * height
    }

    /// The borders between colours, traced when they are first asked for; none if there are too many.
    pub fn borders(&self) -> Option<&Traced> {
        self.borders.get_or_init(|| trace(&self.labels)).as_ref()
    }
}
