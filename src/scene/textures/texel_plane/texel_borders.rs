//! [`BorderIndex`]: simplified borders in the texel plane, with a grid index for queries by box.

use glam::DVec2;

use super::TracedBorders;
use crate::geometry::lists::csr_lists::{CsrLists, csr_lists};
use crate::geometry::plane::douglas_peucker::{douglas_peucker, farthest_point};

/// Segment of a border, in tracing direction.
pub(crate) type BorderSegment = [DVec2; 2];

/// Length of the extension of lines outside a picture with repeated border, texels.
const CLAMPED_BORDER_TEXELS: f64 = 2e9;

/// Maximum cells of the index along each side.
const MAX_CELLS_PER_SIDE: usize = 64;

/// Maximum points of a line, or part of a line, that is simplified as a whole.
const MAX_SPAN_POINTS: usize = 512;

/// Maximum segments that a query returns; larger queries fail.
const MAX_QUERY_SEGMENTS: usize = 100_000;

/// Borders of one period, indexed by position.
#[derive(Debug)]
pub(crate) struct BorderIndex {
    pub segments: Vec<BorderSegment>,
    /// The two colours on the sides of each segment.
    parted: Vec<[u8; 2]>,
    /// Period along x and along y, texels.
    periods: [Option<f64>; 2],
    across: [usize; 2],
    cell: DVec2,
    cells: CsrLists<u32>,
}

impl BorderIndex {
    /// Simplifies traced borders with a tolerance in texels, and indexes them.
    pub(crate) fn new(traced: &TracedBorders, tolerance: f64) -> Self {
        let TracedBorders { lines, parted: of_lines, reach, periods } = traced;
        let (reach, periods) = (*reach, *periods);
        let (mut segments, mut parted) = (Vec::new(), Vec::new());
        for (number, line) in lines.iter().enumerate() {
            let mut line = simplified(line, tolerance);
            extend_clamped_ends(&mut line, reach, periods);
            segments.extend(line.windows(2).map(|pair| [pair[0], pair[1]]).filter(|[a, b]| a != b));
            parted.resize(segments.len(), of_lines.get(number).copied().unwrap_or_default());
        }
        let across = reach.map(|count| (count / 4).clamp(1, MAX_CELLS_PER_SIDE));
        let cell = DVec2::new(reach[0] as f64 / across[0] as f64, reach[1] as f64 / across[1] as f64);
        let periods = periods.map(|period| period.map(|count| count as f64));
        let mut outline = Self { segments, parted, periods, across, cell, cells: CsrLists::default() };
        outline.cells = csr_lists(across[0] * across[1], |put| {
            for (number, [a, b]) in outline.segments.iter().enumerate() {
                outline.each_cell(a.min(*b), a.max(*b), |cell| put(cell, number as u32));
            }
        });
        outline
    }

    /// Number of segments in one period.
    pub(crate) fn count(&self) -> usize {
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

    /// Segments that may touch a box; `None` if there are too many.
    pub(crate) fn near(&self, low: DVec2, high: DVec2) -> Option<Vec<BorderSegment>> {
        self.map_segments_in_box(low, high, |segment, _| segment)
    }

    /// Segments that may touch a box, mapped by `make` with their two colours; `None` if there are too many.
    pub(crate) fn map_segments_in_box<T>(
        &self,
        low: DVec2,
        high: DVec2,
        make: impl Fn(BorderSegment, [u8; 2]) -> T,
    ) -> Option<Vec<T>> {
        let turns = |axis: usize| match self.periods[axis] {
            Some(period) => ((low[axis] / period).floor() as i64, (high[axis] / period).floor() as i64),
            None => (0, 0),
        };
        let ((left, right), (top, bottom)) = (turns(0), turns(1));
        if (right - left + 1) * (bottom - top + 1) > MAX_QUERY_SEGMENTS as i64 {
            return None;
        }
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
                        .map(|n| (self.segments[*n as usize].map(|p| p + moved), self.parted[*n as usize]))
                        .filter(|([a, b], _)| a.min(*b).cmple(high).all() && a.max(*b).cmpge(low).all())
                        .map(|(segment, parted)| make(segment, parted)),
                );
                if found.len() > MAX_QUERY_SEGMENTS {
                    return None;
                }
            }
        }
        Some(found)
    }
}

/// Extends the ends of a line outwards where the border texel is repeated.
fn extend_clamped_ends(line: &mut Vec<DVec2>, reach: [usize; 2], periods: [Option<usize>; 2]) {
    let (Some(first), Some(last)) = (line.first().copied(), line.last().copied()) else { return };
    if first == last {
        return;
    }
    let beyond = |p: DVec2| {
        (0..2).filter(|axis| periods[*axis].is_none()).find_map(|axis| {
            let mut far = p;
            far[axis] = if p[axis] == 0.0 {
                -CLAMPED_BORDER_TEXELS
            } else if p[axis] == reach[axis] as f64 {
                CLAMPED_BORDER_TEXELS
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

/// Simplifies a line with a tolerance. Closed lines narrower than the tolerance become empty.
fn simplified(line: &[DVec2], tolerance: f64) -> Vec<DVec2> {
    let count = line.len();
    let is_closed = line[0] == line[count - 1];
    // A long winding line would take quadratic time, so it is simplified span by span.
    let mut ends: Vec<usize> = (0..count - 1).step_by(MAX_SPAN_POINTS).chain([count - 1]).collect();
    if is_closed && count <= MAX_SPAN_POINTS {
        let from = |k: usize| line[k].distance_squared(line[0]);
        ends.extend(farthest_point(1..count, from, f64::NEG_INFINITY));
        ends.sort_unstable();
    }
    let kept = douglas_peucker(count, &ends, |first, last| {
        let (a, way) = (line[first], line[last] - line[first]);
        let off = |k: usize| {
            let to = line[k] - a;
            let along = (to.dot(way) / way.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
            (to - way * along).length_squared()
        };
        farthest_point(first + 1..last, off, tolerance * tolerance)
    });
    let thinned: Vec<DVec2> = line.iter().zip(kept).filter_map(|(p, kept)| kept.then_some(*p)).collect();
    if is_closed && thinned.len() < 4 { Vec::new() } else { thinned }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn simplified_borders_drop_thin_specks_and_keep_long_shapes() {
        let speck: Vec<DVec2> =
            [[0.0, 0.0], [3.0, 0.1], [6.0, 0.0], [3.0, -0.1], [0.0, 0.0]].map(DVec2::from).to_vec();
        assert!(simplified(&speck, 0.2).is_empty() && simplified(&speck, 0.05).len() == 5);
        let turn = |k: usize| std::f64::consts::TAU * (k % 3000) as f64 / 3000.0;
        let ring: Vec<DVec2> = (0..=3000)
            .map(|k| {
                DVec2::new(
                    crate::geometry::numbers::portable_math::cos(turn(k)),
                    crate::geometry::numbers::portable_math::sin(turn(k)),
                ) * 100.0
            })
            .collect();
        let thin = simplified(&ring, 0.1);
        assert!((60..120).contains(&thin.len()), "{}", thin.len());
        assert!(thin.windows(2).all(|pair| (pair[0] + pair[1]).length() / 2.0 > 99.8));
    }
}
