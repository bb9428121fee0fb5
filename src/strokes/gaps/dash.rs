//! Dash patterns, stretched so that every end and corner of a path lies on a dash, as ISO 128-2 requires.

use glam::DVec3;
use kurbo::{BezPath, ParamCurveArclen, PathSeg, Point, Vec2};

use crate::chains::Anchor;
use crate::strokes::tolerances;

/// Path length in periods below which a path is drawn solid, because a single gap would look like a fault.
const MIN_PERIODS: f64 = 0.6;
/// Cosine of the least turn that makes a corner, 20 degrees.
const CORNER_COSINE: f64 = 0.939_692_620_785_908_4;
/// Greatest number of dashes and gaps written out for one path. Longer paths use one repeated pattern, which
/// limits file size. The outline of an A0 sheet in the dashes of `technical` has about 2,600.
const MAX_ENTRIES: usize = 8192;

/// The dash array and offset of a path, from the wanted lengths of dashes and gaps in turn. Empty if the path
/// is to be solid. All lengths are in user units.
///
/// An open path begins and ends with a whole dash. A closed path has a whole number of periods and the middle
/// of a dash at its start. Each corner lies inside a dash: the pattern is stretched from corner to corner.
#[must_use]
pub(crate) fn fit(path: &BezPath, closed: bool, lengths: &[f64]) -> (Vec<f64>, f64) {
    fit_from(path, closed, lengths, 0.0)
}

/// The same for a closed path without corners, with the middle of a dash at the given share of its length.
#[must_use]
pub(crate) fn fit_round(path: &BezPath, share: f64, lengths: &[f64]) -> (Vec<f64>, f64) {
    fit_from(path, true, lengths, share)
}

fn fit_from(path: &BezPath, closed: bool, lengths: &[f64], share: f64) -> (Vec<f64>, f64) {
    let pattern = whole_pattern(lengths);
    let period: f64 = pattern.iter().sum();
    let gaps: f64 = pattern.iter().skip(1).step_by(2).sum();
    if !period.is_finite() || period <= 0.0 || gaps <= 0.0 {
        return (Vec::new(), 0.0);
    }
    let runs = runs(path, closed, period);
    if runs.len() > 1
        && let Some(dashes) = across_corners(&runs, closed, &pattern, period)
    {
        return dashes;
    }
    let length = runs.iter().sum();
    let (dashes, offset) = uniform(length, closed, &pattern, period);
    let stretched: f64 = dashes.iter().sum();
    if share == 0.0 || stretched <= 0.0 {
        return (dashes, offset);
    }
    (dashes, (offset - share * length).rem_euclid(stretched))
}

/// The dash array and offset of an open path whose ends are known on the model. The pattern is not stretched
/// and stays fixed on the model, independent of where the visible part begins.
///
/// The middle of a dash lies where the model's centre projects onto the line. The pattern is therefore the
/// same from both ends.
#[must_use]
pub(crate) fn fixed(path: &BezPath, ends: [Anchor; 2], lengths: &[f64]) -> (Vec<f64>, f64) {
    let (pattern, _) = fit(path, false, lengths);
    let [from, to] = ends.map(|anchor| DVec3::from_array(anchor.rest_position.map(f64::from)));
    let chord = (to - from).length();
    let own = whole_pattern(lengths);
    let period: f64 = own.iter().sum();
    if pattern.is_empty() || chord <= 0.0 {
        return (pattern, 0.0);
    }
    let length: f64 =
        path.segments().map(|segment| segment.arclen(period * tolerances::MAX_LENGTH_ERROR_OF_PERIOD)).sum();
    let before = from.dot(to - from) / (chord * chord) * length;
    let offset = (before + own.first().copied().unwrap_or_default() / 2.0).rem_euclid(period);
    (own, offset)
}

/// Lengths of dashes and gaps in turn, twice if their number is odd.
fn whole_pattern(lengths: &[f64]) -> Vec<f64> {
    lengths.repeat(1 + lengths.len() % 2)
}

/// Lengths of the runs between the corners of a path.
fn runs(path: &BezPath, closed: bool, period: f64) -> Vec<f64> {
    let mut runs: Vec<f64> = Vec::new();
    let mut last: Option<Vec2> = None;
    for segment in path.segments() {
        let length = segment.arclen(period * tolerances::MAX_LENGTH_ERROR_OF_PERIOD);
        if length <= 0.0 {
            continue;
        }
        let [from, to] = directions(segment);
        let turns = |before: Vec2| before.dot(from) < CORNER_COSINE * (before.hypot() * from.hypot());
        match runs.last_mut() {
            Some(run) if !last.is_some_and(turns) => *run += length,
            _ => runs.push(length),
        }
        last = Some(to);
    }
    // A run too short for a gap would be solid. A circle of many short segments would then be all solid, so
    // such a path counts as one curve.
    if closed && runs.len() > 2 && runs.iter().all(|run| *run < period * MIN_PERIODS) {
        return vec![runs.iter().sum()];
    }
    runs
}

/// Directions at the start and end of a path segment.
fn directions(segment: PathSeg) -> [Vec2; 2] {
    let points: Vec<Point> = match segment {
        PathSeg::Line(line) => vec![line.p0, line.p1],
        PathSeg::Quad(quad) => vec![quad.p0, quad.p1, quad.p2],
        PathSeg::Cubic(cubic) => vec![cubic.p0, cubic.p1, cubic.p2, cubic.p3],
    };
    // Control points may coincide with the ends.
    let (first, last) = (points[0], points[points.len() - 1]);
    let from = points.iter().map(|p| *p - first).find(|way| *way != Vec2::ZERO);
    let to = points.iter().rev().map(|p| last - *p).find(|way| *way != Vec2::ZERO);
    [from, to].map(Option::unwrap_or_default)
}

/// One pattern, repeated along the whole path.
fn uniform(length: f64, closed: bool, pattern: &[f64], period: f64) -> (Vec<f64>, f64) {
    let first = pattern.first().copied().unwrap_or(0.0);
    let spare = if closed { 0.0 } else { first };
    let periods = ((length - spare) / period).round();
    if periods < 1.0 || length < period * MIN_PERIODS {
        return (Vec::new(), 0.0);
    }
    let stretch = length / (periods * period + spare);
    let dashes = pattern.iter().map(|entry| entry * stretch).collect();
    (dashes, if closed { first * stretch / 2.0 } else { 0.0 })
}

/// All dashes written out. Each run is stretched separately so that dashes lie across the corners. `None` if
/// there would be too many.
fn across_corners(runs: &[f64], closed: bool, pattern: &[f64], period: f64) -> Option<(Vec<f64>, f64)> {
    let first = pattern.first().copied()?;
    let mut dashes: Vec<f64> = vec![0.0];
    for (index, &run) in runs.iter().enumerate() {
        // A run starts and ends in the middle of a dash, except at the ends of an open path.
        let before = if index == 0 && !closed { first } else { first / 2.0 };
        let after = if index + 1 == runs.len() && !closed { first } else { first / 2.0 };
        let inner = period - first;
        let periods = ((run - before - after + first) / period).round();
        if periods < 1.0 || run < period * MIN_PERIODS {
            *dashes.last_mut()? += run;
            continue;
        }
        if dashes.len() as f64 + periods * pattern.len() as f64 > MAX_ENTRIES as f64 {
            return None;
        }
        let stretch = run / (before + after + periods * inner + (periods - 1.0) * first);
        *dashes.last_mut()? += before * stretch;
        for turn in 0..periods as usize {
            dashes.extend(pattern.iter().skip(1).map(|entry| entry * stretch));
            let last = turn + 1 == periods as usize;
            dashes.push(if last { after } else { first } * stretch);
        }
    }
    if dashes.len() < 3 {
        return Some((Vec::new(), 0.0));
    }
    if closed {
        // The last dash of the path and the first one are one dash. The pattern ends with the gap before it.
        let tail = dashes.pop()?;
        let head = dashes.first_mut()?;
        *head += tail;
        Some((dashes, tail))
    } else {
        // The pattern must have even length. Its last gap lies past the end of the path.
        dashes.push(period - first);
        Some((dashes, 0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::{Anchor, fit, fixed};
    use kurbo::{BezPath, Shape};

    fn svg_path(text: &str) -> BezPath {
        BezPath::from_svg(text).unwrap()
    }

    /// Whether the path is inked at a distance from its start.
    fn is_inked(dashes: &[f64], offset: f64, at: f64) -> bool {
        if dashes.is_empty() {
            return true;
        }
        let mut rest = (at + offset) % dashes.iter().sum::<f64>();
        for (index, dash) in dashes.iter().enumerate() {
            if rest < *dash {
                return index % 2 == 0;
            }
            rest -= dash;
        }
        true
    }

    #[test]
    fn fit_round_centres_a_dash_at_the_given_share() {
        let circle = kurbo::Circle::new((0.0, 0.0), 50.0).to_path(1e-6);
        let length = std::f64::consts::TAU * 50.0;
        for share in [0.0, 0.13, 0.5, 0.99] {
            let (dashes, offset) = super::fit_round(&circle, share, &[8.0, 4.0]);
            let at = |by: f64| is_inked(&dashes, offset, (share * length + by).rem_euclid(length));
            // Ink for half a dash to both sides, and no farther.
            assert!(at(0.0) && at(3.7) && at(-3.7) && !at(4.9) && !at(-4.9), "{share}: {dashes:?} {offset}");
        }
    }

    #[test]
    fn an_open_line_ends_with_a_whole_dash() {
        for length in [20.0, 33.3, 100.0, 127.0] {
            let (dashes, offset) = fit(&svg_path(&format!("M0 0L{length} 0")), false, &[6.0, 3.0]);
            let period: f64 = dashes.iter().sum();
            let rest = (length - dashes[0]) / period;
            assert!((rest - rest.round()).abs() < 1e-9, "{length}: {dashes:?}");
            assert!((offset).abs() < 1e-12);
            assert!(dashes[0] > 6.0 * 0.6 && dashes[0] < 6.0 * 1.6);
        }
    }

    #[test]
    fn lines_without_room_for_dashes_are_solid() {
        assert_eq!(fit(&svg_path("M0 0L7 0"), false, &[6.0, 3.0]), (vec![], 0.0));
        assert_eq!(fit(&svg_path("M0 0L700 0"), false, &[]), (vec![], 0.0));
        assert_eq!(fit(&svg_path("M0 0L700 0"), false, &[5.0, 0.0]), (vec![], 0.0));
    }

    #[test]
    fn a_dashed_circle_has_whole_periods_and_starts_inside_a_dash() {
        let circle = kurbo::Circle::new((0.0, 0.0), 50.0).to_path(1e-6);
        let (dashes, offset) = fit(&circle, true, &[6.0, 3.0]);
        let turns = std::f64::consts::TAU * 50.0 / dashes.iter().sum::<f64>();
        assert!((turns - turns.round()).abs() < 1e-3);
        assert!((offset - dashes[0] / 2.0).abs() < 1e-12);
    }

    #[test]
    fn corners_lie_on_dashes() {
        for (text, closed, corners) in [
            ("M0 0L100 0L100 47L20 47", false, vec![0.0, 100.0, 147.0, 226.999]),
            ("M0 0L100 0L100 47L0 47Z", true, vec![0.0, 100.0, 147.0, 247.0, 293.999]),
            ("M0 0L100 0L100 2L0 2Z", true, vec![0.0, 100.0, 101.0, 102.0, 202.0]),
        ] {
            let (dashes, offset) = fit(&svg_path(text), closed, &[12.0, 3.0]);
            assert_eq!(dashes.len() % 2, 0);
            assert!(dashes.len() >= 8, "{text}: {dashes:?}");
            for corner in corners {
                for near in [corner - 1.0_f64, corner, corner + 1.0] {
                    let near = near.clamp(0.0, if closed { 1e9 } else { 226.999 });
                    assert!(is_inked(&dashes, offset, near), "{text} at {near}: {dashes:?} {offset}");
                }
            }
        }
    }

    /// The lengths from the start of a path to its corners.
    fn corner_arc_lengths(sides: &[f64]) -> Vec<f64> {
        let sums = sides.iter().scan(0.0, |sum, side| {
            *sum += side;
            Some(*sum)
        });
        sums.collect()
    }

    #[test]
    fn corners_of_rectangles_of_any_size_lie_on_dashes() {
        let mut dice = crate::geometry::dice::Dice::new(57);
        for round in 0..200 {
            let [width, height] = [0; 2].map(|_: i32| dice.between(20.0, 900.0));
            let text = format!("M0 0H{width}V{height}H0Z");
            let (dashes, offset) = fit(&svg_path(&text), true, &[11.3, 2.8]);
            for corner in corner_arc_lengths(&[width, height, width, height - 1e-6]) {
                for near in [-3.0, -1.0, 0.0, 1.0, 3.0] {
                    let at = (corner + near).rem_euclid(2.0 * (width + height));
                    assert!(is_inked(&dashes, offset, at), "{round}: {text} at {at}");
                }
            }
        }
    }

    #[test]
    fn corners_between_curves_lie_on_dashes() {
        // Two half circles and a quarter circle that meet at corners, and a slot without corners.
        let arc = |r: f64| std::f64::consts::PI * r;
        let text = "M0 0A60 60 0 0 1 120 0A90 90 0 0 1 300 0A45 45 0 0 1 345 45";
        let (dashes, offset) = fit(&svg_path(text), false, &[12.0, 3.0]);
        for corner in corner_arc_lengths(&[arc(60.0), arc(90.0)]) {
            for near in [-4.0, 0.0, 4.0] {
                assert!(is_inked(&dashes, offset, corner + near), "at {}: {dashes:?}", corner + near);
            }
        }
        let slot = svg_path("M0 0H100A40 40 0 0 1 100 80H0A40 40 0 0 1 0 0Z");
        assert_eq!(fit(&slot, true, &[12.0, 3.0]).0.len(), 2);
    }

    #[test]
    fn paths_of_very_many_dashes_repeat_one_dash_pattern() {
        let (dashes, _) = fit(&svg_path("M0 0H100000V100000H0Z"), true, &[6.0, 3.0]);
        assert_eq!(dashes.len(), 2);
    }

    #[test]
    fn a_polyline_without_corners_repeats_one_dash_pattern() {
        let (dashes, _) = fit(&svg_path("M0 0L50 0L100 1L150 3"), false, &[6.0, 3.0]);
        assert_eq!(dashes.len(), 2);
    }

    #[test]
    fn an_odd_dash_pattern_is_doubled() {
        assert_eq!(fit(&svg_path("M0 0L100 0"), false, &[5.0]).0.len(), 2);
        assert_eq!(fit(&svg_path("M0 0L100 0"), false, &[5.0, 2.0, 1.0]).0.len(), 6);
    }

    /// Whole dashes on a path, in hundredths.
    fn whole_dashes(from: f64, to: f64, all: f64) -> Vec<[i64; 2]> {
        let mut path = BezPath::new();
        path.move_to((from, 0.0));
        path.line_to((to, 0.0));
        let anchor = |x: f64| Anchor { rest_position: [(x / all - 0.3) as f32, 0.1, 0.2], scale: 100.0 };
        let (pattern, offset) = fixed(&path, [anchor(from), anchor(to)], &[6.0, 4.0]);
        assert_eq!(pattern, [6.0, 4.0]);
        let way = if to > from { 1.0 } else { -1.0 };
        let starts = (0..40).map(|k| f64::from(k) * 10.0 - offset);
        let ends = starts.map(|start| [from + way * start, from + way * (start + 6.0)]);
        let mut whole: Vec<[i64; 2]> = ends
            .filter(|own| own.iter().all(|x| *x > from.min(to) && *x < from.max(to)))
            .map(|[a, b]| [a.min(b), a.max(b)].map(|x| (x * 100.0).round() as i64))
            .collect();
        whole.sort_unstable();
        whole
    }

    #[test]
    fn dashes_stay_fixed_on_the_model_when_a_line_is_cut() {
        let all = whole_dashes(0.0, 200.0, 200.0);
        assert!(all.len() >= 19);
        for (from, to) in [(3.0, 200.0), (37.5, 150.0), (200.0, 0.0), (180.0, 11.0)] {
            let part = whole_dashes(from, to, 200.0);
            let known = |dash: &[i64; 2]| all.iter().any(|own| own[0].abs_diff(dash[0]) <= 1);
            assert!(part.len() > 9 && part.iter().all(known), "{from} {to}: {part:?} of {all:?}");
        }
        let nowhere = Anchor { rest_position: [0.0; 3], scale: 1.0 };
        let path = BezPath::from_svg("M0 0H50").unwrap_or_default();
        assert!(!fixed(&path, [nowhere, nowhere], &[6.0, 4.0]).0.is_empty());
        assert!(fixed(&path, [nowhere, nowhere], &[]).0.is_empty());
    }
}
