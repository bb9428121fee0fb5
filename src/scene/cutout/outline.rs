//! [`Outline`]: the borders of what a mask leaves, as lines in the plane of its texels.
//!
//! Source: Lorensen and Cline, "Marching cubes", SIGGRAPH 1987, in two dimensions; cells with two diagonals as Nielson
//! and Hamann, "The asymptotic decider", 1991. Lines are thinned as Douglas and Peucker, "Algorithms for the reduction of the number of points", 1973.

use glam::DVec2;
use rustc_hash::FxHashMap;

use super::mask::Mask;
use crate::math::grouped::{Grouped, grouped};

/// A piece of border, with what is opaque on its left (x to the right, y upwards).
pub(super) type Segment = [DVec2; 2];

/// How far the lines go on beyond a picture whose border is repeated for ever, texels.
const FAR: f64 = 2e9;

/// How far the pieces of a border lie beside it before it is thinned, texels.
const STRAIGHT: f64 = 1e-3;

/// Cells of the index along each side, at most.
const MOST_CELLS: usize = 64;

/// Whoever asks for more pieces of border at once gets none.
pub(super) const MOST_SEGMENTS: usize = 100_000;

/// A picture whose texels part opaque from clear more often than this has no borders.
const MOST_CROSSINGS: usize = 1 << 22;

/// The borders of a mask, one period of them, by place.
pub(super) struct Outline {
    segments: Vec<Segment>,
    /// Where the same comes again, along x and along y.
    periods: [Option<f64>; 2],
    across: [usize; 2],
    cell: DVec2,
    cells: Grouped<u32>,
}

impl Outline {
    /// The borders of a mask, which may lie this far beside where they are exactly, texels; none if there are too many.
    pub fn new(mask: &Mask, tolerance: f64) -> Option<Self> {
        let size = mask.size();
        let periods = mask.periods();
        let reach = [0, 1].map(|k| periods[k].unwrap_or(size[k] - 1));
        let mut segments = Vec::new();
        for chain in trace(mask, reach)? {
            let mut line = thinned(chain, tolerance);
            extend(&mut line, reach, periods);
            segments.extend(line.windows(2).map(|pair| [pair[0], pair[1]]).filter(|[a, b]| a != b));
        }
        let across = reach.map(|count| (count / 4).clamp(1, MOST_CELLS));
        let cell =
            DVec2::new(reach[0].max(1) as f64 / across[0] as f64, reach[1].max(1) as f64 / across[1] as f64);
        let periods = periods.map(|period| period.map(|count| count as f64));
        let mut outline = Self { segments, periods, across, cell, cells: Grouped::default() };
        outline.cells = grouped(across[0] * across[1], |put| {
            for (number, [a, b]) in outline.segments.iter().enumerate() {
                outline.each_cell(a.min(*b), a.max(*b), |cell| put(cell, number as u32));
            }
        });
        Some(outline)
    }

    /// How many pieces of border a picture has.
    pub fn count(&self) -> usize {
        self.segments.len()
    }

    fn each_cell(&self, low: DVec2, high: DVec2, mut call: impl FnMut(usize)) {
        let at = |p: DVec2| {
            let place = p / self.cell;
            [(place.x, self.across[0]), (place.y, self.across[1])]
                .map(|(x, count)| (x.max(0.0) as usize).min(count - 1))
        };
        let ([left, top], [right, bottom]) = (at(low), at(high));
        for row in top..=bottom {
            (left..=right).for_each(|column| call(row * self.across[0] + column));
        }
    }

    /// The pieces of border that may lie in a box; none if there are too many.
    pub fn near(&self, low: DVec2, high: DVec2) -> Option<Vec<Segment>> {
        let turns = |axis: usize| match self.periods[axis] {
            Some(period) => ((low[axis] / period).floor() as i64, (high[axis] / period).floor() as i64),
            None => (0, 0),
        };
        let ((left, right), (top, bottom)) = (turns(0), turns(1));
        let mut found = Vec::new();
        let mut numbers = Vec::new();
        for y in top..=bottom {
            for x in left..=right {
                let moved = DVec2::new(
                    x as f64 * self.periods[0].unwrap_or_default(),
                    y as f64 * self.periods[1].unwrap_or_default(),
                );
                numbers.clear();
                self.each_cell(low - moved, high - moved, |cell| {
                    numbers.extend_from_slice(self.cells.of(cell))
                });
                numbers.sort_unstable();
                numbers.dedup();
                found.extend(
                    numbers
                        .iter()
                        .map(|n| self.segments[*n as usize].map(|p| p + moved))
                        .filter(|[a, b]| a.min(*b).cmple(high).all() && a.max(*b).cmpge(low).all()),
                );
                if found.len() > MOST_SEGMENTS {
                    return None;
                }
            }
        }
        Some(found)
    }
}

/// A side between neighbouring texels: the column and row of the first, and whether the second lies below it.
type Side = (u32, u32, bool);

/// The borders in the cells between so many texels and their neighbours, end to end.
fn trace(mask: &Mask, [columns, rows]: [usize; 2]) -> Option<Vec<Vec<DVec2>>> {
    let mut next: FxHashMap<Side, Side> = FxHashMap::default();
    let mut starts: Vec<Side> = Vec::new();
    let mut above: Vec<f64> = (0..=columns as i64).map(|i| mask.texel(i, 0)).collect();
    for j in 0..rows as u32 {
        let below: Vec<f64> = (0..=columns as i64).map(|i| mask.texel(i, i64::from(j) + 1)).collect();
        for i in 0..columns as u32 {
            let k = i as usize;
            let corners = [above[k], above[k + 1], below[k + 1], below[k]];
            let is_in = corners.map(|value| value > 0.0);
            if is_in == [is_in[0]; 4] {
                continue;
            }
            let sides = [(i, j, false), (i + 1, j, true), (i, j + 1, false), (i, j, true)];
            // Round the cell: where it is left, and where it is entered again.
            let leaves = (0..4).filter(|s| is_in[*s] && !is_in[(*s + 1) % 4]);
            let [a, b, c, d] = corners;
            // The value where bilinear opacity has its saddle.
            let joined = (a * c - b * d) / (a + c - b - d) >= 0.0;
            for leave in leaves {
                let enters = |s: &usize| !is_in[*s % 4] && is_in[(*s + 1) % 4];
                // Where the saddle is opaque the next entry ahead belongs to the other corner.
                let enter = match joined {
                    true => (leave + 1..leave + 4).find(enters),
                    false => (leave + 1..leave + 4).rev().find(enters),
                };
                if let Some(enter) = enter {
                    next.insert(sides[leave], sides[enter % 4]);
                    starts.push(sides[leave]);
                }
            }
        }
        above = below;
        if starts.len() > MOST_CROSSINGS {
            return None;
        }
    }
    let point = |(i, j, down): Side| {
        let (a, b) = (
            mask.texel(i.into(), j.into()),
            mask.texel((i + u32::from(!down)).into(), (j + u32::from(down)).into()),
        );
        let part = a / (a - b);
        DVec2::new(f64::from(i), f64::from(j)) + if down { DVec2::Y } else { DVec2::X } * part
    };
    // Open lines begin where nothing leads to.
    let led_to: rustc_hash::FxHashSet<Side> = next.values().copied().collect();
    let (open, closed): (Vec<Side>, Vec<Side>) = starts.into_iter().partition(|side| !led_to.contains(side));
    let mut lines = Vec::new();
    for start in open.into_iter().chain(closed) {
        let mut line = Vec::new();
        let mut at = start;
        while let Some(to) = next.remove(&at) {
            line.push(point(at));
            curve(mask, point(at), point(to), &mut line);
            at = to;
        }
        if !line.is_empty() {
            line.push(point(at));
            lines.push(line);
        }
    }
    Some(lines)
}

/// Adds points of the border on its way through a cell, where it is a piece of a hyperbola: opacity is bilinear.
fn curve(mask: &Mask, from: DVec2, to: DVec2, line: &mut Vec<DVec2>) {
    let low = ((from + to) / 2.0).floor();
    let (i, j) = (low.x as i64, low.y as i64);
    let [a, b, c, d] = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(x, y)| mask.texel(i + x, j + y));
    let twist = a - b - c + d;
    // The border is where the product of the distances from the axes is `product`.
    let axes = low - DVec2::new(c - a, b - a) / twist;
    let product = ((b - a) * (c - a) / twist - a) / twist;
    if axes.is_finite() && product.is_finite() && (from.x - axes.x) * (to.x - axes.x) > 0.0 {
        bend(axes, product, from, to, line);
    }
}

/// Adds points of a hyperbola between two of its points until what is left between them is all but straight.
fn bend(axes: DVec2, product: f64, from: DVec2, to: DVec2, line: &mut Vec<DVec2>) {
    let x = ((from.x - axes.x) * (to.x - axes.x)).sqrt().copysign(from.x - axes.x);
    let middle = axes + DVec2::new(x, product / x);
    let way = to - from;
    let off = way.perp_dot(middle - from).abs();
    if off > STRAIGHT * way.length() && way.length_squared() > STRAIGHT * STRAIGHT {
        bend(axes, product, from, middle, line);
        line.push(middle);
        bend(axes, product, middle, to, line);
    }
}

/// Lets a line that ends at a border which is repeated for ever go on outwards.
fn extend(line: &mut Vec<DVec2>, reach: [usize; 2], periods: [Option<usize>; 2]) {
    let (Some(first), Some(last)) = (line.first().copied(), line.last().copied()) else { return };
    if first == last {
        return;
    }
    let beyond = |p: DVec2| {
        (0..2).filter(|axis| periods[*axis].is_none()).find_map(|axis| {
            let mut far = p;
            far[axis] = if p[axis] == 0.0 {
                -FAR
            } else if p[axis] == reach[axis] as f64 {
                FAR
            } else {
                return None;
            };
            Some(far)
        })
    };
    if let Some(far) = beyond(first) {
        line.insert(0, far);
    }
    line.extend(beyond(last));
}

/// A line without the points that lie within `tolerance` of the line without them; closed ones smaller than that are gone.
fn thinned(line: Vec<DVec2>, tolerance: f64) -> Vec<DVec2> {
    let count = line.len();
    let mut kept = vec![false; count];
    kept[0] = true;
    kept[count - 1] = true;
    let mut spans = Vec::new();
    if line[0] == line[count - 1] {
        let from = |p: &DVec2| p.distance_squared(line[0]);
        let farthest = (1..count).max_by(|a, b| from(&line[*a]).total_cmp(&from(&line[*b])).then(b.cmp(a)));
        let Some(farthest) = farthest.filter(|k| from(&line[*k]) > tolerance * tolerance) else {
            return Vec::new();
        };
        kept[farthest] = true;
        spans.extend([(0, farthest), (farthest, count - 1)]);
    } else {
        spans.push((0, count - 1));
    }
    while let Some((first, last)) = spans.pop() {
        let (a, way) = (line[first], line[last] - line[first]);
        let off = |p: DVec2| {
            let along = ((p - a).dot(way) / way.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
            (p - a - way * along).length_squared()
        };
        let worst = (first + 1..last)
            .map(|k| (off(line[k]), k))
            .max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)));
        if let Some((_, k)) = worst.filter(|(off, _)| *off > tolerance * tolerance) {
            kept[k] = true;
            spans.extend([(first, k), (k, last)]);
        }
    }
    line.into_iter().zip(kept).filter_map(|(p, kept)| kept.then_some(p)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::material::Wrap;

    fn disc(size: usize, radius: f64) -> Vec<u8> {
        let middle = (size as f64 - 1.0) / 2.0;
        let at = |k: usize| DVec2::new((k % size) as f64 - middle, (k / size) as f64 - middle).length();
        (0..size * size).map(|k| (127.5 + 255.0 * (at(k) - radius)).clamp(0.0, 255.0) as u8).collect()
    }

    #[test]
    fn a_round_hole_is_round() {
        let mask = Mask::of_opacities(64, disc(64, 20.3), Wrap::Repeat);
        let outline = Outline::new(&mask, 0.02).unwrap();
        let middle = DVec2::splat(31.5);
        assert!(outline.segments.len() > 40 && outline.segments.len() < 240, "{}", outline.segments.len());
        for [a, b] in &outline.segments {
            let off = (a.distance(middle) - 20.3).abs().max(((*a + *b) / 2.0).distance(middle) - 20.3);
            assert!(off < 0.1, "{off}");
            // Opaque is outside.
            assert!((*b - *a).perp_dot(middle - *a) < 0.0);
        }
        // Three periods on, the same.
        let far = outline.near(DVec2::splat(192.0), DVec2::splat(256.0)).unwrap();
        assert_eq!(far.len(), outline.segments.len());
    }

    #[test]
    fn borders_go_on_over_the_seam_or_beyond() {
        // The left half is opaque.
        let half = |wrap| Mask::of_opacities(4, [255, 255, 0, 0].repeat(4), wrap);
        let repeated = Outline::new(&half(Wrap::Repeat), 0.1).unwrap();
        assert_eq!(repeated.segments.len(), 2);
        assert!(repeated.segments.iter().all(|[a, b]| (a.y - b.y).abs() == 4.0));
        let clamped = Outline::new(&half(Wrap::Clamp), 0.1).unwrap();
        let far = clamped.near(DVec2::new(0.0, 500.0), DVec2::new(3.0, 600.0)).unwrap();
        assert!(far.iter().all(|[a, b]| a.x == 1.5 && b.x == 1.5) && !far.is_empty());
        assert_eq!(Outline::new(&half(Wrap::Mirror), 0.1).unwrap().segments.len(), 2);
    }
}
