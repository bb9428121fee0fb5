//! Line simplification (Douglas-Peucker).
//!
//! Source: Douglas and Peucker, Algorithms for the reduction of the number of points required to represent a
//! digitized line, Cartographica 1973. Deviations: distances are measured to the segment instead of the
//! infinite line, so that a line that doubles back keeps its tip. The strength of the line is kept within a
//! tolerance too.

use kurbo::{Point, Vec2};

use crate::chains::sampled_line::SampledLine;
use crate::chains::tolerances;

/// Minimum number of points for which both halves run in parallel, and the largest ratio of the whole to its
/// smaller half.
const MIN_PARALLEL_POINTS: usize = 512;
const MAX_SPLIT_IMBALANCE: usize = 8;

/// Largest error of a line's strength where points are left out.
const MAX_STRENGTH_ERROR: f64 = 0.08;

/// Leaves out the points that are collinear with their neighbours. A line that doubles back keeps its length.
pub(crate) fn straighten(line: SampledLine) -> SampledLine {
    if line.len() < 3 {
        return line;
    }
    let between = |a: usize, b: usize, c: usize| {
        let (to, on) = (line.points[b] - line.points[a], line.points[c] - line.points[b]);
        let chord = line.points[c] - line.points[a];
        to.dot(on) > 0.0
            && to.cross(chord).powi(2)
                <= tolerances::MAX_COLLINEAR_DISTANCE_UNITS
                    * tolerances::MAX_COLLINEAR_DISTANCE_UNITS
                    * chord.hypot2()
    };
    let mut kept_indices: Vec<usize> = Vec::with_capacity(line.len());
    for c in 0..line.len() {
        if let &[.., a, b] = &kept_indices[..]
            && line.soft[a] == line.soft[b]
            && between(a, b, c)
            && SimplifiedChord::new(&line, a, c).off(b).1 <= MAX_STRENGTH_ERROR
        {
            kept_indices.pop();
        }
        kept_indices.push(c);
    }
    if line.closed && kept_indices.len() > 3 {
        if between(
            kept_indices[kept_indices.len() - 2],
            kept_indices[kept_indices.len() - 1],
            kept_indices[0],
        ) {
            kept_indices.pop();
        }
        if kept_indices.len() > 3
            && between(kept_indices[kept_indices.len() - 1], kept_indices[0], kept_indices[1])
        {
            kept_indices.remove(0);
        }
    }
    if kept_indices.len() == line.len() {
        return line;
    }
    line.pick(&kept_indices)
}

/// Simplifies a line within `tolerance`, and keeps the ends of an open line. A closed line keeps its first
/// point and the point farthest from it.
pub(crate) fn simplify(line: &SampledLine, tolerance: f64) -> SampledLine {
    let n = line.len();
    if n < 3 {
        return line.clone();
    }
    let tolerance2 = tolerance * tolerance;
    if !line.closed {
        let kept = keep(line, tolerance2);
        return line.pick(&kept);
    }
    let distance2 = |i: &usize| (line.points[*i] - line.points[0]).hypot2();
    let farthest = (1..n).max_by(|a, b| distance2(a).total_cmp(&distance2(b)).then(b.cmp(a))).unwrap_or(1);
    let opened = line.opened_at(0);
    let mut kept_indices = keep(&opened.slice(0, farthest), tolerance2);
    kept_indices.pop();
    kept_indices.extend(keep(&opened.slice(farthest, n), tolerance2).into_iter().map(|i| i + farthest));
    kept_indices.pop();
    line.pick(&kept_indices)
}

/// Indices of the kept points of an open line.
fn keep(line: &SampledLine, tolerance2: f64) -> Vec<usize> {
    let n = line.len();
    let mut is_kept = vec![true; n];
    if let [_, between @ .., _] = &mut is_kept[..] {
        between.fill(false);
        split(line, tolerance2, [0, n - 1], between);
    }
    (0..n).filter(|i| is_kept[*i]).collect()
}

/// Marks the kept points between two kept points.
fn split(line: &SampledLine, tolerance2: f64, [mut a, mut b]: [usize; 2], mut between: &mut [bool]) {
    while let Some(i) = farthest_point(line, a, b, tolerance2) {
        let (low, high) = between.split_at_mut(i - a - 1);
        let Some((stays, high)) = high.split_first_mut() else { return };
        *stays = true;
        let (below, above) = (i - a, b - i);
        // Only near-even splits fork, so that the recursion depth stays logarithmic.
        if below.min(above) * MAX_SPLIT_IMBALANCE >= b - a && b - a >= MIN_PARALLEL_POINTS {
            crate::parallel::join(
                || split(line, tolerance2, [a, i], low),
                || split(line, tolerance2, [i, b], high),
            );
            return;
        }
        if below < above {
            split(line, tolerance2, [a, i], low);
            (a, between) = (i, high);
        } else {
            split(line, tolerance2, [i, b], high);
            (b, between) = (i, low);
        }
    }
}

/// First of the points between two others with the largest error, if that exceeds the tolerance.
fn farthest_point(line: &SampledLine, a: usize, b: usize, tolerance2: f64) -> Option<usize> {
    let chord = SimplifiedChord::new(line, a, b);
    let mut worst = (tolerance2, None);
    for i in a + 1..b {
        let (distance2, strength) = chord.off(i);
        let strength = strength / MAX_STRENGTH_ERROR;
        let d = distance2.max(strength * strength * tolerance2);
        if d > worst.0 {
            worst = (d, Some(i));
        }
    }
    worst.1
}

/// Segment between two points of a line.
struct SimplifiedChord<'a> {
    line: &'a SampledLine,
    from: Point,
    direction: Vec2,
    length2: f64,
    strength: f64,
    /// Change of strength along it.
    change: f64,
}

impl<'a> SimplifiedChord<'a> {
    fn new(line: &'a SampledLine, a: usize, b: usize) -> Self {
        let (from, strength) = (line.points[a], line.samples[a].strength);
        let (way, change) = (line.points[b] - from, line.samples[b].strength - strength);
        Self { line, from, direction: way, length2: way.hypot2(), strength, change }
    }

    /// Squared distance of a point from the segment, and the error of the interpolated strength.
    #[inline]
    fn off(&self, i: usize) -> (f64, f64) {
        let p = self.line.points[i];
        let t = if self.length2 > 0.0 {
            ((p - self.from).dot(self.direction) / self.length2).clamp(0.0, 1.0)
        } else {
            0.0
        };
        let strength = self.line.samples[i].strength - (self.strength + self.change * t);
        ((p - (self.from + self.direction * t)).hypot2(), strength.abs())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chains::Sample;
    use crate::geometry::dice::Dice;
    use crate::geometry::plane::planar_distance::segment_distance_squared;

    /// Reference: the same recursion without parallel tasks.
    fn sequential_keep(
        line: &SampledLine,
        [a, b]: [usize; 2],
        tolerance2: f64,
        kept_indices: &mut Vec<usize>,
    ) {
        let off = |i: usize| {
            let [at, from, to] = [i, a, b].map(|k| line.samples[k].strength);
            let (p, chord) = (line.points[i] - line.points[a], line.points[b] - line.points[a]);
            let t = if chord.hypot2() > 0.0 { (p.dot(chord) / chord.hypot2()).clamp(0.0, 1.0) } else { 0.0 };
            let strength = (at - (from + (to - from) * t)).abs() / MAX_STRENGTH_ERROR;
            segment_distance_squared(line.points[i], line.points[a], line.points[b])
                .max(strength * strength * tolerance2)
        };
        let candidates = (a + 1..b).filter(|i| off(*i) > tolerance2);
        let Some(worst) = candidates.max_by(|i, k| off(*i).total_cmp(&off(*k)).then(k.cmp(i))) else {
            return;
        };
        sequential_keep(line, [a, worst], tolerance2, kept_indices);
        kept_indices.push(worst);
        sequential_keep(line, [worst, b], tolerance2, kept_indices);
    }

    #[test]
    fn keep_matches_a_sequential_douglas_peucker() {
        let mut dice = Dice::new(7);
        for n in [2, 3, 40, 700, 5000] {
            let mut line = SampledLine::default();
            let (mut p, mut strength) = (Point::ZERO, 1.0);
            for _ in 0..n {
                p += Vec2::new(dice.between(0.2, 1.0), dice.between(-0.6, 0.6));
                strength = f64::clamp(strength + dice.between(-0.02, 0.02), 0.0, 1.0);
                line.push(p, Sample::new(1.0, strength), true, false);
            }
            for tolerance in [0.1, 1.0, 10.0] {
                let mut stays = vec![0];
                sequential_keep(&line, [0, n - 1], tolerance * tolerance, &mut stays);
                stays.push(n - 1);
                assert_eq!(keep(&line, tolerance * tolerance), stays, "{n} points, {tolerance}");
            }
        }
    }
}
