//! [`Guess`]: between which colours of a palette that of a texel lies.

use crate::colour::oklab::{Oklab, distance2};
use crate::scene::textures::palette::colour_kmeans::closest;

/// Between which colours that of a texel lies.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Guess {
    pub nearest: u8,
    pub second: u8,
    /// How far on the way from the nearest to the second.
    pub way: f32,
}

impl Guess {
    /// Between which colours of a palette a colour lies.
    pub fn of(lab: Oklab, palette: &[Oklab]) -> Self {
        let nearest = closest(palette, lab);
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
