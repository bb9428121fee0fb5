//! Fits straight lines and circular arcs to a path, each as long as the tolerance allows. Many cutting and
//! milling programs cannot read splines from DXF files, so curves are exported in this form.
//!
//! Input: a Bézier path, a transform and a tolerance in transformed units. Output: per subpath, a circle or a
//! run of lines and arcs.
//!
//! 1. Cubics that stand for arcs become these arcs ([`PathSteps`]).
//! 2. Other curves are flattened finely. From each point, the longest line or arc is taken whose distance to
//!    all points and chords is within the tolerance.
//!
//! Arcs use the *bulge* of DXF: the tangent of a quarter of the included angle, positive anticlockwise with y
//! up.

use kurbo::{Affine, BezPath, Point, Vec2};

use super::arc_recovery::{MAX_ARC_RAD, PathSteps};
use crate::export::tolerances;
use crate::geometry::numbers::portable_math::{atan2, tan};
use crate::geometry::plane::planar_distance::fit_circle_centre;

/// Fitted form of one subpath.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum FittedCurve {
    Circle { centre: Point, radius: f64 },
    Run { start: Point, pieces: Vec<FittedPiece>, closed: bool },
}

/// A straight line or an arc, by its end point and bulge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FittedPiece {
    pub(crate) end: Point,
    pub(crate) bulge: f64,
}

/// Share of the tolerance used by flattening.
const FLATTENING_SHARE: f64 = 0.1;

/// Largest angle between the corners of a polygon that approximates a circle, in radians.
const MAX_FACET_RAD: f64 = 0.27;
/// Largest distance between such a polygon's chords and the circle, in tolerances.
const MAX_FACET_RISE_TOLERANCES: f64 = 2.5;

/// Largest distance of a closed curve from a full circle, in tolerances. It exceeds 1, because closed chains
/// are fitted in two halves, which may each deviate.
const MAX_CIRCLE_OFFSET_TOLERANCES: f64 = 1.5;

/// Fewest points of a flattened circle.
const MIN_CIRCLE_POINTS: usize = 8;

/// Fits lines and arcs to each subpath of a path transformed by `place`. `tolerance` is the largest distance,
/// in units after the transform. Subpaths with points that are not finite are left out.
pub(crate) fn fit_curves(path: &BezPath, place: Affine, tolerance: f64) -> Vec<FittedCurve> {
    let within = tolerance * (1.0 - FLATTENING_SHARE);
    let moved = place * path;
    let subpaths = PathSteps::of(moved.elements(), tolerance * FLATTENING_SHARE);
    subpaths
        .iter()
        .filter_map(|own| {
            if own.has_arcs() { with_arcs(own, within) } else { curve(own.points(), own.closed, within) }
        })
        .collect()
}

/// Fits a subpath with recovered arcs. The parts between the arcs are fitted separately.
fn with_arcs(path: &PathSteps, tolerance: f64) -> Option<FittedCurve> {
    if !path.points().iter().all(|point| point.is_finite()) {
        return None;
    }
    if let Some((centre, radius)) = path.circle() {
        return Some(FittedCurve::Circle { centre, radius });
    }
    let mut fitted_pieces: Vec<FittedPiece> = Vec::new();
    let mut run_points = vec![path.start];
    for step in &path.steps {
        let Some(arc) = step.arc else {
            run_points.push(step.end);
            continue;
        };
        fitted_pieces.extend(pieces(&run_points, tolerance));
        let start = run_points.last().copied().unwrap_or(path.start);
        let bulge_ends = PathSteps::bulges(start, step.end, arc).into_iter();
        fitted_pieces.extend(bulge_ends.map(|(end, bulge)| FittedPiece { end, bulge }));
        run_points = vec![step.end];
    }
    fitted_pieces.extend(pieces(&run_points, tolerance));
    Some(FittedCurve::Run { start: path.start, pieces: fitted_pieces, closed: path.closed })
}

/// Fits a flattened subpath without repeated neighbours. `None` if it has fewer than two points, or points
/// that are not finite.
fn curve(mut points: Vec<Point>, closed: bool, tolerance: f64) -> Option<FittedCurve> {
    if points.iter().any(|point| !point.is_finite()) {
        return None;
    }
    let comes_back = points.len() > 3 && points.first() == points.last();
    if comes_back {
        points.pop();
    }
    let closed = (closed || comes_back) && points.len() > 2;
    let start = *points.first()?;
    if points.len() < 2 {
        return None;
    }
    if !closed {
        return Some(FittedCurve::Run { start, pieces: pieces(&points, tolerance), closed });
    }
    if let Some((centre, radius)) = circle(&points, tolerance) {
        return Some(FittedCurve::Circle { centre, radius });
    }
    points.push(start);
    // A closed line may start inside an arc. Start again at the end of the first piece.
    let first = pieces(&points, tolerance).first().map_or(start, |piece| piece.end);
    if let Some(turn) = points.iter().position(|point| *point == first).filter(|at| *at + 1 < points.len()) {
        points.pop();
        points.rotate_left(turn);
        points.push(first);
    }
    let start = *points.first()?;
    Some(FittedCurve::Run { start, pieces: pieces(&points, tolerance), closed })
}

/// Greedy fit of lines and arcs through all points in order. Lines have bulge 0.
fn pieces(points: &[Point], tolerance: f64) -> Vec<FittedPiece> {
    let mut pieces = Vec::new();
    let mut at = 0;
    while at + 1 < points.len() {
        let (straight, _) = farthest_fit(points, at, 1, |run| is_straight(run, tolerance).then_some(0.0));
        let (round, bulge) = farthest_fit(points, at, 2, |run| arc(run, tolerance));
        let (end, bulge) = if round > straight { (round, bulge) } else { (straight, 0.0) };
        pieces.push(FittedPiece { end: points[end], bulge });
        at = end;
    }
    pieces
}

/// Index of the farthest point that one piece from the point `from` can reach, and the bulge of that piece.
/// Searched by doubling steps from `least`, then bisection. `fits` returns the bulge if a piece fits.
fn farthest_fit(
    points: &[Point],
    from: usize,
    least: usize,
    fits: impl Fn(&[Point]) -> Option<f64>,
) -> (usize, f64) {
    let last = points.len() - 1;
    let fit = |to: usize| points.get(from..=to).and_then(&fits);
    let (mut good, mut told) = (from + 1, 0.0);
    let mut step = least;
    let mut bad = last + 1;
    while from + step <= last {
        match fit(from + step) {
            Some(bulge) => (good, told) = (from + step, bulge),
            None => {
                bad = from + step;
                break;
            }
        }
        step *= 2;
    }
    while good + 1 < bad {
        let middle = good.midpoint(bad);
        match fit(middle) {
            Some(bulge) => (good, told) = (middle, bulge),
            None => bad = middle,
        }
    }
    (good, told)
}

/// Whether all points are on the line from the first to the last and advance along it.
fn is_straight(run: &[Point], tolerance: f64) -> bool {
    let [first, .., last] = run else { return false };
    let way = *last - *first;
    let length = way.hypot();
    let along = way / length;
    let places = run.iter().map(|point| along.dot(*point - *first));
    length > 0.0
        && run.iter().all(|point| along.cross(*point - *first).abs() <= tolerance)
        && places.clone().zip(places.skip(1)).all(|(a, b)| b > a)
}

/// Bulge of an arc from the first to the last point that passes all others within the tolerance. Arcs through
/// the middle point and the two quarter points are tried.
fn arc(run: &[Point], tolerance: f64) -> Option<f64> {
    let (first, last) = (*run.first()?, *run.last()?);
    [2, 1, 3].into_iter().find_map(|quarter| {
        let through = *run.get((run.len() - 1) * quarter / 4)?;
        let centre = centre_of(first, through, last)?;
        let turn = turn_about(run, centre, (first - centre).hypot(), tolerance)?;
        (turn.abs() < MAX_ARC_RAD).then(|| tan(turn / 4.0))
    })
}

/// Centre and radius of the circle that a closed curve follows exactly once; `None` if it is not a circle.
fn circle(points: &[Point], tolerance: f64) -> Option<(Point, f64)> {
    let count = points.len();
    if count < MIN_CIRCLE_POINTS {
        return None;
    }
    let centre = fit_circle_centre(points)?;
    let mean = points.iter().map(|point| (*point - centre).hypot()).sum::<f64>() / count as f64;
    let mut round: Vec<Point> = points.to_vec();
    round.push(points[0]);
    let within = MAX_CIRCLE_OFFSET_TOLERANCES * tolerance;
    let turn =
        turn_about(&round, centre, mean, within).or_else(|| turn_of_facets(&round, centre, mean, within))?;
    ((turn.abs() - std::f64::consts::TAU).abs() < tolerances::MAX_TURN_ROUNDING_RAD).then_some((centre, mean))
}

/// Total angle of points around a centre, radians. `None` if they change direction, or a chord is farther
/// than the tolerance from the circle.
fn turn_about(run: &[Point], centre: Point, radius: f64, tolerance: f64) -> Option<f64> {
    let is_far = |chord: &ArcChord| chord.end_distance + chord.sagitta > tolerance;
    turn_of_chords(run, centre, radius, is_far).map(|(turn, _)| turn)
}

/// The same for a polygon that approximates a circle. Its chords may lie farther inside, if they turn by
/// similar angles.
fn turn_of_facets(run: &[Point], centre: Point, radius: f64, tolerance: f64) -> Option<f64> {
    let is_far = |chord: &ArcChord| {
        chord.end_distance > tolerance || chord.sagitta > MAX_FACET_RISE_TOLERANCES * tolerance
    };
    let (turn, [least, most]) = turn_of_chords(run, centre, radius, is_far)?;
    (most <= MAX_FACET_RAD && most <= 2.0 * least).then_some(turn)
}

/// Total angle of points around a centre, and the least and the greatest angle of a chord. `None` if they change
/// direction, or a chord is too far from the circle.
fn turn_of_chords(
    run: &[Point],
    centre: Point,
    radius: f64,
    is_far: impl Fn(&ArcChord) -> bool,
) -> Option<(f64, [f64; 2])> {
    let (mut turn, mut least, mut most) = (0.0, f64::INFINITY, 0.0_f64);
    for pair in run.windows(2) {
        let chord = ArcChord::new([pair[0], pair[1]], centre, radius)?;
        let step = chord.angle;
        if is_far(&chord) || step == 0.0 || step * turn < 0.0 {
            return None;
        }
        turn += step;
        (least, most) = (least.min(step.abs()), most.max(step.abs()));
    }
    Some((turn, [least, most]))
}

/// A chord compared with a circle.
struct ArcChord {
    /// Angle it subtends at the centre, radians, positive from x to y.
    angle: f64,
    /// Larger distance of its ends from the circle.
    end_distance: f64,
    /// Sagitta: distance between the middle of the chord and that of the arc.
    sagitta: f64,
}

impl ArcChord {
    fn new([a, b]: [Point; 2], centre: Point, radius: f64) -> Option<Self> {
        let (from, to) = (a - centre, b - centre);
        let half = (b - a).hypot() / 2.0;
        let rise = radius - (radius * radius - half * half).max(0.0).sqrt();
        let off = (from.hypot() - radius).abs().max((to.hypot() - radius).abs());
        (half <= radius).then(|| Self {
            angle: atan2(from.cross(to), from.dot(to)),
            end_distance: off,
            sagitta: rise,
        })
    }
}

/// Centre of the circle through three points; `None` if they are collinear.
fn centre_of(a: Point, b: Point, c: Point) -> Option<Point> {
    let (u, v) = (b - a, c - a);
    let twice = 2.0 * u.cross(v);
    let to = Vec2::new(v.y * u.hypot2() - u.y * v.hypot2(), u.x * v.hypot2() - v.x * u.hypot2()) / twice;
    (twice != 0.0 && to.is_finite()).then(|| a + to)
}

/// Centre and radius of the arc from `start` that `piece` describes. The bulge must not be 0.
pub(crate) fn circle_of(start: Point, piece: FittedPiece) -> (Point, f64) {
    let chord = piece.end - start;
    // The height of the arc over its chord is half the chord times the bulge.
    let factor = (1.0 - piece.bulge * piece.bulge) / (4.0 * piece.bulge);
    let centre = start.midpoint(piece.end) + Vec2::new(-chord.y, chord.x) * factor;
    (centre, (start - centre).hypot())
}

#[cfg(test)]
mod tests;
