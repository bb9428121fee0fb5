//! Makes the drawn curve and the points of a chain from the raw line of a route.
//!
//! 1. Stretches whose corners lie on a circle become arcs.
//! 2. Stretches on smooth surfaces are smoothed between corners, then simplified and fitted.
//! 3. All other stretches keep their exact corners, except that tessellated curves are fitted.

use kurbo::{BezPath, Point};

use super::circular_arcs::{CircleTolerance, CircularArc, arcs, circle_path, extend_to_ends};
use super::corner_points::corners;
use super::curve_path::{add_exact, add_smooth, closed_exact, closed_smooth, polyline};
use super::foldbacks::remove_foldbacks;
use super::line_simplification::{simplify, straighten};
use super::resampling::resample;
use super::whittaker_smoothing::smooth;
use crate::chains::options::ChainOptions;
use crate::chains::sampled_line::SampledLine;
use crate::drawing::{Length, Unit};
use crate::geometry::plane::planar_distance::length;

/// Chain options in user units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FinishTolerances {
    /// One CSS px in user units.
    pub px: f64,
    pub smooth: f64,
    pub simplify: f64,
    pub tidy: f64,
    /// Whether the line has no triangle noise, so that every turn is a real one.
    pub clean: bool,
    /// Fit tolerance; 0 if no curves are fitted.
    pub fit: f64,
    /// Tolerances of arcs; `None` if no arcs are sought.
    pub circle: Option<CircleTolerance>,
    /// Whether points are needed in addition to a fitted curve.
    pub points: bool,
}

impl FinishTolerances {
    /// Tolerances of a line with triangle noise and without arcs.
    pub(crate) fn new(options: &ChainOptions, unit: Unit) -> Self {
        let distance = |length: Length| length.in_unit(unit).max(0.0);
        Self {
            px: Length::px(1.0).in_unit(unit),
            smooth: distance(options.smooth),
            simplify: distance(options.simplify),
            tidy: distance(options.tidy),
            clean: false,
            fit: if options.fit { distance(options.fit_tolerance) } else { 0.0 },
            circle: None,
            points: true,
        }
    }
}

/// Spacing of the resampled points that are smoothed, px.
const SAMPLE_SPACING_PX: f64 = 1.0;

/// Window for corner detection on smoothed lines, px.
const CORNER_WINDOW_PX: f64 = 6.0;

/// Window for the turn of a line without noise, px.
const SHARP_WINDOW_PX: f64 = 2.0;

/// Minimum number of points for which fitting and simplifying run in parallel.
const MIN_PARALLEL_POINTS: usize = 256;

/// Cosine of the smallest turn (35 degrees) over that length that makes a corner.
const MAX_SHARP_COSINE: f64 = 0.82;

/// Finishes a line: its points and its path. The line has no points if a curve is fitted and no points are
/// needed.
pub(crate) fn finish(raw: SampledLine, t: FinishTolerances) -> (SampledLine, BezPath) {
    let Some(circle_tolerance) = t.circle else { return finish_between(raw, t) };
    let mut raw = straighten(raw);
    let mut found_arcs = arcs(&raw.points, raw.closed, circle_tolerance);
    if !raw.closed {
        extend_to_ends(&mut raw.points, &mut found_arcs, circle_tolerance);
    }
    match found_arcs.as_slice() {
        [] => finish_between(raw, t),
        [circle] if circle.is_circle() => {
            let path = circle_path(circle, raw.points[0]);
            (raw, path)
        }
        [first, ..] if raw.closed => {
            let opened = raw.opened_at(first.first % raw.len());
            let moved = |arc: &CircularArc| CircularArc {
                first: arc.first - first.first,
                last: arc.last - first.first,
                ..*arc
            };
            let (mut line, mut path) =
                with_arcs(&opened, &found_arcs.iter().map(moved).collect::<Vec<_>>(), t);
            close(&mut line);
            path.close_path();
            (line, path)
        }
        _ => with_arcs(&raw, &found_arcs, t),
    }
}

/// Finishes an open line with arcs. The stretches between arcs are finished one by one.
fn with_arcs(raw: &SampledLine, arcs: &[CircularArc], t: FinishTolerances) -> (SampledLine, BezPath) {
    let mut line = SampledLine::default();
    let mut path = BezPath::new();
    if let Some(first) = raw.points.first() {
        path.move_to(*first);
    }
    let last = raw.len().saturating_sub(1);
    let mut at = 0;
    let between = |from: usize, to: usize, line: &mut SampledLine, path: &mut BezPath| {
        if to > from {
            let (part, drawn) = finish_between(raw.slice(from, to), t);
            append(line, &part);
            path.extend(drawn.elements().iter().skip(1).copied());
        }
    };
    for arc in arcs {
        between(at, arc.first, &mut line, &mut path);
        arc.add(raw.points[arc.first], raw.points[arc.last], &mut path);
        if t.points {
            append(&mut line, &raw.slice(arc.first, arc.last));
        }
        at = arc.last;
    }
    between(at, last, &mut line, &mut path);
    (line, path)
}

/// Finishes a line without arcs.
fn finish_between(raw: SampledLine, t: FinishTolerances) -> (SampledLine, BezPath) {
    if t.smooth <= 0.0 || !raw.is_soft() {
        return exact(raw, t);
    }
    if raw.closed {
        let parts = |i: usize| !raw.sides[i].soft || is_sharp(&raw, i, t);
        return match (0..raw.len()).find(|i| parts(*i)) {
            None => closed(&raw, t),
            // Start at a hard stretch or at a corner, so that no smooth stretch is cut.
            Some(hard) => {
                let (mut line, mut path) = open(&raw.opened_at(hard), t);
                close(&mut line);
                path.close_path();
                (line, path)
            }
        };
    }
    open(&raw, t)
}

/// Closes a line that ends where it began, without the repeated end.
fn close(line: &mut SampledLine) {
    line.closed = true;
    line.pop();
}

/// Finishes a line that is not smoothed anywhere.
fn exact(raw: SampledLine, t: FinishTolerances) -> (SampledLine, BezPath) {
    let straightened = straighten(raw);
    // A line of two points cannot be simplified.
    let simple = |line: SampledLine| {
        if t.simplify > 0.0 && line.len() > 2 { simplify(&line, t.simplify) } else { line }
    };
    if t.fit <= 0.0 {
        let line = simple(straightened);
        let path = polyline(&line);
        return (line, path);
    }
    let path = if straightened.closed {
        closed_exact(&straightened, t.fit)
    } else {
        let mut path = BezPath::new();
        if let Some(first) = straightened.points.first() {
            path.move_to(*first);
            add_exact(&straightened.points, t.fit, &mut path);
        }
        path
    };
    let line = if t.points { simple(straightened) } else { SampledLine::default() };
    (line, path)
}

/// Finishes a closed line that is smooth everywhere.
fn closed(raw: &SampledLine, t: FinishTolerances) -> (SampledLine, BezPath) {
    let line = remove_foldbacks(raw, t.smooth, t.tidy.max(4.0 * t.smooth));
    let (dense, spacing) = resample(&line, SAMPLE_SPACING_PX * t.px);
    let found = find_corners(&dense, spacing, t);
    if let Some(first) = found.first() {
        let turned = dense.opened_at(*first);
        let n = dense.len();
        let cuts: Vec<usize> = found.iter().map(|c| (c + n - first) % n).chain([n]).collect();
        let (mut line, mut path) = between(&turned, &cuts, t);
        close(&mut line);
        path.close_path();
        return (line, path);
    }
    let mut dense = dense;
    dense.points = smooth(&dense.points, true, t.smooth);
    let fits = t.fit > 0.0 && dense.len() > 8;
    let (line, path) = simple_and_fitted(&dense, fits, t, || closed_smooth(&dense.points, t.fit));
    let path = path.unwrap_or_else(|| polyline(&line));
    (line, path)
}

/// The simplified points, if needed, and the curve fitted through all points. Both use the dense line, so
/// they can run in parallel.
fn simple_and_fitted<P: Send>(
    dense: &SampledLine,
    fits: bool,
    t: FinishTolerances,
    fitted: impl FnOnce() -> P + Send,
) -> (SampledLine, Option<P>) {
    let simple = || if t.points || !fits { simplify(dense, t.simplify) } else { SampledLine::default() };
    let fitted = || fits.then(fitted);
    if dense.len() < MIN_PARALLEL_POINTS {
        (simple(), fitted())
    } else {
        crate::parallel::join(simple, fitted)
    }
}

/// Finishes an open line stretch by stretch, each either smooth or exact.
fn open(raw: &SampledLine, t: FinishTolerances) -> (SampledLine, BezPath) {
    let mut line = SampledLine::default();
    let mut path = BezPath::new();
    if let Some(first) = raw.points.first() {
        path.move_to(*first);
    }
    let sides = raw.len().saturating_sub(1);
    let mut i = 0;
    while i < sides {
        let soft = raw.sides[i].soft;
        let more = raw.sides[i + 1..sides].iter().enumerate();
        let run = 1 + more.take_while(|(k, side)| side.soft == soft && !is_sharp(raw, i + 1 + k, t)).count();
        let stretch = raw.slice(i, i + run);
        let (part, drawn) = if soft { soft_stretch(&stretch, t) } else { exact(stretch, t) };
        append(&mut line, &part);
        path.extend(drawn.elements().iter().skip(1).copied());
        i += run;
    }
    if sides == 0 {
        append(&mut line, raw);
    }
    (line, path)
}

/// Whether a line without noise has a corner at a vertex.
fn is_sharp(raw: &SampledLine, i: usize, t: FinishTolerances) -> bool {
    if !t.clean {
        return false;
    }
    let n = raw.len();
    // Chord to the first point at distance `SHARP_WINDOW_PX`, in one direction along the line.
    let chord = |step: usize| {
        let ends_at = |k: usize| !raw.closed && (if step == 1 { i + k == n - 1 } else { i == k });
        let at = |k: usize| raw.points[(i + k * step) % n];
        let index =
            (1..n).find(|k| length(at(*k) - raw.points[i]) >= SHARP_WINDOW_PX * t.px || ends_at(*k))?;
        let (before, behind) = (at(index - 1), at(index));
        let (short, long) = (length(before - raw.points[i]), length(behind - raw.points[i]));
        let share =
            ((SHARP_WINDOW_PX * t.px - short) / (long - short).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        Some(before.lerp(behind, share) - raw.points[i])
    };
    if !raw.closed && (i == 0 || i + 1 >= n) {
        return false;
    }
    let (Some(forward), Some(back)) = (chord(1), chord(n - 1)) else { return false };
    -forward.dot(back) < MAX_SHARP_COSINE * length(forward) * length(back)
}

/// Finishes a smooth open stretch: cut at its corners, and each part smoothed.
fn soft_stretch(raw: &SampledLine, t: FinishTolerances) -> (SampledLine, BezPath) {
    let line = remove_foldbacks(raw, t.smooth, t.tidy.max(4.0 * t.smooth));
    let (dense, spacing) = resample(&line, SAMPLE_SPACING_PX * t.px);
    let mut cuts = vec![0];
    cuts.extend(find_corners(&dense, spacing, t));
    cuts.push(dense.len().saturating_sub(1));
    between(&dense, &cuts, t)
}

/// Corners of a slightly smoothed copy, since the raw line turns at every vertex.
fn find_corners(dense: &SampledLine, spacing: f64, t: FinishTolerances) -> Vec<usize> {
    let n = dense.len();
    let mut points: Vec<Point> = dense.points.clone();
    for _ in 0..2 {
        let before = points.clone();
        for i in 0..n {
            if dense.closed || (i > 0 && i + 1 < n) {
                let (a, b) = (before[(i + n - 1) % n], before[(i + 1) % n]);
                points[i] = before[i].lerp(a.midpoint(b), 0.5);
            }
        }
    }
    corners(&points, dense.closed, spacing, CORNER_WINDOW_PX * t.px)
}

/// Smooths, simplifies and fits the parts of a dense open line between cuts.
fn between(dense: &SampledLine, cuts: &[usize], t: FinishTolerances) -> (SampledLine, BezPath) {
    let mut line = SampledLine::default();
    let mut path = BezPath::new();
    if let Some(first) = dense.points.first() {
        path.move_to(*first);
    }
    for pair in cuts.windows(2) {
        let &[a, b] = pair else { continue };
        if b <= a {
            continue;
        }
        let mut part = dense.slice(a, b);
        part.points = smooth(&part.points, false, t.smooth);
        let fitted = || {
            let mut path = BezPath::new();
            path.move_to(part.points[0]);
            add_smooth(&part.points, t.fit, &mut path);
            path
        };
        let (simple, fitted) = simple_and_fitted(&part, t.fit > 0.0, t, fitted);
        append(&mut line, &simple);
        let drawn = fitted.unwrap_or_else(|| polyline(&simple));
        path.extend(drawn.elements().iter().skip(1).copied());
    }
    (line, path)
}

/// Appends a line that starts where the other ends.
fn append(line: &mut SampledLine, part: &SampledLine) {
    for i in 0..part.len() {
        line.push(part.points[i], part.samples[i], part.sides[i]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chains::Sample;
    use crate::chains::sampled_line::LineSide;
    use crate::geometry::numbers::portable_math::{cos, sin};

    #[test]
    fn finish_gives_the_same_curve_with_and_without_points() {
        let t = FinishTolerances {
            px: 1.0,
            smooth: 0.4,
            simplify: 0.1,
            tidy: 0.0,
            clean: false,
            circle: None,
            fit: 0.2,
            points: true,
        };
        // Smooth everywhere, exact everywhere, and smooth from point 61 on; each closed and open.
        let kinds: [fn(usize) -> bool; 3] = [|_| true, |_| false, |i| i > 60];
        for (is_soft, closed) in kinds.into_iter().flat_map(|soft| [(soft, true), (soft, false)]) {
            for n in [12, 400] {
                let mut line = SampledLine { closed, ..SampledLine::default() };
                for i in 0..n {
                    let turn = std::f64::consts::TAU * i as f64 / n as f64;
                    let far = 200.0 + if i > n / 2 { 40.0 } else { 0.0 };
                    let point = Point::new(far * cos(turn), far * sin(turn));
                    line.push(point, Sample::new(0.0, 1.0), LineSide::soft(is_soft(i)));
                }
                let (points, with) = finish(line.clone(), t);
                let (none, without) = finish(line.clone(), FinishTolerances { points: false, ..t });
                assert_eq!(with, without, "{n} points, closed: {closed}");
                assert!(points.len() > 1 && none.len() == 0, "{n} points, closed: {closed}");
            }
        }
    }
}
