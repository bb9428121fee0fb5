//! [`PartRuns`]: cuts a finished line where it passes from one part of a body to the next.
//!
//! A line along one surface is joined, smoothed and fitted as a whole, however the file splits the surface
//! into parts. Only then is it cut, so that its pieces draw exactly what the whole line does. The cut
//! positions are known on the raw line. On the finished line they are the nearest points within a window of
//! arc length.

use kurbo::{BezPath, ParamCurve, ParamCurveArclen, ParamCurveNearest, PathSeg, Point};

use crate::chains::sampled_line::SampledLine;
use crate::chains::tolerances;
use crate::geometry::plane::planar_distance::{length, nearest_parameter};
use crate::mesh::PartId;

/// Largest shift of a cut along the line by smoothing: a length in px, plus a share of the way from the cut
/// before.
const MAX_SHIFT_PX: f64 = 4.0;
const MAX_SHIFT_SHARE: f64 = 0.1;

/// Error of arc lengths, px.
const MAX_LENGTH_ERROR_PX: f64 = 0.01;

/// Runs of a raw line that lie in one part each.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PartRuns {
    /// For each run: the arc length of its start, its start point and its part.
    runs: Vec<(f64, Point, PartId)>,
    length: f64,
    closed: bool,
    points: Vec<Point>,
}

/// Piece of a finished line in one part.
pub(crate) struct PartPiece {
    pub line: SampledLine,
    pub path: BezPath,
    pub part: PartId,
    /// Whether it starts and ends where the whole line does.
    pub is_end: [bool; 2],
}

/// Position on a line: the index of a side, and the parameter on it.
type CurvePosition = (usize, f64);

impl PartRuns {
    /// Runs of a raw line; `None` if all of it lies in one part.
    pub(crate) fn of(line: &SampledLine) -> Option<Self> {
        let n = line.len();
        let sides = if line.closed { n } else { n.saturating_sub(1) };
        let first = line.sides.first()?.part;
        if line.sides[..sides].iter().all(|side| side.part == first) {
            return None;
        }
        let (mut runs, mut at) = (Vec::<(f64, Point, PartId)>::new(), 0.0);
        for side in 0..sides {
            if runs.last().is_none_or(|run| run.2 != line.sides[side].part) {
                runs.push((at, line.points[side], line.sides[side].part));
            }
            at += length(line.points[(side + 1) % n] - line.points[side]);
        }
        // In a closed line the last run continues in the first one.
        if line.closed && runs.len() > 1 && runs[0].2 == runs[runs.len() - 1].2 {
            runs.remove(0);
        }
        (at > 0.0).then(|| Self { runs, length: at, closed: line.closed, points: line.points.clone() })
    }

    /// Pieces of the finished line. Points are left out if the line has none.
    pub(crate) fn cut(mut self, line: &SampledLine, path: &BezPath, px: f64) -> Vec<PartPiece> {
        let curve: Vec<PathSeg> = path.segments().collect();
        if self.closed {
            let start = curve.first().map_or(self.points[0], PathSeg::start);
            self.begin_at(start);
        }
        let sides = sides_of(line);
        let [on_curve, on_line] = [&curve, &sides].map(|segments| self.places(segments, px));
        let (Some(on_curve), on_line) = (on_curve, on_line) else {
            return vec![PartPiece {
                line: line.clone(),
                path: path.clone(),
                part: self.runs[0].2,
                is_end: [true; 2],
            }];
        };
        let count = self.runs.len();
        let piece = |k: usize| {
            let next =
                |positions: &[CurvePosition]| if k + 1 < count { Some(positions[k + 1]) } else { None };
            let curve = between(&curve, on_curve[k], next(&on_curve), self.closed.then_some(on_curve[0]));
            let mut path = BezPath::new();
            for (i, segment) in curve.iter().enumerate() {
                if i == 0 {
                    path.move_to(segment.start());
                }
                path.push(segment.as_path_el());
            }
            let line = on_line.as_ref().map_or_else(SampledLine::default, |line_positions| {
                line_between(
                    line,
                    line_positions[k],
                    next(line_positions),
                    self.closed.then_some(line_positions[0]),
                )
            });
            let is_end = [!self.closed && k == 0, !self.closed && k + 1 == count];
            PartPiece { line, path, part: self.runs[k].2, is_end }
        };
        (0..count).map(piece).filter(|piece| !piece.path.elements().is_empty()).collect()
    }

    /// Measures a closed line from another start point, since finishing may start elsewhere.
    fn begin_at(&mut self, start: Point) {
        let n = self.points.len();
        let (mut at, mut nearest) = (0.0, (f64::INFINITY, 0.0));
        for side in 0..n {
            let (a, b) = (self.points[side], self.points[(side + 1) % n]);
            let share = nearest_parameter(start, a, b);
            let distance = length(start - a.lerp(b, share));
            if distance < nearest.0 {
                nearest = (distance, at + share * length(b - a));
            }
            at += length(b - a);
        }
        for run in &mut self.runs {
            run.0 = (run.0 - nearest.1).rem_euclid(self.length);
        }
        self.runs.sort_by(|a, b| a.0.total_cmp(&b.0));
    }

    /// Start positions of the runs on the finished line, ascending; `None` if the line has no length.
    fn places(&self, segments: &[PathSeg], px: f64) -> Option<Vec<CurvePosition>> {
        // Arc length at the end of each segment.
        let mut total_length = 0.0;
        let ends: Vec<f64> = segments
            .iter()
            .map(|segment| {
                total_length += segment.arclen(MAX_LENGTH_ERROR_PX * px);
                total_length
            })
            .collect();
        if total_length <= 0.0 {
            return None;
        }
        let start = |i: usize| if i == 0 { 0.0 } else { ends[i - 1] };
        // Last position found, and its arc lengths on the finished and on the raw line.
        let mut last: (CurvePosition, f64, f64) = ((0, 0.0), 0.0, 0.0);
        let mut positions = Vec::with_capacity(self.runs.len());
        for (k, (at, point, _)) in self.runs.iter().enumerate() {
            if k > 0 || self.closed {
                let step = (at - last.2) / self.length * total_length;
                let (wanted, window) = (last.1 + step, MAX_SHIFT_PX * px + MAX_SHIFT_SHARE * step);
                let first = ends.partition_point(|end| *end < wanted - window).max(last.0.0);
                let nearby_segments = (first..segments.len()).take_while(|i| start(*i) <= wanted + window);
                let nearest = |i: usize| {
                    let found = segments[i].nearest(*point, MAX_LENGTH_ERROR_PX * px).t;
                    let share = if i == last.0.0 { found.max(last.0.1) } else { found };
                    ((segments[i].eval(share) - *point).hypot2(), (i, share))
                };
                let found =
                    nearby_segments.map(nearest).min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.0.cmp(&b.1.0)));
                if let Some((_, (i, share))) = found {
                    last = ((i, share), start(i) + (ends[i] - start(i)) * share, *at);
                }
            }
            positions.push(last.0);
        }
        Some(positions)
    }
}

/// Sides of a polyline as path segments.
fn sides_of(line: &SampledLine) -> Vec<PathSeg> {
    let n = line.len();
    let sides = if line.closed { n } else { n.saturating_sub(1) };
    let side = |i: usize| PathSeg::Line(kurbo::Line::new(line.points[i], line.points[(i + 1) % n]));
    (0..sides).map(side).collect()
}

/// Parameter ranges of the segments between two positions. Without `to` they reach the end of the line, and
/// in a closed line on to the first position.
fn stretches(
    count: usize,
    from: CurvePosition,
    to: Option<CurvePosition>,
    first: Option<CurvePosition>,
) -> Vec<(usize, f64, f64)> {
    let run = |from: CurvePosition, to: CurvePosition| {
        (from.0..=to.0.min(count.saturating_sub(1)))
            .map(move |i| (i, if i == from.0 { from.1 } else { 0.0 }, if i == to.0 { to.1 } else { 1.0 }))
    };
    let end = (count.saturating_sub(1), 1.0);
    let stretches: Vec<_> = match (to, first) {
        (Some(to), _) => run(from, to).collect(),
        (None, None) => run(from, end).collect(),
        (None, Some(first)) => run(from, end).chain(run((0, 0.0), first)).collect(),
    };
    stretches.into_iter().filter(|(_, from, to)| to - from > tolerances::MIN_PIECE_OF_SEGMENT).collect()
}

fn between(
    segments: &[PathSeg],
    from: CurvePosition,
    to: Option<CurvePosition>,
    first: Option<CurvePosition>,
) -> Vec<PathSeg> {
    let stretches = stretches(segments.len(), from, to, first).into_iter();
    let part = |(i, from, to): (usize, f64, f64)| {
        if from <= 0.0 && to >= 1.0 { segments[i] } else { segments[i].subsegment(from..to) }
    };
    stretches.map(part).collect()
}

fn line_between(
    line: &SampledLine,
    from: CurvePosition,
    to: Option<CurvePosition>,
    first: Option<CurvePosition>,
) -> SampledLine {
    let n = line.len();
    let sides = if line.closed { n } else { n.saturating_sub(1) };
    let stretches = stretches(sides, from, to, first);
    let mut part = SampledLine::default();
    let mut add = |i: usize, share: f64| {
        let j = (i + 1) % n;
        let (point, sample) = match share {
            share if share <= 0.0 => (line.points[i], line.samples[i]),
            share if share >= 1.0 => (line.points[j], line.samples[j]),
            _ => (line.points[i].lerp(line.points[j], share), line.samples[i].lerp(line.samples[j], share)),
        };
        part.push(point, sample, line.sides[i]);
    };
    for (i, from, to) in stretches {
        add(i, from);
        add(i, to);
    }
    part
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chains::Sample;
    use crate::chains::fit::curve_path::polyline;
    use crate::chains::sampled_line::LineSide;
    use crate::geometry::numbers::portable_math::{cos, sin};

    fn ring_of_parts(closed: bool, part: impl Fn(usize) -> u32) -> SampledLine {
        let mut line = SampledLine { closed, ..SampledLine::default() };
        for i in 0..60 {
            let turn = std::f64::consts::TAU * i as f64 / 60.0;
            let point = Point::new(100.0 * cos(turn), 100.0 * sin(turn));
            let side = LineSide { soft: true, silhouette: false, part: PartId(part(i)) };
            line.push(point, Sample::new(i as f64, 1.0), side);
        }
        line
    }

    #[test]
    fn part_run_pieces_cover_the_whole_line_and_match_their_parts() {
        for closed in [true, false] {
            let line = ring_of_parts(closed, |i| (i as u32 / 7) % 3);
            let path = polyline(&line);
            // A closed line may also start elsewhere.
            for turned in if closed { vec![0, 25] } else { vec![0] } {
                let mut finished = line.clone();
                if closed {
                    finished = line.opened_at(turned);
                    finished.pop();
                    finished.closed = true;
                }
                let pieces = PartRuns::of(&line).unwrap().cut(&finished, &polyline(&finished), 1.0);
                let drawn = |path: &BezPath| path.segments().map(|s| s.arclen(1e-6)).sum::<f64>();
                let sum: f64 = pieces.iter().map(|piece| drawn(&piece.path)).sum();
                assert!((sum - drawn(&path)).abs() < 1e-6, "{sum} {}", drawn(&path));
                assert_eq!(pieces.len(), 9);
                for piece in &pieces {
                    // The middle of each piece lies near a side of its part.
                    let middle = piece.line.points[piece.line.len() / 2];
                    let middle_distance = |i: &usize| length(line.points[*i] - middle);
                    let at =
                        (0..60).min_by(|a, b| middle_distance(a).total_cmp(&middle_distance(b))).unwrap();
                    assert_eq!(line.sides[at].part, piece.part);
                    let start = piece.path.segments().next().unwrap().start();
                    assert!(length(piece.line.points[0] - start) < 1e-9);
                }
            }
        }
        assert_eq!(PartRuns::of(&ring_of_parts(true, |_| 4)), None);
    }
}
