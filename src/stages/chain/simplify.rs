//! Leaves out points that a line does without.
//!
//! Source: Douglas and Peucker, Algorithms for the reduction of the number of points required to
//! represent a digitized line, Cartographica 1973; measured against the segment, not its line, so
//! that a line that doubles back keeps its tip.

use super::line::Line;
use crate::math::plane::distance2;

/// Points this near to the straight line between their neighbours, in user units, are rounding.
const COLLINEAR: f64 = 1e-9;

/// How much the strength of a line may be off where points are left out.
const STRENGTH: f64 = 0.08;

/// Leaves out the points that lie in line between their neighbours, and no others: a line that
/// turns back stays as long as it is.
pub(super) fn straighten(line: &Line) -> Line {
    let between = |a: usize, b: usize, c: usize| {
        let (to, on) = (line.points[b] - line.points[a], line.points[c] - line.points[b]);
        let whole = line.points[c] - line.points[a];
        to.dot(on) > 0.0 && to.cross(whole).powi(2) <= COLLINEAR * COLLINEAR * whole.hypot2()
    };
    let mut kept: Vec<usize> = Vec::with_capacity(line.len());
    for c in 0..line.len() {
        if let &[.., a, b] = &kept[..]
            && line.soft[a] == line.soft[b]
            && between(a, b, c)
            && strength_off(line, b, a, c) <= STRENGTH
        {
            kept.pop();
        }
        kept.push(c);
    }
    if line.closed && kept.len() > 3 {
        if between(kept[kept.len() - 2], kept[kept.len() - 1], kept[0]) {
            kept.pop();
        }
        if kept.len() > 3 && between(kept[kept.len() - 1], kept[0], kept[1]) {
            kept.remove(0);
        }
    }
    line.pick(&kept)
}

/// Keeps the ends and every point without which the line would move by more than `tolerance`. A
/// closed line keeps its first point and the one farthest from it.
pub(super) fn simplify(line: &Line, tolerance: f64) -> Line {
    let n = line.len();
    if n < 3 {
        return line.clone();
    }
    let tolerance2 = tolerance * tolerance;
    if !line.closed {
        let kept = keep(line, tolerance2);
        return line.pick(&kept);
    }
    let away = |i: &usize| (line.points[*i] - line.points[0]).hypot2();
    let far = (1..n).max_by(|a, b| away(a).total_cmp(&away(b)).then(b.cmp(a))).unwrap_or(1);
    let whole = line.opened_at(0);
    let mut kept = keep(&whole.slice(0, far), tolerance2);
    kept.pop();
    kept.extend(keep(&whole.slice(far, n), tolerance2).into_iter().map(|i| i + far));
    kept.pop();
    line.pick(&kept)
}

/// Indices of the points that stay in an open line.
fn keep(line: &Line, tolerance2: f64) -> Vec<usize> {
    let n = line.len();
    let mut stays = vec![false; n];
    let mut open = vec![(0, n - 1)];
    stays[0] = true;
    stays[n - 1] = true;
    while let Some((a, b)) = open.pop() {
        let mut worst = (tolerance2, None);
        for i in a + 1..b {
            let off = strength_off(line, i, a, b) / STRENGTH;
            let d = distance2(line.points[i], line.points[a], line.points[b]).max(off * off * tolerance2);
            if d > worst.0 {
                worst = (d, Some(i));
            }
        }
        if let Some(i) = worst.1 {
            stays[i] = true;
            open.push((a, i));
            open.push((i, b));
        }
    }
    (0..n).filter(|i| stays[*i]).collect()
}

/// How much the strength at point `i` differs from what lies on the way from point `a` to `b`.
fn strength_off(line: &Line, i: usize, a: usize, b: usize) -> f64 {
    let [at, from, to] = [i, a, b].map(|k| line.samples[k].strength);
    if from == to {
        return (at - from).abs();
    }
    let way = line.points[b] - line.points[a];
    let t =
        ((line.points[i] - line.points[a]).dot(way) / way.hypot2().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    (at - (from + (to - from) * t)).abs()
}
