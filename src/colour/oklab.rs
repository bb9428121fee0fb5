//! [`Oklab`]: a perceptually uniform colour space.
//!
//! Source: Ottosson, "A perceptual color space for image processing", 2020.

use super::srgb::{Colour, linear};
use crate::geometry::numbers::portable_math;

/// Lightness, green to red, blue to yellow.
pub(crate) type Oklab = [f32; 3];

/// Converts linear light, each channel 0 to 1.
#[must_use]
pub(crate) fn of_linear([r, g, b]: [f32; 3]) -> Oklab {
    let [r, g, b] = [r, g, b].map(f64::from);
    let l = portable_math::cbrt(0.412_221_470_8 * r + 0.536_332_536_3 * g + 0.051_445_992_9 * b);
    let m = portable_math::cbrt(0.211_903_498_2 * r + 0.680_699_545_1 * g + 0.107_396_956_6 * b);
    let s = portable_math::cbrt(0.088_302_461_9 * r + 0.281_718_837_6 * g + 0.629_978_700_5 * b);
    let lab = [
        0.210_454_255_3 * l + 0.793_617_785_0 * m - 0.004_072_046_8 * s,
        1.977_998_495_1 * l - 2.428_592_205_0 * m + 0.450_593_709_9 * s,
        0.025_904_037_1 * l + 0.782_771_766_2 * m - 0.808_675_766_0 * s,
    ];
    lab.map(|c| c as f32)
}

/// Table from an sRGB channel, 0 to 255, to linear light.
#[must_use]
pub(crate) fn linear_table() -> [f32; 256] {
    std::array::from_fn(|c| linear(c as f32 / 255.0))
}

/// Converts an sRGB colour; opacity is ignored.
#[must_use]
pub(crate) fn of(colour: Colour) -> Oklab {
    of_linear([colour.r, colour.g, colour.b].map(|c| linear(f32::from(c) / 255.0)))
}

/// Squared distance between two colours.
#[inline]
#[must_use]
pub(crate) fn distance2(a: Oklab, b: Oklab) -> f32 {
    let [x, y, z] = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    x * x + y * y + z * z
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn oklab_of_known_colours_matches_published_values() {
        let near = |a: Oklab, b: Oklab| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 2e-3);
        assert!(near(of(Colour::WHITE), [1.0, 0.0, 0.0]));
        assert!(near(of(Colour::BLACK), [0.0; 3]));
        assert!(near(of(Colour::rgb(255, 0, 0)), [0.628, 0.225, 0.126]));
        assert!(near(of(Colour::rgb(0, 0, 255)), [0.452, -0.032, -0.312]));
    }
}
