//! [`Look`]: what a part of the page looks like.

use crate::mesh::{MaterialId, PaintId, PartId};

/// What a part of the page looks like.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Look {
    /// The part of the model that is seen.
    pub part: PartId,
    /// Its material.
    pub material: MaterialId,
    /// What it is painted with: its material, or that in the colour of its texture.
    pub paint: PaintId,
    /// Its tone, 0 the darkest.
    pub tone: u16,
    /// The bin of light in which it is hatched, 0 the darkest; 0 where nothing is hatched.
    pub bin: u16,
    /// Whether it is as dark as it is because something else is between it and a light.
    pub cast: bool,
}

/// Which looks cast shadows darken: colours and hatching each have a switch of their own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Darkened {
    /// The tones of fills.
    pub tones: bool,
    /// The bins of hatching.
    pub bins: bool,
}

/// In lists of looks: only paper is seen.
pub(crate) const NOTHING: u32 = 0;
