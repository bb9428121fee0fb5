//! Nearest colour of the 255 colours numbered in DXF.
//!
//! Source: the AutoCAD Color Index. 1 to 9 are named colours. Then follow 24 hues, each with five values in
//! two saturations, and six greys. Number 7 is black on white paper and white on a black screen.

use crate::colour::srgb::Colour;

/// Black on paper.
pub(crate) const BLACK: u8 = 7;

/// Colours 1 to 9.
const NAMED_COLOURS: [[u8; 3]; 9] = [
    [255, 0, 0],
    [255, 255, 0],
    [0, 255, 0],
    [0, 255, 255],
    [0, 0, 255],
    [255, 0, 255],
    [0, 0, 0],
    [128, 128, 128],
    [192, 192, 192],
];
/// Values of the five shades of a hue, 0 to 255.
const HUE_VALUES: [f64; 5] = [255.0, 189.0, 129.0, 104.0, 79.0];
/// Greys 250 to 255.
const GREY_VALUES: [u8; 6] = [51, 80, 105, 130, 190, 255];

/// Share of white mixed into the pale variant of a hue.
const PALE_WHITE_SHARE: f64 = 2.0 / 3.0;

/// The colour with a number.
fn colour(number: u8) -> [u8; 3] {
    match number {
        1..=9 => NAMED_COLOURS[usize::from(number) - 1],
        10..=249 => {
            let hue = f64::from((number - 10) / 10) / 4.0;
            let shade = usize::from(number % 10);
            let value = HUE_VALUES[shade / 2];
            let floor = if shade % 2 == 1 { PALE_WHITE_SHARE } else { 0.0 };
            // Each channel is full over a third of the hue circle, and falls to zero over a sixth on both
            // sides.
            [0.0, 2.0, 4.0].map(|middle: f64| {
                let away = (hue - middle).abs();
                let away = away.min(6.0 - away);
                let height = (2.0 - away).clamp(0.0, 1.0);
                (value * (floor + (1.0 - floor) * height)).round() as u8
            })
        }
        250..=255 => [GREY_VALUES[usize::from(number) - 250]; 3],
        0 => [0; 3],
    }
}

/// Number of the nearest colour; the first of several.
pub(crate) fn nearest(target: Colour) -> u8 {
    let channels = [target.r, target.g, target.b];
    let distance = |number: &u8| -> i32 {
        colour(*number).iter().zip(channels).map(|(a, b)| (i32::from(*a) - i32::from(b)).pow(2)).sum()
    };
    // Black comes first, so that nearly black colours are visible on black screens.
    let other_numbers = (1..=255).filter(|number| *number != BLACK);
    std::iter::once(BLACK).chain(other_numbers).min_by_key(distance).unwrap_or(BLACK)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dxf_colour_numbers_have_their_standard_colours() {
        for (number, wanted) in [
            (10, [255, 0, 0]),
            (50, [255, 255, 0]),
            (90, [0, 255, 0]),
            (170, [0, 0, 255]),
            (250, [51; 3]),
            (12, [189, 0, 0]),
        ] {
            assert_eq!(colour(number), wanted, "{number}");
        }
    }

    #[test]
    fn nearest_returns_the_closest_dxf_colour_number() {
        let of = |r, g, b| nearest(Colour { r, g, b, ..Colour::BLACK });
        assert_eq!(
            [of(0, 0, 0), of(20, 20, 20), of(250, 3, 3), of(0, 0, 255), of(255, 255, 255)],
            [7, 7, 1, 5, 255]
        );
    }
}
