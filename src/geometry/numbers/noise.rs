//! Hashes in place of a random generator, and smooth value noise (after Perlin 1985, Lewis 1989).
//!
//! The results depend on a seed and on integers only, never on a clock.

/// Odd number near 2^64 divided by the golden ratio. Its successive multiples are far apart.
const GOLDEN_RATIO_BITS: u64 = 0x9e37_79b9_7f4a_7c15;

/// Mixes a seed and a list of words into one number. Order and number of the words matter.
#[must_use]
pub fn hash(seed: u64, words: &[u64]) -> u64 {
    let mut state = mix(seed ^ GOLDEN_RATIO_BITS);
    for word in words {
        state = mix(state.wrapping_add(GOLDEN_RATIO_BITS) ^ mix(word.wrapping_add(GOLDEN_RATIO_BITS)));
    }
    state
}

/// Finaliser of SplitMix64 (Steele, Lea and Flood 2014): every output bit depends on every input bit.
const fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// Converts a hash to a number in [0, 1), using 53 bits.
#[must_use]
pub const fn unit_interval(hash: u64) -> f64 {
    (hash >> 11) as f64 / (1u64 << 53) as f64
}

/// Value noise in [-1, 1] on the line: random values at integers, joined by cubics that are level there.
///
/// The first derivative is continuous and the noise never repeats. Returns 0 for NaN and infinity.
#[must_use]
pub fn value_noise(seed: u64, x: f64) -> f64 {
    if !x.is_finite() {
        return 0.0;
    }
    let floor = x.floor();
    let at = |lattice: f64| 2.0 * unit_interval(hash(seed, &[(lattice as i64).cast_unsigned()])) - 1.0;
    let (here, next) = (at(floor), at(floor + 1.0));
    let t = x - floor;
    here + (next - here) * (t * t * (3.0 - 2.0 * t))
}

/// Value noise in [-1, 1] in space: random values at the corners of unit cubes, joined by cubics.
///
/// Returns 0 for NaN and infinity.
#[must_use]
pub(crate) fn value_noise_3d(seed: u64, place: [f64; 3]) -> f64 {
    if !place.iter().all(|x| x.is_finite()) {
        return 0.0;
    }
    let floor = place.map(f64::floor);
    let ease = |t: f64| t * t * (3.0 - 2.0 * t);
    let t = [0, 1, 2].map(|axis| ease(place[axis] - floor[axis]));
    let at = |corner: usize| {
        let word =
            |axis: usize| ((floor[axis] as i64).wrapping_add((corner >> axis & 1) as i64)).cast_unsigned();
        2.0 * unit_interval(hash(seed, &[word(0), word(1), word(2)])) - 1.0
    };
    let mix = |a: f64, b: f64, t: f64| a + (b - a) * t;
    let along = |corner: usize| mix(at(corner), at(corner + 1), t[0]);
    let across = |corner: usize| mix(along(corner), along(corner + 2), t[1]);
    mix(across(0), across(4), t[2])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hash_depends_on_the_seed_and_every_word() {
        let all = [
            hash(0, &[]),
            hash(1, &[]),
            hash(0, &[0]),
            hash(0, &[1]),
            hash(0, &[0, 0]),
            hash(0, &[0, 1]),
            hash(0, &[1, 0]),
            hash(1, &[0, 1]),
        ];
        for (i, a) in all.iter().enumerate() {
            for b in &all[i + 1..] {
                // Independent 64-bit numbers differ in about 32 bits.
                assert!((10..=54).contains(&(a ^ b).count_ones()), "{a:x} {b:x}");
            }
        }
        assert_eq!(hash(7, &[1, 2, 3]), hash(7, &[1, 2, 3]));
    }

    #[test]
    fn unit_interval_values_are_evenly_spread() {
        let mut tenths = [0usize; 10];
        for word in 0..10_000 {
            let unit = unit_interval(hash(3, &[word]));
            assert!((0.0..1.0).contains(&unit));
            tenths[(unit * 10.0) as usize] += 1;
        }
        assert!(tenths.iter().all(|count| (900..1100).contains(count)), "{tenths:?}");
        assert!((unit_interval(u64::MAX) - 1.0).abs() < 1e-15 && unit_interval(u64::MAX) < 1.0);
    }

    #[test]
    fn value_noise_is_smooth_and_spans_its_range() {
        let step = 1e-4;
        let (mut low, mut high) = (0.0_f64, 0.0_f64);
        for i in -200_000..200_000 {
            let x = f64::from(i) * 1e-3 + 0.000_05;
            let slopes = [x - step, x].map(|x| (value_noise(5, x + step) - value_noise(5, x)) / step);
            // A cubic between levels 2 apart is nowhere steeper than 3 and bends by at most 12.
            assert!(slopes[0].abs() < 3.001 && (slopes[1] - slopes[0]).abs() < 13.0 * step, "{x}");
            low = low.min(value_noise(5, x));
            high = high.max(value_noise(5, x));
        }
        assert!((-1.0..-0.95).contains(&low) && (0.95..=1.0).contains(&high), "{low} {high}");
    }

    #[test]
    fn value_noise_3d_is_smooth_and_spans_its_range() {
        let (mut least, mut most, mut last) = (1.0_f64, -1.0_f64, None);
        for step in 0..100_000 {
            let x = f64::from(step) * 0.01;
            let value = value_noise_3d(7, [x, 0.3 * x, -0.7 * x]);
            (least, most) = (least.min(value), most.max(value));
            assert!(last.is_none_or(|last: f64| (last - value).abs() < 0.06), "{x}");
            last = Some(value);
        }
        assert!(least > -1.0 && least < -0.8 && most < 1.0 && most > 0.8, "{least} {most}");
        assert_eq!(value_noise_3d(7, [f64::NAN, 0.0, 0.0]), 0.0);
        assert_ne!(value_noise_3d(7, [0.5; 3]), value_noise_3d(8, [0.5; 3]));
    }

    #[test]
    fn value_noise_passes_lattice_values_and_accepts_any_number() {
        assert_eq!(value_noise(9, 4.0), 2.0 * unit_interval(hash(9, &[4])) - 1.0);
        assert_ne!(value_noise(9, -3.0), value_noise(9, 3.0));
        for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert_eq!(value_noise(1, x), 0.0);
        }
        assert!(value_noise(1, 1e300).abs() <= 1.0 && value_noise(1, -1e300).abs() <= 1.0);
    }
}
