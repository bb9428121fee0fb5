//! [`swatches`]: a few flat colours that stand for many.

use rustc_hash::FxHashMap;

use crate::colour::srgb::Colour;

/// No more flat colours than this; what has more is a photograph.
const MOST: usize = 64;

/// Colours that differ by less than this in every channel are one.
pub(crate) const ALIKE: u32 = 28;

/// Share of the colours that may be strangers to all swatches: blends at the borders of a palette.
const STRANGERS: f64 = 0.02;

/// Share of triangles whose own pixels must be alike in a palette.
const FLAT: f64 = 0.7;

/// For each colour of a triangle, and whether the triangle is of one colour, the flat one that stands
/// for it: the colours of a palette; or the mean of all where there is none.
pub(crate) fn swatches(triangles: &[(Colour, bool)]) -> Vec<Colour> {
    of_palette(triangles).unwrap_or_else(|| vec![mean(triangles); triangles.len()])
}

/// For each colour of a triangle, and whether the triangle is of one colour, the one of a palette that stands for it; none where
/// there would be more than 64 or where many triangles are of several colours.
pub(crate) fn of_palette(triangles: &[(Colour, bool)]) -> Option<Vec<Colour>> {
    let flat = triangles.iter().filter(|(_, flat)| *flat).count();
    if (flat as f64) < FLAT * triangles.len() as f64 {
        return None;
    }
    let mut counts: FxHashMap<Colour, usize> = FxHashMap::default();
    for (colour, _) in triangles {
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
    if strangers as f64 > STRANGERS * triangles.len() as f64 {
        return None;
    }
    let nearest = |colour: Colour| {
        chosen.iter().copied().min_by_key(|swatch| difference(*swatch, colour)).unwrap_or(colour)
    };
    let of: FxHashMap<Colour, Colour> =
        ranked.iter().map(|(colour, _)| (*colour, nearest(*colour))).collect();
    Some(triangles.iter().map(|(colour, _)| of.get(colour).copied().unwrap_or(*colour)).collect())
}

/// The mean of colours; opaque.
pub(crate) fn mean(triangles: &[(Colour, bool)]) -> Colour {
    let count = triangles.len().max(1) as u64;
    let channel = |of: fn(&Colour) -> u8| {
        let sum: u64 = triangles.iter().map(|(colour, _)| u64::from(of(colour))).sum();
        ((sum + count / 2) / count) as u8
    };
    Colour::rgb(channel(|c| c.r), channel(|c| c.g), channel(|c| c.b))
}

/// The greatest difference of two colours in a channel.
pub(crate) fn difference(a: Colour, b: Colour) -> u32 {
    let of = |a: u8, b: u8| u32::from(a.abs_diff(b));
    of(a.r, b.r).max(of(a.g, b.g)).max(of(a.b, b.b))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flat(colours: &[Colour]) -> Vec<(Colour, bool)> {
        colours.iter().map(|colour| (*colour, true)).collect()
    }

    #[test]
    fn a_palette_keeps_its_colours() {
        let (red, nearly, blue) = (Colour::rgb(200, 0, 0), Colour::rgb(205, 8, 0), Colour::rgb(0, 0, 200));
        assert_eq!(of_palette(&flat(&[nearly, red, blue, red])).unwrap(), [red, red, blue, red]);
        assert_eq!(swatches(&[(red, true), (blue, true)]), [red, blue]);
        assert_eq!(swatches(&[(red, false), (blue, true)]), [Colour::rgb(100, 0, 100); 2]);
        assert!(swatches(&[]).is_empty());
    }

    #[test]
    fn a_photograph_is_no_palette() {
        let shades = |greens: std::ops::Range<u8>| -> Vec<Colour> {
            (0..=255).flat_map(|r| greens.clone().map(move |g| Colour::rgb(r, g * 36, 100))).collect()
        };
        let photograph = flat(&shades(0..8));
        assert_eq!(of_palette(&photograph), None);
        assert_eq!(mean(&photograph), Colour::rgb(128, 126, 100));
        // A smooth run of one hue is few colours, each near what it stands for.
        let run = shades(0..1);
        let kept = of_palette(&flat(&run)).unwrap();
        assert!(kept.iter().zip(&run).all(|(a, b)| difference(*a, *b) < ALIKE));
        assert!(kept.iter().any(|colour| *colour != kept[0]));
    }
}
