//! [`SurfaceLabel`]: the label of a part of the page: part, material, paint, tone and hatching bin.

use crate::mesh::{MaterialId, PaintId, PartId};

/// Appearance of a part of the page. Neighbouring triangles of equal label belong to one region.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SurfaceLabel {
    /// Part that is seen.
    pub part: PartId,
    /// Material of the part.
    pub material: MaterialId,
    /// Paint: the material, or the material in a colour of its texture.
    pub(crate) paint: PaintId,
    /// Tone; 0 is the darkest.
    pub tone: u16,
    /// Hatching bin; 0 is the darkest, and used where nothing is hatched.
    pub(crate) bin: u16,
    /// Whether a cast shadow lowers the tone.
    pub(crate) cast: bool,
}

/// Effects of cast shadows: fills and hatching each have a switch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct ShadowDarkening {
    /// Tones of fills.
    pub tones: bool,
    /// Hatching bins.
    pub bins: bool,
}

/// In lists of labels: only paper is seen.
pub(crate) const NO_LABEL: u32 = 0;
