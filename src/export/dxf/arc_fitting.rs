//! Straight lines and arcs fitted to a path, each as long as the tolerance allows.
//!
//! 1. Cubics that stand for arcs become these arcs ([`PathSteps`]).
//! 2. Other curves are flattened finely. From each point, the longest line or arc is taken whose distance to
//!    all points and chords is within the tolerance.
//!
//! Arcs use the *bulge* of DXF: the tangent of a quarter of the included angle, positive anticlockwise with y
//! up.

use kurbo::{Affine, BezPath, Point, Vec2};

use super::arc_recovery::PathSteps;
use crate::geometry::numbers::portable_math::{atan2, tan};
use crate::geometry::plane::planar_distance::fit_circle_centre;

/// A stroke without lifting the pen.
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

/// Largest angle of an arc in radians. The ends of longer arcs are so close together that the centre is
/// uncertain.
const MAX_ARC_RAD: f64 = 6.0;

/// Largest angle between corners of a polygon that stands for a circle, in radians.
const MAX_FACET_RAD: f64 = 0.27;
/// Largest distance of its chords from the circle, in tolerances.
const MAX_FACET_RISE_TOLERANCES: f64 = 2.5;

/// Largest distance of a closed curve from a full circle, in tolerances. Curves are fitted to chains in two
/// halves.
const MAX_CIRCLE_OFFSET_TOLERANCES: f64 = 1.5;

/// Fewest points of a flattened circle.
const MIN_CIRCLE_POINTS: usize = 8;

/// Lines and arcs of a path, transformed by `place`, within `tolerance` in units after the transform.
pub(crate) fn curves(path: &BezPath, place: Affine, tolerance: f64) -> Vec<FittedCurve> {
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

/// The curve of a subpath with recovered arcs.
fn with_arcs(own: &PathSteps, tolerance: f64) -> Option<FittedCurve> {
    if !own.points().iter().all(|point| point.is_finite()) {
        return None;
    }
    if let Some((centre, radius)) = own.circle() {
        return Some(FittedCurve::Circle { centre, radius });
    }
    let mut found: Vec<FittedPiece> = Vec::new();
    let mut between = vec![own.start];
    for step in &own.steps {
        let Some(arc) = step.arc else {
            between.push(step.end);
            continue;
        };
        found.extend(pieces(&between, tolerance));
        let start = between.last().copied().unwrap_or(own.start);
        let ends = PathSteps::bulges(start, step.end, arc).into_iter();
        found.extend(ends.map(|(end, bulge)| FittedPiece { end, bulge }));
        between = vec![step.end];
    }
    found.extend(pieces(&between, tolerance));
    Some(FittedCurve::Run { start: own.start, pieces: found, closed: own.closed })
}

/// The curve through points without repeated neighbours; a closed curve returns to the first point.
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
    // A closed line may start anywhere, even inside an arc. Start again at the end of the first piece.
    let first = pieces(&points, tolerance).first().map_or(start, |piece| piece.end);
    if let Some(turn) = points.iter().position(|point| *point == first).filter(|at| *at + 1 < points.len()) {
        points.pop();
        points.rotate_left(turn);
        points.push(first);
    }
    let start = *points.first()?;
    Some(FittedCurve::Run { start, pieces: pieces(&points, tolerance), closed })
}

/// Lines and arcs through all points in order.
fn pieces(points: &[Point], tolerance: f64) -> Vec<FittedPiece> {
    let mut pieces = Vec::new();
    let mut at = 0;
    while at + 1 < points.len() {
        let (straight, _) = furthest(points, at, 1, |run| is_straight(run, tolerance).then_some(0.0));
        let (round, bulge) = furthest(points, at, 2, |run| arc(run, tolerance));
        let (end, bulge) = if round > straight { (round, bulge) } else { (straight, 0.0) };
        pieces.push(FittedPiece { end: points[end], bulge });
        at = end;
    }
    pieces
}

/// Farthest index that one piece from a point can reach, at least the next one: doubling steps, then
/// bisection.
fn furthest(
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

/// Bulge of an arc from the first to the last point that passes all others. The arc goes through one of three
/// inner points.
fn arc(run: &[Point], tolerance: f64) -> Option<f64> {
    let (first, last) = (*run.first()?, *run.last()?);
    [2, 1, 3].into_iter().find_map(|quarter| {
        let through = *run.get((run.len() - 1) * quarter / 4)?;
        let centre = centre_of(first, through, last)?;
        let turn = turn_about(run, centre, (first - centre).hypot(), tolerance)?;
        (turn.abs() < MAX_ARC_RAD).then(|| tan(turn / 4.0))
    })
}

/// Circle through all points of a closed curve that goes round it once.
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
    ((turn.abs() - std::f64::consts::TAU).abs() < 1e-6).then_some((centre, mean))
}

/// Total angle of points around a centre, always in one direction, with all chords near the circle.
fn turn_about(run: &[Point], centre: Point, radius: f64, tolerance: f64) -> Option<f64> {
    let mut turn = 0.0;
    for pair in run.windows(2) {
        let Chord { step, off, rise } = Chord::new([pair[0], pair[1]], centre, radius)?;
        if off + rise > tolerance || step == 0.0 || step * turn < 0.0 {
            return None;
        }
        turn += step;
    }
    Some(turn)
}

/// The same for a polygon that stands for a circle: its chords may be further inside, if they turn by similar
/// angles.
fn turn_of_facets(run: &[Point], centre: Point, radius: f64, tolerance: f64) -> Option<f64> {
    let (mut turn, mut least, mut most) = (0.0, f64::INFINITY, 0.0_f64);
    for pair in run.windows(2) {
        let Chord { step, off, rise } = Chord::new([pair[0], pair[1]], centre, radius)?;
        if off > tolerance || rise > MAX_FACET_RISE_TOLERANCES * tolerance || step == 0.0 || step * turn < 0.0
        {
            return None;
        }
        turn += step;
        (least, most) = (least.min(step.abs()), most.max(step.abs()));
    }
    (most <= MAX_FACET_RAD && most <= 2.0 * least).then_some(turn)
}

/// A chord compared with a circle.
struct Chord {
    /// Angle in radians.
    step: f64,
    /// Distance of its ends from the circle.
    off: f64,
    /// Distance of its middle from that of the arc.
    rise: f64,
}

impl Chord {
    fn new([a, b]: [Point; 2], centre: Point, radius: f64) -> Option<Self> {
        let (from, to) = (a - centre, b - centre);
        let half = (b - a).hypot() / 2.0;
        let rise = radius - (radius * radius - half * half).max(0.0).sqrt();
        let off = (from.hypot() - radius).abs().max((to.hypot() - radius).abs());
        (half <= radius).then(|| Self { step: atan2(from.cross(to), from.dot(to)), off, rise })
    }
}

/// Centre of the circle through three points; `None` if they are collinear.
fn centre_of(a: Point, b: Point, c: Point) -> Option<Point> {
    let (u, v) = (b - a, c - a);
    let twice = 2.0 * u.cross(v);
    let to = Vec2::new(v.y * u.hypot2() - u.y * v.hypot2(), u.x * v.hypot2() - v.x * u.hypot2()) / twice;
    (twice != 0.0 && to.is_finite()).then(|| a + to)
}

/// Centre and radius of an arc.
pub(crate) fn circle_of(start: Point, piece: FittedPiece) -> (Point, f64) {
    let chord = piece.end - start;
    // The height of the arc over its chord is half the chord times the bulge.
    let factor = (1.0 - piece.bulge * piece.bulge) / (4.0 * piece.bulge);
    let centre = start.midpoint(piece.end) + Vec2::new(-chord.y, chord.x) * factor;
    (centre, (start - centre).hypot())
}

#[cfg(test)]
mod tests {
    use kurbo::{PathEl, Shape};

    use super::*;
    use crate::geometry::numbers::portable_math::{cos, sin};

    const TOLERANCE: f64 = 0.005;

    fn of(path: &BezPath) -> Vec<FittedCurve> {
        curves(path, Affine::IDENTITY, TOLERANCE)
    }

    fn only(path: &BezPath) -> (Point, Vec<FittedPiece>, bool) {
        match of(path).as_slice() {
            [FittedCurve::Run { start, pieces, closed }] => (*start, pieces.clone(), *closed),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn a_circle_is_a_circle() {
        let path = kurbo::Circle::new((30.0, 40.0), 25.0).to_path(1e-6);
        let told = of(&path);
        let [FittedCurve::Circle { centre, radius }] = told.as_slice() else { panic!("{told:?}") };
        assert!((*centre - Point::new(30.0, 40.0)).hypot() < TOLERANCE && (radius - 25.0).abs() < TOLERANCE);
    }

    #[test]
    fn an_arc_is_one_piece_and_a_corner_two() {
        let arc = kurbo::Arc::new((0.0, 0.0), (10.0, 10.0), 0.3, 2.0, 0.0);
        let (start, pieces, closed) = only(&arc.to_path(1e-6));
        assert!(!closed && pieces.len() == 1, "{pieces:?}");
        assert!((pieces[0].bulge - tan(0.5)).abs() < 1e-3, "{pieces:?}");
        let (centre, radius) = circle_of(start, pieces[0]);
        assert!(centre.to_vec2().hypot() < 0.02 && (radius - 10.0).abs() < 0.02);

        let (_, pieces, _) = only(&BezPath::from_svg("M0 0L10 0 20 0 20 5").unwrap());
        let ends: Vec<_> = pieces.iter().map(|piece| (piece.end, piece.bulge)).collect();
        assert_eq!(ends, [(Point::new(20.0, 0.0), 0.0), (Point::new(20.0, 5.0), 0.0)]);
    }

    #[test]
    fn closed_lines_begin_where_a_piece_does() {
        // A slot that starts in the middle of one of its arcs.
        let slot = "M25 -5A5 5 0 0 1 30 0A5 5 0 0 1 25 5L0 5A5 5 0 0 1 0 -5Z";
        let (_, pieces, closed) = only(&BezPath::from_svg(slot).unwrap());
        assert!(closed);
        assert_eq!(pieces.iter().filter(|piece| piece.bulge != 0.0).count(), 2, "{pieces:?}");
        assert_eq!(pieces.len(), 4, "{pieces:?}");
    }

    /// Long straight lines are not an arc, even if their corners are on a circle.
    #[test]
    fn a_hexagon_has_six_sides() {
        let corner = |k: u32| {
            let angle = f64::from(k) * std::f64::consts::FRAC_PI_3;
            Point::new(9.0 * cos(angle), 9.0 * sin(angle))
        };
        let mut path = BezPath::new();
        path.move_to(corner(0));
        (1..6).for_each(|k| path.line_to(corner(k)));
        path.close_path();
        let (_, pieces, closed) = only(&path);
        assert!(closed && pieces.len() == 6 && pieces.iter().all(|piece| piece.bulge == 0.0), "{pieces:?}");
    }

    /// A polygon with many sides is a circle; one with few sides is not.
    #[test]
    fn circles_of_corners_are_circles() {
        let polygon = |sides: u32, radius: f64| {
            let mut path = BezPath::new();
            for k in 0..sides {
                let angle = std::f64::consts::TAU * f64::from(k) / f64::from(sides);
                let corner = Point::new(radius * cos(angle), radius * sin(angle));
                if k == 0 { path.move_to(corner) } else { path.line_to(corner) }
            }
            path.close_path();
            of(&path)
        };
        assert!(matches!(polygon(72, 15.0).as_slice(), [FittedCurve::Circle { .. }]));
        assert!(matches!(polygon(8, 0.2).as_slice(), [FittedCurve::Run { .. }]));
        assert!(matches!(polygon(72, 100.0).as_slice(), [FittedCurve::Run { .. }]));
    }

    /// Every point of a curve is near its lines and arcs, and the other way round.
    #[test]
    fn pieces_keep_within_the_tolerance() {
        for k in 0..200 {
            let a = f64::from(k);
            let path = format!(
                "M0 0C{} {} {} {} {} {}",
                60.0 * sin(a),
                40.0 * cos(1.7 * a),
                50.0 + 30.0 * sin(2.1 * a),
                80.0 * cos(0.7 * a),
                70.0,
                20.0 * cos(a)
            );
            let path = BezPath::from_svg(&path).unwrap();
            let (start, pieces, _) = only(&path);
            let mut at = start;
            let mut inked: Vec<Point> = Vec::new();
            for piece in &pieces {
                let steps = 400;
                inked.extend((0..=steps).map(|k| along(at, *piece, f64::from(k) / f64::from(steps))));
                at = piece.end;
            }
            kurbo::flatten(&path, 1e-4, |element| {
                if let PathEl::LineTo(p) | PathEl::MoveTo(p) = element {
                    let off = inked.iter().map(|q| (*q - p).hypot()).fold(f64::INFINITY, f64::min);
                    assert!(off < 0.15, "{off} at {p:?} of {k}");
                }
            });
            for q in &inked {
                let off = path
                    .segments()
                    .map(|s| kurbo::ParamCurveNearest::nearest(&s, *q, 1e-6).distance_sq.sqrt());
                let off = off.fold(f64::INFINITY, f64::min);
                assert!(off < 1.1 * TOLERANCE, "{off} of {k}");
            }
            assert!(pieces.len() < 60, "{} pieces", pieces.len());
        }
    }

    /// A point of a piece at parameter 0 to 1.
    fn along(start: Point, piece: FittedPiece, t: f64) -> Point {
        if piece.bulge == 0.0 {
            return start.lerp(piece.end, t);
        }
        let (centre, _) = circle_of(start, piece);
        let turn = 4.0 * atan2(piece.bulge, 1.0) * t;
        centre + (Affine::rotate(turn) * (start - centre).to_point()).to_vec2()
    }
}
