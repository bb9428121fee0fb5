//! Tests of fitted lines and arcs.

use kurbo::{PathEl, Shape};

use super::*;
use crate::geometry::numbers::portable_math::{cos, sin};

const TOLERANCE: f64 = 0.005;

fn fit_path(path: &BezPath) -> Vec<FittedCurve> {
    fit_curves(path, Affine::IDENTITY, TOLERANCE)
}

fn only_run(path: &BezPath) -> (Point, Vec<FittedPiece>, bool) {
    match fit_path(path).as_slice() {
        [FittedCurve::Run { start, pieces, closed }] => (*start, pieces.clone(), *closed),
        other => panic!("{other:?}"),
    }
}

#[test]
fn circle_path_is_fitted_by_one_circle() {
    let path = kurbo::Circle::new((30.0, 40.0), 25.0).to_path(1e-6);
    let told = fit_path(&path);
    let [FittedCurve::Circle { centre, radius }] = told.as_slice() else { panic!("{told:?}") };
    assert!((*centre - Point::new(30.0, 40.0)).hypot() < TOLERANCE && (radius - 25.0).abs() < TOLERANCE);
}

#[test]
fn arc_is_fitted_by_one_piece_and_a_corner_by_two_lines() {
    let arc = kurbo::Arc::new((0.0, 0.0), (10.0, 10.0), 0.3, 2.0, 0.0);
    let (start, pieces, closed) = only_run(&arc.to_path(1e-6));
    assert!(!closed && pieces.len() == 1, "{pieces:?}");
    assert!((pieces[0].bulge - tan(0.5)).abs() < 1e-3, "{pieces:?}");
    let (centre, radius) = circle_of(start, pieces[0]);
    assert!(centre.to_vec2().hypot() < 0.02 && (radius - 10.0).abs() < 0.02);

    let (_, pieces, _) = only_run(&BezPath::from_svg("M0 0L10 0 20 0 20 5").unwrap());
    let ends: Vec<_> = pieces.iter().map(|piece| (piece.end, piece.bulge)).collect();
    assert_eq!(ends, [(Point::new(20.0, 0.0), 0.0), (Point::new(20.0, 5.0), 0.0)]);
}

#[test]
fn closed_run_begins_at_the_start_of_a_piece() {
    // A slot that starts in the middle of one of its arcs.
    let slot = "M25 -5A5 5 0 0 1 30 0A5 5 0 0 1 25 5L0 5A5 5 0 0 1 0 -5Z";
    let (_, pieces, closed) = only_run(&BezPath::from_svg(slot).unwrap());
    assert!(closed);
    assert_eq!(pieces.iter().filter(|piece| piece.bulge != 0.0).count(), 2, "{pieces:?}");
    assert_eq!(pieces.len(), 4, "{pieces:?}");
}

/// Long straight lines are not an arc, even if their corners are on a circle.
#[test]
fn hexagon_is_fitted_by_six_lines() {
    let corner = |k: u32| {
        let angle = f64::from(k) * std::f64::consts::FRAC_PI_3;
        Point::new(9.0 * cos(angle), 9.0 * sin(angle))
    };
    let mut path = BezPath::new();
    path.move_to(corner(0));
    (1..6).for_each(|k| path.line_to(corner(k)));
    path.close_path();
    let (_, pieces, closed) = only_run(&path);
    assert!(closed && pieces.len() == 6 && pieces.iter().all(|piece| piece.bulge == 0.0), "{pieces:?}");
}

/// A polygon with many sides is a circle; one with few sides is not.
#[test]
fn polygon_with_many_short_sides_is_fitted_by_a_circle() {
    let polygon = |sides: u32, radius: f64| {
        let mut path = BezPath::new();
        for k in 0..sides {
            let angle = std::f64::consts::TAU * f64::from(k) / f64::from(sides);
            let corner = Point::new(radius * cos(angle), radius * sin(angle));
            if k == 0 { path.move_to(corner) } else { path.line_to(corner) }
        }
        path.close_path();
        fit_path(&path)
    };
    assert!(matches!(polygon(72, 15.0).as_slice(), [FittedCurve::Circle { .. }]));
    assert!(matches!(polygon(8, 0.2).as_slice(), [FittedCurve::Run { .. }]));
    assert!(matches!(polygon(72, 100.0).as_slice(), [FittedCurve::Run { .. }]));
}

/// Every point of a curve is near its lines and arcs, and the other way round.
#[test]
fn fitted_pieces_stay_within_the_tolerance() {
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
        let (start, pieces, _) = only_run(&path);
        let mut at = start;
        let mut inked: Vec<Point> = Vec::new();
        for piece in &pieces {
            let steps = 400;
            inked.extend((0..=steps).map(|k| point_along(at, *piece, f64::from(k) / f64::from(steps))));
            at = piece.end;
        }
        kurbo::flatten(&path, 1e-4, |element| {
            if let PathEl::LineTo(p) | PathEl::MoveTo(p) = element {
                let off = inked.iter().map(|q| (*q - p).hypot()).fold(f64::INFINITY, f64::min);
                assert!(off < 0.15, "{off} at {p:?} of {k}");
            }
        });
        for q in &inked {
            let off =
                path.segments().map(|s| kurbo::ParamCurveNearest::nearest(&s, *q, 1e-6).distance_sq.sqrt());
            let off = off.fold(f64::INFINITY, f64::min);
            assert!(off < 1.1 * TOLERANCE, "{off} of {k}");
        }
        assert!(pieces.len() < 60, "{} pieces", pieces.len());
    }
}

/// A point of a piece at parameter 0 to 1.
fn point_along(start: Point, piece: FittedPiece, t: f64) -> Point {
    if piece.bulge == 0.0 {
        return start.lerp(piece.end, t);
    }
    let (centre, _) = circle_of(start, piece);
    let turn = 4.0 * atan2(piece.bulge, 1.0) * t;
    centre + (Affine::rotate(turn) * (start - centre).to_point()).to_vec2()
}
