//! [`OrientedLine`]: a line seen from one of its ends, where an overhang may be cut off.

use kurbo::{Point, Vec2};

use crate::chains::Sample;
use crate::chains::sampled_line::{LineSide, SampledLine};
use crate::geometry::plane::planar_distance::{length, segment_distance_squared, unit};

/// Largest gap at an overhang that is cut off, and largest distance of a short overhang from the other line.
pub(crate) const MAX_TRIMMED_JUMP_TIDY_LENGTHS: f64 = 0.6;

/// Longest overhang.
pub(crate) const MAX_STUB_TIDY_LENGTHS: f64 = 8.0;

/// An overhang longer than the first length must lie on the other line, within the second length.
pub(crate) const MIN_LONG_STUB_TIDY_LENGTHS: f64 = 4.0;
const MAX_LONG_STUB_DISTANCE_TIDY_LENGTHS: f64 = 0.3;

/// Start of a line after a cut: it starts at `point` and continues with point `next`, counted from that end.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StitchEnd {
    pub(crate) point: Point,
    pub(crate) sample: Sample,
    pub(crate) next: usize,
    pub(crate) trimmed: f64,
}

/// A line seen from one of its ends.
pub(crate) struct OrientedLine<'a> {
    line: &'a SampledLine,
    is_reversed: bool,
}

impl<'a> OrientedLine<'a> {
    pub(crate) fn new(line: &'a SampledLine, end: usize) -> Self {
        Self { line, is_reversed: end % 2 == 1 }
    }

    fn index(&self, k: usize) -> usize {
        if self.is_reversed { self.line.len() - 1 - k } else { k }
    }

    pub(crate) fn point(&self, k: usize) -> Point {
        self.line.points[self.index(k)]
    }

    /// Arc length, but at most `max_length`.
    pub(crate) fn arc(&self, max_length: f64) -> f64 {
        let mut arc = 0.0;
        for k in 1..self.line.len() {
            arc += length(self.point(k) - self.point(k - 1));
            if arc >= max_length {
                return max_length;
            }
        }
        arc
    }

    /// Cut at parameter `t` of the side after point `k`.
    pub(crate) fn cut(&self, k: usize, t: f64, trimmed: f64) -> StitchEnd {
        let sample = |k: usize| self.line.samples[self.index(k)];
        let point = if t > 0.0 { self.point(k).lerp(self.point(k + 1), t) } else { self.point(k) };
        let sample = if t > 0.0 { sample(k).lerp(sample(k + 1), t) } else { sample(k) };
        StitchEnd { point, sample, next: k + 1, trimmed }
    }

    /// Cut nearest to `p` within the first `reach` of the line, the far end excluded.
    pub(crate) fn nearest(&self, p: Point, reach: f64) -> Option<StitchEnd> {
        let mut arc = 0.0;
        let mut closest: Option<(f64, StitchEnd)> = None;
        for k in 0..self.line.len() - 1 {
            let (a, b) = (self.point(k), self.point(k + 1));
            let side = length(b - a);
            if arc > reach {
                break;
            }
            let t = if side > 0.0 { ((p - a).dot(b - a) / (side * side)).clamp(0.0, 1.0) } else { 0.0 };
            let distance2 = (a.lerp(b, t) - p).hypot2();
            let trimmed = arc + t * side;
            let last = k + 2 == self.line.len() && t >= 1.0;
            if trimmed > 0.0 && trimmed <= reach && !last && closest.as_ref().is_none_or(|l| distance2 < l.0)
            {
                closest = Some((distance2, self.cut(k, t, trimmed)));
            }
            arc += side;
        }
        closest.map(|l| l.1)
    }

    /// Unit direction of the line at a cut.
    pub(crate) fn direction(&self, cut: &StitchEnd, window: f64) -> Vec2 {
        let end_index = (cut.next..self.line.len()).find(|k| length(self.point(*k) - cut.point) >= window);
        unit(self.point(end_index.unwrap_or(self.line.len() - 1)) - cut.point)
    }

    /// Whether any point that is cut off lies too far from the start of the other line.
    pub(crate) fn stub_leaves(&self, cut: &StitchEnd, other: &OrientedLine, tidy: f64) -> bool {
        if cut.trimmed <= 0.0 {
            return false;
        }
        let max_distance = tidy
            * if cut.trimmed > MIN_LONG_STUB_TIDY_LENGTHS * tidy {
                MAX_LONG_STUB_DISTANCE_TIDY_LENGTHS
            } else {
                MAX_TRIMMED_JUMP_TIDY_LENGTHS
            };
        let max_distance2 = max_distance * max_distance;
        (0..cut.next).any(|k| {
            let p = self.point(k);
            let mut arc = 0.0;
            (1..other.line.len())
                .take_while(|j| {
                    let before = arc;
                    arc += length(other.point(*j) - other.point(j - 1));
                    before < (MAX_STUB_TIDY_LENGTHS + 1.0) * tidy
                })
                .all(|j| segment_distance_squared(p, other.point(j - 1), other.point(j)) > max_distance2)
        })
    }
}

/// Appends a line in either direction, without the parts cut off at its start and end.
pub(crate) fn append_trimmed(
    target: &mut SampledLine,
    line: &SampledLine,
    backwards: bool,
    begin: Option<StitchEnd>,
    end: Option<StitchEnd>,
) {
    let n = line.len();
    let index = |k: usize| if backwards { n - 1 - k } else { k };
    let first = begin.map_or(0, |cut| cut.next);
    let last = n - end.map_or(0, |cut| cut.next);
    // The side between two consecutive points has the smaller of their indices.
    let side_before = |k: usize| index(k.saturating_sub(1)).min(index(k.min(n - 1)));
    if let Some(cut) = begin {
        let side = side_before(first);
        target.push(cut.point, cut.sample, LineSide { soft: true, ..line.sides[side] });
    }
    for k in first..last.max(first) {
        // In reverse, the side after a point is the one before it.
        let side = if backwards { index(k).saturating_sub(1) } else { index(k) };
        target.push(line.points[index(k)], line.samples[index(k)], line.sides[side]);
    }
    if let Some(cut) = end {
        let side = side_before(last);
        target.push(cut.point, cut.sample, LineSide { soft: true, ..line.sides[side] });
    }
}
