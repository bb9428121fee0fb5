//! Line simplification: [`straighten`] drops collinear points, [`simplify`] follows Douglas and Peucker.
//!
//! Distances are measured to the segment instead of the infinite line, so that a line that doubles back keeps
//! its tip. The strength of the line is kept within a tolerance too.

use kurbo::{Point, Vec2};

use crate::chains::sampled_line::SampledLine;
use crate::chains::tolerances;
use crate::geometry::plane::douglas_peucker::{douglas_peucker, farthest_point};

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
            && line.sides[a].soft == line.sides[b].soft
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
    if !line.closed {
        return line.pick(&keep(line, &[0, n - 1], tolerance));
    }
    let distance2 = |k: usize| (line.points[k] - line.points[0]).hypot2();
    let far = farthest_point(1..n, distance2, f64::NEG_INFINITY).unwrap_or(1);
    // The last point of the opened line is the first one again.
    let mut kept = keep(&line.opened_at(0), &[0, far, n], tolerance);
    kept.pop();
    line.pick(&kept)
}

/// Indices of the kept points of an open line. The points at `stops` are kept.
fn keep(line: &SampledLine, stops: &[usize], tolerance: f64) -> Vec<usize> {
    let tolerance2 = tolerance * tolerance;
    let kept = douglas_peucker(line.len(), stops, |a, b| {
        let chord = SimplifiedChord::new(line, a, b);
        let error = |k: usize| {
            let (distance2, strength) = chord.off(k);
            let strength = strength / MAX_STRENGTH_ERROR;
            distance2.max(strength * strength * tolerance2)
        };
        farthest_point(a + 1..b, error, tolerance2)
    });
    (0..line.len()).filter(|k| kept[*k]).collect()
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
    use crate::chains::sampled_line::LineSide;
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
                line.push(p, Sample::new(1.0, strength), LineSide::soft(true));
            }
            for tolerance in [0.1, 1.0, 10.0] {
                let mut stays = vec![0];
                sequential_keep(&line, [0, n - 1], tolerance * tolerance, &mut stays);
                stays.push(n - 1);
                assert_eq!(keep(&line, &[0, n - 1], tolerance), stays, "{n} points, {tolerance}");
            }
        }
    }
}
