//! [`DarknessMap`]: darkness of a picture as a summed-area table, and outlines of its dark parts.

use glam::DVec2;
use kurbo::Point;

use super::pixel_picture::Picture;
use crate::geometry::plane::douglas_peucker::{douglas_peucker, farthest_point};
use crate::geometry::plane::marching_squares::marching_squares;
use crate::geometry::plane::planar_distance::segment_distance_squared;
use crate::geometry::plane::polylines::ring_area;

/// Maximum deviation of traced outlines, as a fraction of a segment, before they are simplified.
const MAX_CURVE_ERROR_PX: f64 = 0.05;

/// Maximum number of points on the outlines of a picture. With more, no outlines are traced.
const MAX_CROSSINGS: usize = 1 << 20;

/// Darkness of a picture on white paper, 0 to 1, averaged over any rectangle.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct DarknessMap {
    /// Width in pixels, at least 1.
    pub width: usize,
    /// Height in pixels, at least 1.
    pub height: usize,
    /// Summed-area table: for each pixel corner, the sum of all pixels above and to the left of it.
    sums: Vec<f64>,
}

/// Options for tracing outlines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct OutlineTracing {
    /// Pixels darker than this are inside, 0 to 1.
    pub level: f64,
    /// Size of a pixel in the result, along x and y.
    pub scale: [f64; 2],
    /// Maximum deviation of outlines, in the scaled units.
    pub tolerance: f64,
    /// Minimum enclosed area, in the scaled units. Smaller outlines are dropped.
    pub speck: f64,
    /// Whether the picture repeats outside its frame.
    pub repeats: bool,
}

impl DarknessMap {
    /// Darkness of the pixels of a picture.
    #[must_use]
    pub(crate) fn of(picture: &Picture) -> Self {
        Self::of_values(picture.width, picture.height, |column, row| {
            let c = picture.at(column, row);
            let grey = (f64::from(c.r) + f64::from(c.g) + f64::from(c.b)) / 765.0;
            (1.0 - grey) * f64::from(c.a) / 255.0
        })
    }

    /// Builds the table from the darkness of each pixel.
    #[must_use]
    pub(crate) fn of_values(width: usize, height: usize, value: impl Fn(usize, usize) -> f64) -> Self {
        let stride = width + 1;
        let mut sums = vec![0.0; stride * (height + 1)];
        for row in 0..height {
            let mut along = 0.0;
            for column in 0..width {
                along += value(column, row);
                sums[(row + 1) * stride + column + 1] = sums[row * stride + column + 1] + along;
            }
        }
        Self { width, height, sums }
    }

    /// Sum of everything above and to the left of a point, interpolated within pixels.
    fn sum(&self, x: f64, y: f64) -> f64 {
        let (i, j) = ((x as usize).min(self.width - 1), (y as usize).min(self.height - 1));
        let (s, t) = (x - i as f64, y - j as f64);
        let at = |i: usize, j: usize| self.sums[j * (self.width + 1) + i];
        let row = |j: usize| at(i, j) + (at(i + 1, j) - at(i, j)) * s;
        row(j) + (row(j + 1) - row(j)) * t
    }

    /// Mean darkness of a rectangle within the picture.
    #[must_use]
    pub(crate) fn mean(&self, [x0, y0]: [f64; 2], [x1, y1]: [f64; 2]) -> f64 {
        let sum = self.sum(x1, y1) - self.sum(x0, y1) - self.sum(x1, y0) + self.sum(x0, y0);
        sum / ((x1 - x0) * (y1 - y0)).max(f64::MIN_POSITIVE)
    }

    /// Downsamples to at most `columns` by `rows` pixels.
    #[must_use]
    pub(crate) fn at_most(&self, columns: usize, rows: usize) -> Self {
        let (width, height) = (columns.clamp(1, self.width), rows.clamp(1, self.height));
        let [x, y] = [self.width as f64 / width as f64, self.height as f64 / height as f64];
        Self::of_values(width, height, |column, row| {
            let (i, j) = (column as f64, row as f64);
            self.mean([i * x, j * y], [(i + 1.0) * x, (j + 1.0) * y])
        })
    }

    /// Outlines of the dark parts, in pixels from the upper left corner.
    ///
    /// Outlines are closed and do not repeat their first point. Dark is always on the same side, so holes
    /// turn the other way than islands. Returns `None` if there are too many points.
    #[must_use]
    pub(crate) fn outlines(&self, tracing: &OutlineTracing) -> Option<Vec<Vec<Point>>> {
        let (width, height) = (self.width as i64, self.height as i64);
        let inner =
            |i: i64, count: i64| if tracing.repeats { i.rem_euclid(count) } else { i.clamp(0, count - 1) };
        // Surround the picture by one ring of pixels that continues it, and by another that closes all
        // outlines. Clipping to the frame later removes the closing parts.
        let value = |i: i64, j: i64| {
            let (i, j) = (i - 2, j - 2);
            let (column, row) = (inner(i, width), inner(j, height));
            let [x, y] = [column as f64, row as f64];
            let signed_darkness = self.mean([x, y], [x + 1.0, y + 1.0]) - tracing.level;
            // No value is exactly on the level.
            let nonzero_darkness = if signed_darkness == 0.0 { f64::MIN_POSITIVE } else { signed_darkness };
            if (-1..=width).contains(&i) && (-1..=height).contains(&j) {
                nonzero_darkness
            } else {
                -nonzero_darkness.abs()
            }
        };
        let lines =
            marching_squares(&value, [self.width + 3, self.height + 3], MAX_CURVE_ERROR_PX, MAX_CROSSINGS)?;
        let frame = [self.width as f64, self.height as f64];
        let ring_of = |line: &Vec<DVec2>| {
            let ring: Vec<Point> = line.iter().map(|p| Point::new(p.x - 1.5, p.y - 1.5)).collect();
            let ring = simplified(&clip_to_frame(&ring, frame), frame, tracing);
            let [x, y] = tracing.scale;
            (ring.len() > 2 && (ring_area(&ring) * x * y).abs() > tracing.speck.max(f64::MIN_POSITIVE))
                .then_some(ring)
        };
        Some(lines.iter().filter_map(ring_of).collect())
    }
}

/// Clips a closed line, whose first point is its last, to the frame. Adds points where it crosses the frame
/// and moves points outside onto the frame.
fn clip_to_frame(line: &[Point], [width, height]: [f64; 2]) -> Vec<Point> {
    let mut ring: Vec<Point> = Vec::with_capacity(line.len());
    let mut push = |p: Point| {
        let p = Point::new(p.x.clamp(0.0, width), p.y.clamp(0.0, height));
        if ring.last() != Some(&p) {
            ring.push(p);
        }
    };
    for pair in line.windows(2) {
        let (a, b) = (pair[0], pair[1]);
        push(a);
        let mut crossings: Vec<f64> =
            [(a.x, b.x, 0.0), (a.x, b.x, width), (a.y, b.y, 0.0), (a.y, b.y, height)]
                .into_iter()
                .filter(|(a, b, at)| (a < at) != (b < at))
                .map(|(a, b, at)| (at - a) / (b - a))
                .collect();
        crossings.sort_by(f64::total_cmp);
        crossings.into_iter().for_each(|parameter| push(a.lerp(b, parameter)));
    }
    while ring.len() > 1 && ring.first() == ring.last() {
        ring.pop();
    }
    // Drop points between two others on the same side of the frame.
    let sides = |p: &Point| [p.x == 0.0, p.x == width, p.y == 0.0, p.y == height];
    let is_between = |a: &Point, b: &Point, c: &Point| {
        let [a, b, c] = [a, b, c].map(sides);
        (0..4).any(|side| a[side] && b[side] && c[side])
    };
    let mut simplified_ring: Vec<Point> = Vec::with_capacity(ring.len());
    for p in ring {
        while let [.., a, b] = &simplified_ring[..]
            && is_between(a, b, &p)
        {
            simplified_ring.pop();
        }
        simplified_ring.push(p);
    }
    while simplified_ring.len() > 2
        && is_between(
            &simplified_ring[simplified_ring.len() - 2],
            &simplified_ring[simplified_ring.len() - 1],
            &simplified_ring[0],
        )
    {
        simplified_ring.pop();
    }
    while simplified_ring.len() > 2
        && is_between(&simplified_ring[simplified_ring.len() - 1], &simplified_ring[0], &simplified_ring[1])
    {
        simplified_ring.remove(0);
    }
    simplified_ring
}

/// Simplifies a ring (Douglas-Peucker). Points where it reaches or leaves the frame are kept.
fn simplified(ring: &[Point], [width, height]: [f64; 2], tracing: &OutlineTracing) -> Vec<Point> {
    let n = ring.len();
    if n < 4 {
        return ring.to_vec();
    }
    let [x, y] = tracing.scale;
    let scaled: Vec<Point> = ring.iter().map(|p| Point::new(p.x * x, p.y * y)).collect();
    let on = |p: &Point| [p.x == 0.0, p.x == width, p.y == 0.0, p.y == height];
    let share_side = |a: &Point, b: &Point| (0..4).any(|side| on(a)[side] && on(b)[side]);
    let is_fixed = |k: usize| {
        let (before, current, after) = (&ring[(k + n - 1) % n], &ring[k], &ring[(k + 1) % n]);
        on(current).contains(&true)
            && !(share_side(before, current) && share_side(current, after) && share_side(before, after))
    };
    let mut fixed: Vec<usize> = (0..n).filter(|k| is_fixed(*k)).collect();
    if fixed.len() < 2 {
        // Split a free ring at any point and at the point farthest from it.
        let first = fixed.first().copied().unwrap_or(0);
        let away = |k: usize| (scaled[k] - scaled[first]).hypot2();
        let far = farthest_point(0..n, away, f64::NEG_INFINITY).unwrap_or(0);
        fixed = vec![first.min(far), first.max(far)];
    }
    // The ring continues to its first fixed point.
    fixed.push(fixed[0] + n);
    let is_kept = douglas_peucker(2 * n, &fixed, |a, b| {
        let off = |k: usize| segment_distance_squared(scaled[k % n], scaled[a % n], scaled[b % n]);
        farthest_point(a + 1..b, off, tracing.tolerance * tracing.tolerance)
    });
    (0..n).filter(|k| is_kept[*k] || is_kept[*k + n]).map(|k| ring[k]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRACING: OutlineTracing =
        OutlineTracing { level: 0.5, scale: [1.0; 2], tolerance: 0.05, speck: 0.0, repeats: false };

    /// Ring between two radii, with an edge one pixel soft.
    fn annulus(size: usize, [inner, outer]: [f64; 2]) -> DarknessMap {
        DarknessMap::of_values(size, size, |column, row| {
            let middle = size as f64 / 2.0;
            let p = DVec2::new(column as f64 + 0.5 - middle, row as f64 + 0.5 - middle).length();
            (outer + 0.5 - p).clamp(0.0, 1.0).min((p - inner + 0.5).clamp(0.0, 1.0))
        })
    }

    #[test]
    fn outlines_of_a_ring_have_its_radii_and_area() {
        let rings = annulus(64, [9.3, 25.8]).outlines(&TRACING).unwrap();
        let [outer, inner] = &rings[..] else { panic!("{}", rings.len()) };
        let (outer, inner) =
            if ring_area(outer).abs() > ring_area(inner).abs() { (outer, inner) } else { (inner, outer) };
        assert!(ring_area(outer) * ring_area(inner) < 0.0, "holes turn the other way");
        for (ring, radius) in [(outer, 25.8), (inner, 9.3)] {
            let off = |p: &Point| ((*p - Point::new(32.0, 32.0)).hypot2().sqrt() - radius).abs();
            let worst = ring.iter().map(off).fold(0.0, f64::max);
            assert!(worst < 0.15, "{worst} px off");
            assert!((ring_area(ring).abs() / (std::f64::consts::PI * radius * radius) - 1.0).abs() < 0.01);
            assert!(ring.len() < 120, "{}", ring.len());
        }
        // With a larger speck size the hole disappears.
        let coarse = OutlineTracing { speck: 300.0, ..TRACING };
        assert_eq!(annulus(64, [9.3, 25.8]).outlines(&coarse).unwrap().len(), 1);
        // Downsampled, the ring keeps its area.
        let small = annulus(64, [9.3, 25.8]).at_most(32, 64).outlines(&TRACING).unwrap();
        let whole: f64 = small.iter().map(|ring| ring_area(ring)).sum::<f64>() * 2.0;
        let right = std::f64::consts::PI * (25.8_f64.powi(2) - 9.3_f64.powi(2));
        assert!((whole.abs() / right - 1.0).abs() < 0.01, "{whole} {right}");
    }

    #[test]
    fn outlines_of_dark_areas_at_the_frame_end_at_it() {
        let dark = DarknessMap::of_values(7, 4, |_, _| 1.0);
        let [ring] = &dark.outlines(&TRACING).unwrap()[..] else { panic!("one") };
        assert_eq!(ring.len(), 4, "{ring:?}");
        assert_eq!(ring_area(ring).abs(), 28.0);
        let left = DarknessMap::of_values(8, 6, |column, _| f64::from(u8::from(column < 3)));
        assert!((ring_area(&left.outlines(&TRACING).unwrap()[0]).abs() - 18.0).abs() < 1e-9);
    }

    #[test]
    fn outlines_of_a_repeating_picture_match_across_the_frame() {
        // Slanted band that leaves on the right where it enters on the left.
        let band = DarknessMap::of_values(32, 32, |column, row| {
            let way = (column as f64 + row as f64).rem_euclid(32.0) - 16.0;
            (8.5 - way.abs()).clamp(0.0, 1.0)
        });
        let rings = band.outlines(&OutlineTracing { repeats: true, ..TRACING }).unwrap();
        let on = |of: fn(&Point) -> (f64, f64), side: f64| {
            let mut found: Vec<i64> = rings
                .iter()
                .flatten()
                .map(of)
                .filter(|(across, _)| *across == side)
                .map(|(_, along)| (along * 1e6).round() as i64)
                .filter(|along| *along > 0 && *along < 32_000_000)
                .collect();
            found.sort_unstable();
            found
        };
        type CoordinateOrder = fn(&Point) -> (f64, f64);
        let [x, y]: [CoordinateOrder; 2] = [|p| (p.x, p.y), |p| (p.y, p.x)];
        assert!(on(x, 0.0) == on(x, 32.0) && !on(x, 0.0).is_empty(), "{:?} {:?}", on(x, 0.0), on(x, 32.0));
        assert!(on(y, 0.0) == on(y, 32.0) && !on(y, 0.0).is_empty());
    }
}
