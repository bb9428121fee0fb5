//! Comparison of pixels: whole pictures with anti-aliasing, and windows without.

use resvg::tiny_skia::PremultipliedColorU8 as Pixel;

use super::window_extremes::square_extremes;
use crate::diff::tolerances;

/// Largest difference of a channel that counts as equal, because opacities and blends are rounded several
/// times. No pair in `tests/library/diff_pictures.rs` that draws one picture in two ways differs by more.
pub(crate) const MAX_CHANNEL_DIFFERENCE: u8 = 2;
/// Pixels per tolerance in close inspection.
const PIXELS_PER_TOLERANCE: f64 = 4.0;
/// Least pixels per px in close inspection, so that thin lines are visible.
const MIN_FINE_SCALE: f64 = 4.0;
/// Most pixels per side in close inspection, without the margin.
const MAX_CORE_PIXELS: f64 = 256.0;
/// Up to this radius, extremes are searched pixel by pixel.
const MAX_DIRECT_RADIUS_PIXELS: usize = 2;
/// Up to this radius, equal pixels are searched in a disc; above it, extremes are compared.
const MAX_DISC_RADIUS_PIXELS: usize = 6;
/// Change in coverage of a pixel when an edge moves by one pixel: both edges of a thin diagonal line.
const EDGE_COVERAGE_PER_PIXEL: f64 = 2.0 * std::f64::consts::SQRT_2;

fn channels(pixel: Pixel) -> [u8; 4] {
    [pixel.red(), pixel.green(), pixel.blue(), pixel.alpha()]
}

/// Largest difference of a channel.
fn difference(a: Pixel, b: Pixel) -> u8 {
    let (a, b) = (channels(a), channels(b));
    a.iter().zip(&b).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0)
}

/// Visits each channel of each pixel of both pictures: the index of the pixel, the value in one picture, the
/// value in the other one, and the extremes of the other one within `reach` pixels.
fn visit_extremes(
    [a, b]: [&[Pixel]; 2],
    columns: usize,
    reach: usize,
    mut visit: impl FnMut(usize, [u8; 4]),
) {
    for channel in 0..4 {
        let values = |picture: &[Pixel]| picture.iter().map(|p| channels(*p)[channel]).collect::<Vec<u8>>();
        let (a, b) = (values(a), values(b));
        for (own, other) in [(&a, &b), (&b, &a)] {
            let minima = square_extremes(other, columns, reach, u8::min);
            let maxima = square_extremes(other, columns, reach, u8::max);
            for (index, value) in own.iter().enumerate() {
                visit(index, [*value, other[index], minima[index], maxima[index]]);
            }
        }
    }
}

/// Comparison of two anti-aliased pictures, one entry per pixel.
pub(crate) struct CoarseComparison {
    /// Largest difference of a channel.
    pub difference: Vec<u8>,
    /// Difference not explained by an edge shifted within the tolerance.
    pub excess: Vec<u8>,
}

impl CoarseComparison {
    /// Whether any pixel differs.
    pub(crate) fn has_any(&self) -> bool {
        self.difference.iter().any(|difference| *difference > MAX_CHANNEL_DIFFERENCE)
    }
}

/// Compares two pictures; `tolerance_pixels` is the tolerance in pixels.
pub(crate) fn coarse([a, b]: [&[Pixel]; 2], columns: usize, tolerance_pixels: f64) -> CoarseComparison {
    let pixel_difference = |(a, b): (&Pixel, &Pixel)| if a == b { 0 } else { difference(*a, *b) };
    let differences: Vec<u8> = a.iter().zip(b).map(pixel_difference).collect();
    let mut excess = vec![0u8; differences.len()];
    if differences.iter().all(|difference| *difference <= MAX_CHANNEL_DIFFERENCE) {
        return CoarseComparison { difference: differences, excess };
    }
    // From one pixel on, any colour between those nearby counts as equal.
    let radius = (tolerance_pixels.ceil() as usize).max(1);
    let edge_share = (EDGE_COVERAGE_PER_PIXEL * tolerance_pixels).min(1.0);
    let channel_excess = |value: u8, other_value: u8, min_value: u8, max_value: u8| {
        if value.abs_diff(other_value) <= MAX_CHANNEL_DIFFERENCE {
            return 0;
        }
        let unclamped_excess = match edge_share < 1.0 {
            true => f64::from(value.abs_diff(other_value)) - edge_share * f64::from(max_value - min_value),
            false => f64::from(value.saturating_sub(max_value).max(min_value.saturating_sub(value))),
        };
        (unclamped_excess - f64::from(MAX_CHANNEL_DIFFERENCE)).clamp(0.0, 255.0).ceil() as u8
    };
    if radius <= MAX_DIRECT_RADIUS_PIXELS {
        // Small radius: test only the pixels that differ.
        let rows = differences.len() / columns.max(1);
        for index in (0..differences.len()).filter(|index| differences[*index] > MAX_CHANNEL_DIFFERENCE) {
            let (column, row) = (index % columns, index / columns);
            let xs = column.saturating_sub(radius)..=(column + radius).min(columns - 1);
            let ys = row.saturating_sub(radius)..=(row + radius).min(rows - 1);
            for (own, other) in [(a, b), (b, a)] {
                let (mut min_channels, mut max_channels) = ([255u8; 4], [0u8; 4]);
                for y in ys.clone() {
                    for pixel in &other[y * columns + xs.start()..=y * columns + xs.end()] {
                        for (k, value) in channels(*pixel).into_iter().enumerate() {
                            min_channels[k] = min_channels[k].min(value);
                            max_channels[k] = max_channels[k].max(value);
                        }
                    }
                }
                let (values, other_values) = (channels(own[index]), channels(other[index]));
                let pixel_excess = (0..4)
                    .map(|k| channel_excess(values[k], other_values[k], min_channels[k], max_channels[k]))
                    .max();
                excess[index] = excess[index].max(pixel_excess.unwrap_or(0));
            }
        }
    } else {
        visit_extremes([a, b], columns, radius, |index, [own, other, min, max]| {
            excess[index] = excess[index].max(channel_excess(own, other, min, max));
        });
    }
    // A gap or an overlap between fills that is narrower than the tolerance is a thin line with equal pixels
    // around it.
    let gap = (255.0 * std::f64::consts::SQRT_2 * tolerance_pixels.min(1.0)).min(255.0) as u8;
    let is_alone = |index: usize| {
        let row = |centre_index: usize| {
            differences.get(centre_index.saturating_sub(1)..=centre_index + 1).unwrap_or_default()
        };
        let rows = [index.checked_sub(columns), Some(index), Some(index + columns)].into_iter().flatten();
        rows.flat_map(row).any(|difference| *difference <= MAX_CHANNEL_DIFFERENCE)
    };
    for index in 0..excess.len() {
        if excess[index] > 0 && differences[index] <= gap && is_alone(index) {
            excess[index] = 0;
        }
    }
    CoarseComparison { difference: differences, excess }
}

/// Close inspection of one pixel of the coarse comparison.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FineComparison {
    /// Pixels per px.
    pub scale: f64,
    /// Side of the inspected area in pixels.
    pub core: usize,
    /// Tolerance in pixels, which is also the margin around the core.
    pub reach: usize,
}

impl FineComparison {
    /// Inspection of a pixel in a picture with `coarse` pixels per px.
    pub(crate) fn new(coarse: f64, tolerance: f64) -> Self {
        let scale = PIXELS_PER_TOLERANCE / tolerance.max(tolerances::MIN_DIVISOR_PX);
        let scale = scale.max(MIN_FINE_SCALE).max(coarse);
        let scale = scale.min(MAX_CORE_PIXELS * coarse);
        let reach = (tolerance * scale).ceil().clamp(1.0, 4.0 * MAX_CORE_PIXELS) as usize;
        Self { scale, core: (scale / coarse).ceil() as usize, reach }
    }

    /// Whether the core differs: in any pixel, or with `needs_square` in a square as wide as the tolerance.
    pub(crate) fn differs(self, pictures: [&[Pixel]; 2], needs_square: bool) -> bool {
        let size = self.core + 2 * self.reach;
        let [a, b] = pictures;
        if a.len() != size * size || b.len() != a.len() {
            return true;
        }
        if a == b {
            return false;
        }
        let is_unlike = match self.reach <= MAX_DISC_RADIUS_PIXELS {
            true => self.by_disc(pictures, size),
            false => self.by_extremes(pictures, size),
        };
        if !needs_square {
            return is_unlike.iter().any(|unlike| *unlike);
        }
        // Side of the largest square of differing pixels that ends at each pixel (dynamic programming).
        let mut above = vec![0usize; self.core];
        for row in is_unlike.chunks(self.core) {
            let (mut left, mut corner) = (0, 0);
            for (unlike, above) in row.iter().zip(&mut above) {
                let side = if *unlike { 1 + left.min(corner).min(*above) } else { 0 };
                if side >= self.reach {
                    return true;
                }
                (corner, left) = (*above, side);
                *above = side;
            }
        }
        false
    }

    /// Pixels of the core without an equal pixel within the tolerance in the other picture.
    fn by_disc(self, [a, b]: [&[Pixel]; 2], size: usize) -> Vec<bool> {
        let reach = self.reach as isize;
        let mut disc: Vec<[isize; 2]> = (-reach..=reach)
            .flat_map(|y| (-reach..=reach).map(move |x| [x, y]))
            .filter(|[x, y]| x * x + y * y <= reach * reach)
            .collect();
        disc.sort_by_key(|[x, y]| x * x + y * y);
        let has_no_match = |pixel: Pixel, other: &[Pixel], x: usize, y: usize| {
            !disc.iter().any(|[dx, dy]| {
                let (x, y) = (x.wrapping_add_signed(*dx), y.wrapping_add_signed(*dy));
                other
                    .get(y * size + x)
                    .is_some_and(|other| difference(pixel, *other) <= MAX_CHANNEL_DIFFERENCE)
            })
        };
        self.core_pixels(size, |x, y| {
            let (p, q) = (a[y * size + x], b[y * size + x]);
            difference(p, q) > MAX_CHANNEL_DIFFERENCE
                && (has_no_match(p, b, x, y) || has_no_match(q, a, x, y))
        })
    }

    /// Pixels of the core outside the range of colours within the tolerance in the other picture.
    fn by_extremes(self, pictures: [&[Pixel]; 2], size: usize) -> Vec<bool> {
        let mut is_unmatched = vec![false; size * size];
        visit_extremes(pictures, size, self.reach, |index, [value, _, min, max]| {
            is_unmatched[index] |= value > max.saturating_add(MAX_CHANNEL_DIFFERENCE)
                || value < min.saturating_sub(MAX_CHANNEL_DIFFERENCE);
        });
        self.core_pixels(size, |x, y| is_unmatched[y * size + x])
    }

    /// Evaluates a condition for each pixel of the core.
    fn core_pixels(self, size: usize, predicate: impl Fn(usize, usize) -> bool) -> Vec<bool> {
        let inner = self.reach..size - self.reach;
        inner.clone().flat_map(|y| inner.clone().map(move |x| (x, y))).map(|(x, y)| predicate(x, y)).collect()
    }
}
