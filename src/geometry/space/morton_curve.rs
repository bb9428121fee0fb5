//! [`along_curve`]: position along a Morton curve over all of space.
//!
//! The curve does not depend on the box of a model, so the order of two positions depends on nothing else.
//!
//! Source: Morton, *A Computer Oriented Geodetic Data Base and a New Technique in File Sequencing*, 1966.

use std::cmp::Ordering;

use glam::DVec3;

/// Number of cells from zero in each direction of an axis, so that the cells of three axes fit in 64 bits.
/// Positions in one cell are compared exactly.
pub(crate) const CELLS_PER_HALF_AXIS: f64 = (1u32 << 20) as f64;

/// Morton code of the cell that contains a position. Signs come first, then the cells from zero outward.
/// Positions outside all cells are clamped to the last one.
pub(crate) fn along_curve(place: DVec3, cell: f64) -> u64 {
    let number = |x: f64| {
        let from_zero = (x.abs() / cell).min(CELLS_PER_HALF_AXIS - 1.0) as u64;
        // Cells below zero are mirrored, so that coordinates increase along the curve.
        if x < 0.0 {
            CELLS_PER_HALF_AXIS as u64 - 1 - from_zero
        } else {
            from_zero + CELLS_PER_HALF_AXIS as u64
        }
    };
    let [x, y, z] = place.to_array().map(|x| spread(number(x)));
    x | y << 1 | z << 2
}

/// Exact order of two positions along the curve: the axis that separates them at the largest cells decides.
///
/// Source: Connor and Kumar, *Fast construction of k-nearest neighbor graphs for point clouds*, 2010, section
/// 3, for floating-point coordinates.
pub(crate) fn along_exact_curve(a: DVec3, b: DVec3) -> Ordering {
    if !(a.is_finite() && b.is_finite()) {
        // Positions that are not finite are unused and sort last.
        return b.is_finite().cmp(&a.is_finite()).then_with(|| by_coordinates(a, b));
    }
    let (mut level, mut order) = (i64::MIN, Ordering::Equal);
    for (p, q) in [(a.z, b.z), (a.y, b.y), (a.x, b.x)] {
        let parts = parting_level(p, q);
        if parts > level {
            (level, order) = (parts, p.total_cmp(&q));
        }
    }
    order
}

/// Level of the largest cells that separate two numbers; the minimum for equal ones.
fn parting_level(p: f64, q: f64) -> i64 {
    const DIGITS: u32 = f64::MANTISSA_DIGITS - 1;
    if (p < 0.0) != (q < 0.0) {
        return i64::MAX;
    }
    let (p, q) = (p.abs().to_bits(), q.abs().to_bits());
    // Subnormal numbers use the digits of the smallest normal exponent.
    let exponent = |bits: u64| (bits >> DIGITS).max(1) as i64;
    let digits = |bits: u64| bits & ((1 << DIGITS) - 1) | u64::from(bits >> DIGITS > 0) << DIGITS;
    if p == q {
        i64::MIN
    } else if exponent(p) == exponent(q) {
        let highest = 63 - (digits(p) ^ digits(q)).leading_zeros();
        exponent(p) - i64::from(DIGITS) + i64::from(highest)
    } else {
        exponent(p).max(exponent(q))
    }
}

/// Spreads the 21 lowest bits, with two zeros after each.
pub(crate) fn spread(mut bits: u64) -> u64 {
    bits = (bits | bits << 32) & 0x001f_0000_0000_ffff;
    bits = (bits | bits << 16) & 0x001f_0000_ff00_00ff;
    bits = (bits | bits << 8) & 0x100f_00f0_0f00_f00f;
    bits = (bits | bits << 4) & 0x10c3_0c30_c30c_30c3;
    (bits | bits << 2) & 0x1249_2492_4924_9249
}

fn by_coordinates(a: DVec3, b: DVec3) -> Ordering {
    a.x.total_cmp(&b.x).then_with(|| a.y.total_cmp(&b.y)).then_with(|| a.z.total_cmp(&b.z))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::numbers::noise::{hash, unit_interval};
    use crate::geometry::numbers::powers_of_two::power_of_two_above;

    #[test]
    fn morton_codes_spread_bits_and_saturate_at_the_limits() {
        assert_eq!(spread(0b1011), 0b1_000_001_001);
        assert_eq!(spread((1 << 21) - 1), 0x1249_2492_4924_9249);
        assert_eq!(along_curve(DVec3::splat(1e300), 1.0), (1 << 63) - 1);
        assert_eq!(along_curve(DVec3::splat(-1e300), 1.0), 0);
        let zero = 0b111 << 60;
        assert_eq!(along_curve(DVec3::new(0.5, 1.0, 2.0), 1.0), zero | 0b100_010);
        assert!(along_curve(DVec3::new(-0.5, 1.0, 2.0), 1.0) < zero);
    }

    #[test]
    fn morton_order_does_not_depend_on_the_cell_size() {
        // Numbers of very different sizes and both signs.
        let number = |k: u64| {
            let chance = |word: u64| unit_interval(hash(7, &[k, word]));
            (chance(0) - 0.5) * [1.0, 0.1, 1e-4, 1e-7, 1e-12][(chance(1) * 5.0) as usize]
        };
        let mut sorted: Vec<DVec3> =
            (0..300).map(|k| DVec3::new(number(3 * k), number(3 * k + 1), number(3 * k + 2))).collect();
        sorted.sort_by(|a, b| along_exact_curve(*a, *b));
        for cell in [1e-6, 1e-5, 1e-3, 0.1].map(power_of_two_above) {
            assert!(sorted.is_sorted_by_key(|p| along_curve(*p, cell)), "{cell}");
        }
        assert_eq!(along_exact_curve(DVec3::ZERO, DVec3::new(0.0, 0.0, 5e-324)), Ordering::Less);
        let lost = DVec3::new(f64::NAN, 0.0, 0.0);
        assert_eq!(along_exact_curve(lost, DVec3::X), Ordering::Greater);
    }
}
