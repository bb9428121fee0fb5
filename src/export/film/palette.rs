//! Palette of at most 255 colours for a frame, without dithering.
//!
//! With at most 255 colours, all are exact. Otherwise the most frequent ones are exact: flat fills, ink and
//! paper. The remaining colours, which come from anti-aliasing and pictures, share the remaining entries.

use rustc_hash::FxHashMap;

/// Most colours of a palette. One of 256 entries marks unchanged pixels.
const MAX_COLOURS: usize = 255;

/// Fewest exact colours.
const MIN_EXACT_COLOURS: usize = 128;

/// Opaque colours and their numbers.
#[derive(Debug)]
pub(crate) struct Palette {
    colours: Vec<[u8; 3]>,
    numbers: FxHashMap<[u8; 3], u8>,
}

impl Palette {
    /// Computes the palette of some pixels.
    pub(crate) fn of(pixels: impl Iterator<Item = [u8; 3]>) -> Self {
        let mut counts: FxHashMap<[u8; 3], u64> = FxHashMap::default();
        for pixel in pixels {
            *counts.entry(pixel).or_default() += 1;
        }
        let mut counted: Vec<([u8; 3], u64)> = counts.into_iter().collect();
        counted.sort_unstable_by(|a, b| b.1.cmp(&a.1).then(a.0.cmp(&b.0)));
        let exact = if counted.len() <= MAX_COLOURS { counted.len() } else { MIN_EXACT_COLOURS };
        let mut colours: Vec<[u8; 3]> = counted.iter().take(exact).map(|(colour, _)| *colour).collect();
        colours.extend(means(counted.split_off(exact), MAX_COLOURS - exact));
        let numbers = colours.iter().zip(0..).map(|(colour, number)| (*colour, number)).collect();
        Self { colours, numbers }
    }

    /// Number of the nearest colour.
    pub(crate) fn number(&mut self, colour: [u8; 3]) -> u8 {
        let nearest = || {
            let squared_difference = |a: u8, b: u8| u32::from(a.abs_diff(b)).pow(2);
            let distance = |palette_colour: &[u8; 3]| {
                palette_colour.iter().zip(colour).map(|(a, b)| squared_difference(*a, b)).sum::<u32>()
            };
            let best = self
                .colours
                .iter()
                .zip(0_u8..)
                .min_by_key(|(palette_colour, number)| (distance(palette_colour), *number));
            best.map_or(0, |(_, number)| number)
        };
        if let Some(cached) = self.numbers.get(&colour) {
            return *cached;
        }
        let number = nearest();
        self.numbers.insert(colour, number);
        number
    }

    /// Number that marks unchanged pixels.
    pub(crate) fn unchanged(&self) -> u8 {
        self.colours.len().min(MAX_COLOURS) as u8
    }

    /// All colours with three bytes each, and one entry for unchanged pixels.
    pub(crate) fn bytes(&self) -> Vec<u8> {
        self.colours.iter().flatten().copied().chain([0, 0, 0]).collect()
    }
}

/// Mean colours of at most `max_count` groups, by median cut: the bounding box of the colours is repeatedly cut at
/// its median along its longest side.
///
/// Source: Heckbert, *Color image quantization for frame buffer display*, SIGGRAPH 1982.
fn means(colours: Vec<([u8; 3], u64)>, max_count: usize) -> Vec<[u8; 3]> {
    let mut boxes = vec![colours];
    boxes.retain(|colour_box| !colour_box.is_empty());
    while boxes.len() < max_count {
        // Cut next a long box, preferably one with many pixels.
        let priority = |colour_box: &Vec<([u8; 3], u64)>| {
            let count = colour_box.iter().map(|(_, count)| count).sum::<u64>() as f64;
            f64::from(longest(colour_box).0) * count.sqrt().sqrt()
        };
        let next = (0..boxes.len())
            .max_by(|a, b| priority(&boxes[*a]).total_cmp(&priority(&boxes[*b])).then(b.cmp(a)));
        let Some(next) = next.filter(|next| longest(&boxes[*next]).0 > 0) else { break };
        let mut colour_box = boxes.swap_remove(next);
        let (_, channel) = longest(&colour_box);
        colour_box.sort_unstable_by_key(|(colour, _)| (colour[channel], *colour));
        let half = colour_box.iter().map(|(_, count)| count).sum::<u64>() / 2;
        let mut sum = 0;
        let mut is_lower_half = |(_, count): &([u8; 3], u64)| {
            sum += count;
            sum <= half
        };
        let split_index =
            colour_box.iter().take_while(|entry| is_lower_half(entry)).count().clamp(1, colour_box.len() - 1);
        let rest = colour_box.split_off(split_index);
        boxes.extend([colour_box, rest]);
    }
    let mean = |colour_box: &Vec<([u8; 3], u64)>| {
        let count = colour_box.iter().map(|(_, count)| count).sum::<u64>().max(1);
        let sum = |channel: usize| {
            colour_box.iter().map(|(colour, count)| u64::from(colour[channel]) * count).sum::<u64>()
        };
        [0, 1, 2].map(|channel| ((sum(channel) + count / 2) / count) as u8)
    };
    boxes.iter().map(mean).collect()
}

/// Length of the longest side of the bounding box of some colours, and its channel.
fn longest(colours: &[([u8; 3], u64)]) -> (u8, usize) {
    let length = |channel: usize| {
        let own = || colours.iter().map(|(colour, _)| colour[channel]);
        own().max().unwrap_or(0) - own().min().unwrap_or(0)
    };
    [0, 1, 2]
        .map(|channel| (length(channel), channel))
        .into_iter()
        .max_by_key(|(length, _)| *length)
        .unwrap_or((0, 0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn palette_of_255_colours_is_exact() {
        let colours: Vec<[u8; 3]> = (0..255_u8).map(|i| [i, 255 - i, i / 2]).collect();
        let mut palette = Palette::of(colours.iter().copied());
        let numbers: Vec<u8> = colours.iter().map(|colour| palette.number(*colour)).collect();
        let bytes = palette.bytes();
        for (colour, number) in colours.iter().zip(numbers) {
            assert_eq!(&bytes[usize::from(number) * 3..][..3], colour);
        }
        assert_eq!((palette.unchanged(), bytes.len()), (255, 768));
    }

    #[test]
    fn palette_of_many_colours_keeps_frequent_ones_exact() {
        let many = (0..40_000_u32).map(|i| [(i % 250) as u8, (i / 160) as u8, (i % 7) as u8 * 9]);
        let flat = std::iter::repeat_n([254, 3, 77], 5000);
        let mut palette = Palette::of(many.clone().chain(flat));
        let number = palette.number([254, 3, 77]);
        let bytes = palette.bytes();
        assert_eq!(&bytes[usize::from(number) * 3..][..3], [254, 3, 77]);
        assert_eq!(bytes.len(), 768);
        let far = many.map(|colour| {
            let own = &bytes[usize::from(palette.number(colour)) * 3..][..3];
            own.iter().zip(colour).map(|(a, b)| a.abs_diff(b)).max().unwrap_or(0)
        });
        assert!(far.max().unwrap_or(255) < 64);
    }
}
