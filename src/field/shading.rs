//! [`Shading`]: how a view is lit, and into which tones its surface falls.

use glam::DVec3;

use crate::math::colour::Colour;
use crate::mesh::MaterialId;

/// A point of the surface, as light falls on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfacePoint {
    /// Where it is, local space.
    pub position: DVec3,
    /// Unit normal of the side that the eye sees, local space.
    pub normal: DVec3,
    /// How much of the sky it sees, 0 (none) to 1 (all).
    pub openness: f64,
}

/// How a view is lit, and into which tones its surface falls.
///
/// What a point looks like follows from one or more *channels*: numbers that vary over the surface,
/// such as the light that falls on it or the strength of its highlight. Each channel has rising
/// levels, and where one of them is crossed the tone may change.
#[derive(Debug, Clone)]
pub struct Shading {
    towards_light: DVec3,
    levels: Vec<f64>,
}

impl Shading {
    /// Light from one direction, with levels on max(L·n, 0).
    #[must_use]
    pub fn from_direction(towards_light: DVec3, levels: Vec<f64>) -> Self {
        Self { towards_light: towards_light.normalize_or_zero(), levels }
    }

    /// Number of channels.
    #[must_use]
    pub fn channels(&self) -> usize {
        1
    }

    /// Whether a channel varies over a flat face: with distance from a light, or with the direction
    /// to the eye.
    #[must_use]
    pub fn is_local(&self, _channel: usize) -> bool {
        false
    }

    /// The rising levels of a channel on a material.
    #[must_use]
    pub fn levels(&self, _material: MaterialId, _channel: usize) -> &[f64] {
        &self.levels
    }

    /// The value of a channel at a point that those lights do not reach whose bits are set in
    /// `shadowed`.
    #[must_use]
    pub fn value(&self, _channel: usize, _material: MaterialId, point: &SurfacePoint, shadowed: u32) -> f64 {
        if shadowed & 1 == 0 { point.normal.dot(self.towards_light).max(0.0) } else { 0.0 }
    }

    /// The tone of a point, 0 the darkest, from how many levels of each channel its values reach.
    #[must_use]
    pub fn tone(&self, _material: MaterialId, bands: &[u16]) -> u16 {
        bands.first().copied().unwrap_or_default()
    }

    /// The colour of a tone on a material.
    #[must_use]
    pub fn colour(&self, _material: MaterialId, tone: u16) -> Colour {
        let part = f64::from(tone + 1) / (self.levels.len() + 1) as f64;
        let grey = (60.0 + 180.0 * part) as u8;
        Colour::rgb(grey, grey, grey)
    }
}
