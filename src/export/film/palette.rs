//! [`Palette`]: the at most 255 colours that stand for those of a frame, without dithering.
//!
//! Where there are no more colours than that, all are exact. Otherwise the most frequent ones are: these are the flat fills,
//! the ink and the paper. What is left, mixtures along the rims, shares the places that are left.

use rustc_hash::FxHashMap;

/// Most colours of a palette: one of 256 places says that a pixel does not change.
const MOST: usize = 255;

/// So many of them are exact at least.
const EXACT: usize = 128;

/// Bits of a channel by which rare colours are gathered.
const BITS: u32 = 5;

/// Opaque colours and their numbers.
#[derive(Debug)]
pub(super) struct Palette {
    colours: Vec<[u8; 3]>,
    numbers: FxHashMap<[u8; 3], u8>,
}

/// Many pixels of about one colour.
#[derive(Default, Clone, Copy)]
struct Bucket {
    count: u64,
    sum: [u64; 3],
}

impl Palette {
    /// The palette of some pixels.
    pub fn of(pixels: impl Iterator<Item = [u8; 3]>) -> Self {
        let mut counts: FxHashMap<[u8; 3], u64> = FxHashMap::default();
        for pixel in pixels {
            *counts.entry(pixel).or_default() += 1;
        }
        let mut counted: Vec<([u8; 3], u64)> = counts.into_iter().collect();
        counted.sort_unstable_by(|a, b| b.1.cmp(&a.1).then(a.0.cmp(&b.0)));
        let exact = if counted.len() <= MOST { counted.len() } else { EXACT };
        let mut colours: Vec<[u8; 3]> = counted.iter().take(exact).map(|(colour, _)| *colour).collect();
        let mut buckets: FxHashMap<[u8; 3], Bucket> = FxHashMap::default();
        for (colour, count) in counted.iter().skip(exact) {
            let bucket = buckets.entry(colour.map(|channel| channel >> (8 - BITS))).or_default();
            bucket.count += count;
            bucket.sum.iter_mut().zip(colour).for_each(|(sum, channel)| *sum += u64::from(*channel) * count);
        }
        let mut gathered: Vec<([u8; 3], Bucket)> = buckets.into_iter().collect();
        gathered.sort_unstable_by(|a, b| b.1.count.cmp(&a.1.count).then(a.0.cmp(&b.0)));
        let mean = |Bucket { count, sum }: Bucket| sum.map(|sum| ((sum + count / 2) / count.max(1)) as u8);
        colours.extend(gathered.into_iter().take(MOST - exact).map(|(_, bucket)| mean(bucket)));
        let numbers = colours.iter().zip(0..).map(|(colour, number)| (*colour, number)).collect();
        Self { colours, numbers }
    }

    /// The number of the colour that is nearest to this one.
    pub fn number(&mut self, colour: [u8; 3]) -> u8 {
        let nearest = || {
            let apart = |a: u8, b: u8| u32::from(a.abs_diff(b)).pow(2);
            let distance = |own: &[u8; 3]| own.iter().zip(colour).map(|(a, b)| apart(*a, b)).sum::<u32>();
            let best = self.colours.iter().zip(0_u8..).min_by_key(|(own, number)| (distance(own), *number));
            best.map_or(0, |(_, number)| number)
        };
        if let Some(known) = self.numbers.get(&colour) {
            return *known;
        }
        let number = nearest();
        self.numbers.insert(colour, number);
        number
    }

    /// The number that says that a pixel does not change.
    pub fn unchanged(&self) -> u8 {
        self.colours.len().min(MOST) as u8
    }

    /// All colours, three bytes each, and one more for what does not change.
    pub fn bytes(&self) -> Vec<u8> {
        self.colours.iter().flatten().copied().chain([0, 0, 0]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_colours_are_exact() {
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
    fn of_many_colours_the_frequent_ones_are_exact_and_the_others_near() {
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
