//! Outline of a line of varying width.
//!
//! Points of the axis are moved to both sides by half the width. Béziers are fitted to both sides and joined
//! by the caps.
//!
//! A line without hand-drawn effects is drawn without corners. On the inside of a bend the offset is limited
//! by the bend's radius, so the side does not fold back. For other lines see [`super::offset_side`].

use kurbo::{BezPath, Point, Vec2};

use super::offset_side::{DIRECTION_REACH_POINTS, OffsetSide};
use crate::chains::fit::bezier_fit::{end_tangent, fit, tangent_of};
use crate::drawing::{Cap, Join};
use crate::geometry::plane::planar_distance::{length, unit};
use crate::strokes::axes::stroke_axis::StrokeAxis;

/// Greatest distance of fitted sides from their points, px.
const SIDE_TOLERANCE_PX: f64 = 0.1;

/// Greatest offset on the inside of a bend, as a share of the bend's radius.
const MAX_INNER_OFFSET_OF_RADIUS: f64 = 0.7;

/// Bézier handle length of a quarter circle of radius 1.
const QUARTER_CIRCLE_HANDLE: f64 = 0.552_284_749_830_793_4;

/// Caps and joins of a stroke.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Nib {
    /// Caps at the start and at the end.
    pub caps: [Cap; 2],
    pub join: Join,
    /// The length of a px in user units.
    pub px: f64,
}

/// The outline of a line from its distances to the left and right at every point of its axis. `None` if it
/// has fewer than three points.
pub(crate) fn outline(axis: &StrokeAxis, halves: [&[f64]; 2], nib: &Nib) -> Option<BezPath> {
    if axis.len() < 3 {
        return None;
    }
    let [left, right] = [(halves[0], 1.0), (halves[1], -1.0)];
    let left = OffsetSide::new(axis, left.0, left.1, nib.join);
    let right = OffsetSide::new(axis, right.0, right.1, nib.join).reversed();
    let tolerance = SIDE_TOLERANCE_PX * nib.px;
    let mut path = BezPath::new();
    if axis.closed {
        left.add_loop_to(tolerance, &mut path);
        right.add_loop_to(tolerance, &mut path);
        return Some(path);
    }
    let ends = [axis.points.first()?, axis.points.last()?];
    let (&start, &end) = (left.points.first()?, left.points.last()?);
    let (&back, &home) = (right.points.first()?, right.points.last()?);
    path.move_to(start);
    left.add_to(tolerance, &mut path);
    cap(&mut path, *ends[1], end, back, nib.caps[1], nib.px);
    right.add_to(tolerance, &mut path);
    cap(&mut path, *ends[0], home, start, nib.caps[0], nib.px);
    path.close_path();
    Some(path)
}

/// The outline of a line without corners; `None` if it has fewer than three points.
pub(crate) fn soft_outline(axis: &StrokeAxis, widths: &[f64], nib: &Nib) -> Option<BezPath> {
    let n = axis.len();
    if n < 3 {
        return None;
    }
    let (points, tolerance) = (&axis.points, SIDE_TOLERANCE_PX * nib.px);
    let [left, right] = sides(points, widths, axis.closed);
    let mut path = BezPath::new();
    if axis.closed {
        for side in [left, right.into_iter().rev().collect()] {
            path.move_to(side[0]);
            let seam = unit(side[1] - side[n - 2]);
            fit(&side, seam, seam, tolerance, &mut path);
            path.close_path();
        }
    } else {
        let back: Vec<Point> = right.into_iter().rev().collect();
        path.move_to(left[0]);
        add_side(&left, tolerance, &mut path);
        cap(&mut path, points[n - 1], left[n - 1], back[0], nib.caps[1], nib.px);
        add_side(&back, tolerance, &mut path);
        cap(&mut path, points[0], back[n - 1], left[0], nib.caps[0], nib.px);
        path.close_path();
    }
    Some(path)
}

/// The points offset by half the width to the left and to the right.
fn sides(axis: &[Point], widths: &[f64], closed: bool) -> [Vec<Point>; 2] {
    let n = axis.len();
    let neighbour = |i: usize, step: isize| -> usize {
        if closed {
            (i as isize + step).rem_euclid(n as isize - 1) as usize
        } else {
            (i as isize + step).clamp(0, n as isize - 1) as usize
        }
    };
    let mut sides = [Vec::with_capacity(n), Vec::with_capacity(n)];
    for i in 0..n {
        let (before, after) =
            (axis[neighbour(i, -DIRECTION_REACH_POINTS)], axis[neighbour(i, DIRECTION_REACH_POINTS)]);
        let along = if !closed && (i == 0 || i + 1 == n) {
            let end = |k: usize| if i == 0 { axis[k] } else { axis[n - 1 - k] };
            let tangent = end_tangent(end, n);
            if i == 0 { tangent } else { -tangent }
        } else {
            unit(after - before)
        };
        let normal = Vec2::new(along.y, -along.x);
        // The page's y points down, so a positive turn is to the right.
        let (to, from) = (after - axis[i], axis[i] - before);
        let turn = unit(from).cross(unit(to)) / ((length(to) + length(from)) / 2.0).max(f64::MIN_POSITIVE);
        let half = widths[i] / 2.0;
        let inner = half.min(MAX_INNER_OFFSET_OF_RADIUS / turn.abs().max(f64::MIN_POSITIVE));
        let (left, right) = if turn > 0.0 { (half, inner) } else { (inner, half) };
        sides[0].push(axis[i] + normal * left);
        sides[1].push(axis[i] - normal * right);
    }
    sides
}

fn add_side(points: &[Point], tolerance: f64, path: &mut BezPath) {
    let n = points.len();
    let start = end_tangent(|i| points[i], n);
    let end = -end_tangent(|i| points[n - 1 - i], n);
    debug_assert!(tangent_of(points, 0).is_finite());
    fit(points, start, end, tolerance, path);
}

/// Adds a cap from one side around the end of the axis to the other side.
fn cap(path: &mut BezPath, middle: Point, from: Point, to: Point, cap: Cap, px: f64) {
    let radius = from - middle;
    if length(radius) < SIDE_TOLERANCE_PX * px {
        path.line_to(to);
        return;
    }
    // Direction out of the end of the line.
    let out = Vec2::new(-radius.y, radius.x);
    let opposite = to - middle;
    match cap {
        Cap::Butt => {}
        Cap::Square => {
            path.line_to(from + out);
            path.line_to(to + out);
        }
        Cap::Round => {
            let tip = middle + out;
            path.curve_to(from + out * QUARTER_CIRCLE_HANDLE, tip + radius * QUARTER_CIRCLE_HANDLE, tip);
            path.curve_to(tip + opposite * QUARTER_CIRCLE_HANDLE, to + out * QUARTER_CIRCLE_HANDLE, to);
            return;
        }
    }
    path.line_to(to);
}

#[cfg(test)]
mod tests {
    use kurbo::{PathEl, Shape};

    use super::*;
    use crate::chains::Sample;
    use crate::geometry::numbers::noise::{hash, unit_interval as chance, value_noise};
    use crate::geometry::numbers::portable_math::{cos, sin};
    use crate::geometry::plane::polylines::arc_lengths;

    const ROUND_NIB: Nib = Nib { caps: [Cap::Round; 2], join: Join::Round, px: 1.0 };

    fn axis(points: Vec<Point>, corners: Vec<usize>, closed: bool) -> StrokeAxis {
        let samples = vec![Sample::new(1.0, 1.0); points.len()];
        StrokeAxis { arcs: arc_lengths(&points), points, samples, corners, closed }
    }

    /// Polyline with points a px apart and corners at its vertices.
    fn polyline(vertices: &[(f64, f64)]) -> StrokeAxis {
        let mut points = vec![Point::from(vertices[0])];
        let mut corners = Vec::new();
        for pair in vertices.windows(2) {
            let [a, b] = [pair[0], pair[1]].map(Point::from);
            let count = (length(b - a)).ceil() as usize;
            points.extend((1..=count).map(|k| a.lerp(b, k as f64 / count as f64)));
            corners.push(points.len() - 1);
        }
        corners.pop();
        axis(points, corners, false)
    }

    fn symmetric_outline(axis: &StrokeAxis, widths: &[f64], nib: &Nib) -> BezPath {
        let halves: Vec<f64> = widths.iter().map(|w| w / 2.0).collect();
        outline(axis, [&halves, &halves], nib).expect("an outline")
    }

    /// A crossing of two sides of a flattened closed path.
    fn self_crossing(path: &BezPath) -> Option<Point> {
        let mut points: Vec<Point> = Vec::new();
        kurbo::flatten(path, 0.02, |element| points.extend(element.end_point()));
        points.dedup_by(|a, b| length(*a - *b) < 1e-3);
        let n = points.len();
        let side = |i: usize| (points[i], points[(i + 1) % n]);
        let turn = |a: Point, b: Point, c: Point| (b - a).cross(c - a);
        (0..n).find_map(|i| {
            let crosses = |j: &usize| {
                let ((a, b), (c, d)) = (side(i), side(*j));
                turn(a, b, c) * turn(a, b, d) < -1e-9 && turn(c, d, a) * turn(c, d, b) < -1e-9
            };
            (i + 2..n).filter(|j| !(i == 0 && *j + 1 == n)).find(crosses).map(|_| points[i])
        })
    }

    fn assert_no_self_crossing(path: &BezPath) {
        if let Some(at) = self_crossing(path) {
            panic!("crosses itself at {at:?}: {}", path.to_svg());
        }
    }

    #[test]
    fn stroke_outline_of_a_swelling_line_is_a_wedge() {
        let line: Vec<Point> = (0..=100).map(|i| Point::new(f64::from(i), 50.0)).collect();
        let line = axis(line, vec![], false);
        let widths: Vec<f64> = (0..=100).map(|i| 0.04 * f64::from(i)).collect();
        // The wedge, and the half circle at its thick end.
        let area = 200.0 + std::f64::consts::PI * 2.0;
        for wedge in
            [symmetric_outline(&line, &widths, &ROUND_NIB), soft_outline(&line, &widths, &ROUND_NIB).unwrap()]
        {
            assert!((wedge.area().abs() - area).abs() < 4.0, "{}", wedge.area());
            assert!(wedge.elements().len() < 12, "{wedge:?}");
            assert_eq!(wedge.elements().last(), Some(&PathEl::ClosePath));
            assert_no_self_crossing(&wedge);
        }
    }

    #[test]
    fn stroke_outline_does_not_fold_at_tight_bends() {
        // Hairpin of radius 3 between straight legs, under a pen of width 5.
        let mut line: Vec<Point> = (0..40).map(|i| Point::new(f64::from(i), 0.0)).collect();
        line.extend((0..=8).map(|i| {
            let angle = std::f64::consts::PI * f64::from(i) / 8.0;
            Point::new(40.0 + 3.0 * sin(angle), 3.0 - 3.0 * cos(angle))
        }));
        line.extend((0..40).map(|i| Point::new(39.0 - f64::from(i), 6.0)));
        let bent = axis(line, vec![], false);
        let part = |arc: f64| arc / bent.length();
        let widths: Vec<f64> = bent.arcs.iter().map(|s| 20.0 * part(*s) * (1.0 - part(*s))).collect();
        for path in
            [symmetric_outline(&bent, &widths, &ROUND_NIB), soft_outline(&bent, &widths, &ROUND_NIB).unwrap()]
        {
            assert_no_self_crossing(&path);
            assert!(path.elements().len() < 36, "{}", path.elements().len());
        }
    }

    #[test]
    fn stroke_outline_corners_are_sharp_inside_and_joined_outside() {
        let corner = polyline(&[(0.0, 0.0), (60.0, 0.0), (60.0, 60.0)]);
        let widths = vec![6.0; corner.len()];
        let nib = |join| Nib { caps: [Cap::Butt; 2], join, ..ROUND_NIB };
        let quarter = std::f64::consts::PI * 9.0 / 4.0;
        for (join, outside) in [(Join::Miter, 9.0), (Join::Bevel, 4.5), (Join::Round, quarter)] {
            let path = symmetric_outline(&corner, &widths, &nib(join));
            assert_no_self_crossing(&path);
            // Two legs of 60 by 6 that share a square of 3 by 3, and the corner.
            let area = 2.0 * 360.0 - 9.0 + outside;
            assert!((path.area().abs() - area).abs() < 0.3, "{join:?}: {} {area}", path.area());
            assert_ne!(path.winding(Point::new(57.1, 2.9)), 0);
            assert_eq!(path.winding(Point::new(56.9, 3.1)), 0, "{}", path.to_svg());
        }
        // A corner of 150 degrees is too sharp for a mitre limit of 4.
        let needle = polyline(&[(0.0, 0.0), (60.0, 0.0), (60.0 - 51.96, 30.0)]);
        for join in [Join::Miter, Join::Bevel, Join::Round] {
            let path = symmetric_outline(&needle, &vec![4.0; needle.len()], &nib(join));
            assert_no_self_crossing(&path);
            assert!(path.bounding_box().x1 < 69.0, "{:?}", path.bounding_box());
        }
    }

    #[test]
    fn stroke_outlines_of_random_polylines_do_not_fold() {
        for case in 0..300_u64 {
            let dice = |k: u64| chance(hash(case, &[k]));
            // Legs are longer than the pen is wide. Turns reach 150 degrees and alternate, so the line does
            // not return to itself.
            let mut vertices = vec![(0.0, 0.0)];
            let (mut x, mut y, mut heading) = (0.0, 0.0, 0.0);
            for k in 0..5 {
                let leg = 26.0 + 30.0 * dice(10 + k);
                x += leg * cos(heading);
                y += leg * sin(heading);
                vertices.push((x, y));
                let turn = (0.4 + 2.2 * dice(20 + k)) * if k % 2 == 0 { 1.0 } else { -1.0 };
                heading += turn;
            }
            let line = polyline(&vertices);
            let width = 2.0 + 3.0 * dice(1);
            let widths: Vec<f64> =
                line.arcs.iter().map(|s| width * (0.7 + 0.3 * value_noise(case, s / 20.0))).collect();
            for join in [Join::Miter, Join::Bevel, Join::Round] {
                assert_no_self_crossing(&symmetric_outline(&line, &widths, &Nib { join, ..ROUND_NIB }));
            }
        }
    }

    #[test]
    fn stroke_outlines_of_random_curves_do_not_fold() {
        for case in 0..300_u64 {
            // The heading wanders, with bends down to less than half the pen's width, except at the ends.
            let (mut at, mut points) = (Point::ZERO, vec![Point::ZERO]);
            for k in 0..160 {
                let calm = (f64::from(k.min(160 - k)) / 24.0).min(1.0);
                let heading = 1.3 * calm * value_noise(hash(case, &[0]), f64::from(k) / 9.0);
                at += Vec2::new(cos(heading), sin(heading));
                points.push(at);
            }
            let line = axis(points, vec![], false);
            let widths: Vec<f64> =
                line.arcs.iter().map(|s| 5.0 + 3.0 * value_noise(case, s / 25.0)).collect();
            assert_no_self_crossing(&symmetric_outline(&line, &widths, &ROUND_NIB));
        }
    }

    #[test]
    fn stroke_outline_of_a_closed_line_is_a_ring() {
        let ring: Vec<Point> = (0..=250)
            .map(|i| std::f64::consts::TAU * f64::from(i % 250) / 250.0)
            .map(|angle| Point::new(100.0 + 40.0 * cos(angle), 100.0 + 40.0 * sin(angle)))
            .collect();
        let ring = axis(ring, vec![], true);
        let part = |arc: f64| std::f64::consts::TAU * arc / ring.length();
        let widths: Vec<f64> = ring.arcs.iter().map(|s| 2.4 + 1.2 * cos(part(*s))).collect();
        for path in
            [symmetric_outline(&ring, &widths, &ROUND_NIB), soft_outline(&ring, &widths, &ROUND_NIB).unwrap()]
        {
            assert_eq!(path.elements().iter().filter(|e| matches!(e, PathEl::ClosePath)).count(), 2);
            assert_eq!(path.winding(Point::new(100.0, 100.0)), 0);
            assert_ne!(path.winding(Point::new(140.0, 100.0)), 0);
            let area = std::f64::consts::TAU * 40.0 * 2.4;
            assert!((path.area().abs() - area).abs() < 0.05 * area, "{} {area}", path.area());
        }
        let square = polyline(&[(0.0, 0.0), (50.0, 0.0), (50.0, 50.0), (0.0, 50.0), (0.0, 0.0)]);
        let corners = [0].into_iter().chain(square.corners).collect();
        let square = axis(square.points, corners, true);
        let path =
            symmetric_outline(&square, &vec![4.0; square.len()], &Nib { join: Join::Miter, ..ROUND_NIB });
        assert!(
            (path.area().abs() - (54.0 * 54.0 - 46.0 * 46.0)).abs() < 0.1,
            "{} {}",
            path.area(),
            path.to_svg()
        );
        assert_eq!(path.elements().len(), 12, "{path:?}");
    }
}
