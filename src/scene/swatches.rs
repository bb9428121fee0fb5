//! [`swatches`]: a few flat colours that stand for many.

use rustc_hash::FxHashMap;

use super::texture::difference;
use crate::math::colour::Colour;

/// No more flat colours than this; what has more is a photograph.
const MOST: usize = 64;

/// Colours that differ by less than this in every channel are one.
const ALIKE: u32 = 20;

/// Share of the colours that may be strangers to all swatches: blends at the borders of a palette.
const STRANGERS: f64 = 0.02;

/// For each colour the flat one that stands for it: the colours of a palette, or where there are
/// more than 64 the mean of all.
pub(super) fn swatches(colours: &[Colour]) -> Vec<Colour> {
    let mut counts: FxHashMap<Colour, usize> = FxHashMap::default();
    for colour in colours {
        *counts.entry(*colour).or_default() += 1;
    }
    let mut ranked: Vec<(Colour, usize)> = counts.iter().map(|(colour, count)| (*colour, *count)).collect();
    ranked.sort_unstable_by_key(|(colour, count)| (std::cmp::Reverse(*count), *colour));

    // The most frequent colours stand for those near them.
    let mut chosen: Vec<Colour> = Vec::new();
    let mut strangers = 0;
    for (colour, count) in &ranked {
        if chosen.iter().all(|swatch| difference(*swatch, *colour) >= ALIKE) {
            if chosen.len() < MOST {
                chosen.push(*colour);
            } else {
                strangers += count;
            }
        }
    }
    if strangers as f64 > STRANGERS * colours.len() as f64 {
        return vec![mean(colours); colours.len()];
    }
    let nearest = |colour: Colour| {
        chosen.iter().copied().min_by_key(|swatch| difference(*swatch, colour)).unwrap_or(colour)
    };
    let of: FxHashMap<Colour, Colour> =
        ranked.iter().map(|(colour, _)| (*colour, nearest(*colour))).collect();
    colours.iter().map(|colour| of.get(colour).copied().unwrap_or(*colour)).collect()
}

/// The mean of colours; opaque.
fn mean(colours: &[Colour]) -> Colour {
    let count = colours.len().max(1) as u64;
    let channel = |of: fn(&Colour) -> u8| {
        let sum: u64 = colours.iter().map(|colour| u64::from(of(colour))).sum();
        ((sum + count / 2) / count) as u8
    };
    Colour::rgb(channel(|c| c.r), channel(|c| c.g), channel(|c| c.b))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_palette_keeps_its_colours() {
        let (red, nearly, blue) = (Colour::rgb(200, 0, 0), Colour::rgb(205, 8, 0), Colour::rgb(0, 0, 200));
        assert_eq!(swatches(&[nearly, red, blue, red]), [red, red, blue, red]);
        assert!(swatches(&[]).is_empty());
    }

    #[test]
    fn a_photograph_becomes_its_mean() {
        let shades = |greens: std::ops::Range<u8>| -> Vec<Colour> {
            (0..=255).flat_map(|r| greens.clone().map(move |g| Colour::rgb(r, g * 32, 100))).collect()
        };
        let photograph = swatches(&shades(0..8));
        assert!(photograph.iter().all(|colour| *colour == Colour::rgb(128, 112, 100)));
        // A smooth run of one hue is few colours, each near what it stands for.
        let run = shades(0..1);
        let kept = swatches(&run);
        assert!(kept.iter().zip(&run).all(|(a, b)| difference(*a, *b) < ALIKE));
        assert!(kept.iter().any(|colour| *colour != kept[0]));
    }
}
