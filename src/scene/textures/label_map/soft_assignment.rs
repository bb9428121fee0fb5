//! [`SoftAssignment`]: the two palette colours between which a texel's colour is.

use crate::colour::oklab::{Oklab, distance2};
use crate::scene::textures::palette::colour_kmeans::nearest_centre_index;

/// The nearest and second nearest palette colour of a texel.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SoftAssignment {
    pub nearest: u8,
    pub second: u8,
    /// Position between the two, 0 (nearest) to 0.5.
    pub way: f32,
}

impl SoftAssignment {
    /// Finds the two nearest palette colours.
    pub(crate) fn of(lab: Oklab, palette: &[Oklab]) -> Self {
        let nearest = nearest_centre_index(palette, lab);
        let mut second = (nearest, f32::INFINITY);
        for (k, colour) in palette.iter().enumerate() {
            let far = distance2(*colour, lab);
            if k != nearest && far < second.1 {
                second = (k, far);
            }
        }
        let (a, b) = (palette[nearest], palette[second.0]);
        let along: f32 = (0..3).map(|c| (lab[c] - a[c]) * (b[c] - a[c])).sum();
        let way = if second.0 == nearest { 0.0 } else { (along / distance2(a, b)).clamp(0.0, 0.5) };
        Self { nearest: nearest as u8, second: second.0 as u8, way }
    }
}
