//! [`cluster_colours`]: the flat colours of a palette texture, by clustering the colours of triangles.

use rustc_hash::FxHashMap;

use crate::colour::srgb::Colour;

/// Maximum number of palette colours; a picture with more is a photograph.
const MAX_PALETTE_COLOURS: usize = 64;

/// Minimum channel difference between two palette colours.
pub(crate) const MIN_CHANNEL_DIFFERENCE: u32 = 28;

/// Maximum share of colours without a palette colour, such as blends at the borders of a palette.
const MAX_OUTLIER_SHARE: f64 = 0.02;

/// Minimum share of triangles with a single colour in a palette texture.
const MIN_FLAT_TRIANGLE_SHARE: f64 = 0.7;

/// Flat colour for each triangle, given its colour and whether it is its only one: a palette colour, or the
/// mean of all if there is no palette.
pub(crate) fn cluster_colours(triangles: &[(Colour, bool)]) -> Vec<Colour> {
    cluster_palette(triangles).unwrap_or_else(|| vec![mean(triangles); triangles.len()])
}

/// Palette colour for each triangle, given its colour and whether it is its only one.
///
/// Returns `None` if the palette would have more than 64 colours, or if too many triangles have several
/// colours.
pub(crate) fn cluster_palette(triangles: &[(Colour, bool)]) -> Option<Vec<Colour>> {
    let flat = triangles.iter().filter(|(_, flat)| *flat).count();
    if (flat as f64) < MIN_FLAT_TRIANGLE_SHARE * triangles.len() as f64 {
        return None;
    }
    let mut counts: FxHashMap<Colour, usize> = FxHashMap::default();
    for (colour, _) in triangles {
        *counts.entry(*colour).or_default() += 1;
    }
    let mut ranked: Vec<(Colour, usize)> = counts.iter().map(|(colour, count)| (*colour, *count)).collect();
    ranked.sort_unstable_by_key(|(colour, count)| (std::cmp::Reverse(*count), *colour));

    // Greedy clustering: the most frequent colours represent those near them.
    let mut chosen: Vec<Colour> = Vec::new();
    let mut strangers = 0;
    for (colour, count) in &ranked {
        if chosen.iter().all(|swatch| channel_difference(*swatch, *colour) >= MIN_CHANNEL_DIFFERENCE) {
            if chosen.len() < MAX_PALETTE_COLOURS {
                chosen.push(*colour);
            } else {
                strangers += count;
            }
        }
    }
    if strangers as f64 > MAX_OUTLIER_SHARE * triangles.len() as f64 {
        return None;
    }
    let nearest = |colour: Colour| {
        chosen.iter().copied().min_by_key(|swatch| channel_difference(*swatch, colour)).unwrap_or(colour)
    };
    let of: FxHashMap<Colour, Colour> =
        ranked.iter().map(|(colour, _)| (*colour, nearest(*colour))).collect();
    Some(triangles.iter().map(|(colour, _)| of.get(colour).copied().unwrap_or(*colour)).collect())
}

/// Mean of colours; opaque.
pub(crate) fn mean(triangles: &[(Colour, bool)]) -> Colour {
    let count = triangles.len().max(1) as u64;
    let channel = |of: fn(&Colour) -> u8| {
        let sum: u64 = triangles.iter().map(|(colour, _)| u64::from(of(colour))).sum();
        ((sum + count / 2) / count) as u8
    };
    Colour::rgb(channel(|c| c.r), channel(|c| c.g), channel(|c| c.b))
}

/// Maximum difference of two colours in any channel.
pub(crate) fn channel_difference(a: Colour, b: Colour) -> u32 {
    let of = |a: u8, b: u8| u32::from(a.abs_diff(b));
    of(a.r, b.r).max(of(a.g, b.g)).max(of(a.b, b.b))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flat_colours(colours: &[Colour]) -> Vec<(Colour, bool)> {
        colours.iter().map(|colour| (*colour, true)).collect()
    }

    #[test]
    fn cluster_palette_keeps_few_colours_and_merges_similar_ones() {
        let (red, nearly, blue) = (Colour::rgb(200, 0, 0), Colour::rgb(205, 8, 0), Colour::rgb(0, 0, 200));
        assert_eq!(cluster_palette(&flat_colours(&[nearly, red, blue, red])).unwrap(), [red, red, blue, red]);
        assert_eq!(cluster_colours(&[(red, true), (blue, true)]), [red, blue]);
        assert_eq!(cluster_colours(&[(red, false), (blue, true)]), [Colour::rgb(100, 0, 100); 2]);
        assert!(cluster_colours(&[]).is_empty());
    }

    #[test]
    fn cluster_palette_refuses_a_photograph() {
        let shades = |greens: std::ops::Range<u8>| -> Vec<Colour> {
            (0..=255).flat_map(|r| greens.clone().map(move |g| Colour::rgb(r, g * 36, 100))).collect()
        };
        let photograph = flat_colours(&shades(0..8));
        assert_eq!(cluster_palette(&photograph), None);
        assert_eq!(mean(&photograph), Colour::rgb(128, 126, 100));
        // A smooth gradient of one hue gives a few colours, each near those that it represents.
        let run = shades(0..1);
        let kept = cluster_palette(&flat_colours(&run)).unwrap();
        assert!(kept.iter().zip(&run).all(|(a, b)| channel_difference(*a, *b) < MIN_CHANNEL_DIFFERENCE));
        assert!(kept.iter().any(|colour| *colour != kept[0]));
    }
}
