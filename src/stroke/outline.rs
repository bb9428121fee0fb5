//! The outline of a line of varying width.
//!
//! Points close together along the axis are moved to either side by half the width there; Béziers
//! are fitted to both sides and joined by the caps. A line without a hand is drawn without corners: on the
//! inside of a bend a side is never farther off than the bend's centre, so that it does not turn back on
//! itself. For the others see [`super::sides`].

use kurbo::{BezPath, Point, Vec2};

use super::axis::{Axis, length};
use super::sides::{REACH, Side};
use crate::chain::fit::{end_tangent, fit, tangent_of, unit};
use crate::drawing::{Cap, Join};

/// How far the sides may lie from what they are fitted to, px.
const TOLERANCE_PX: f64 = 0.1;

/// The inner side of a bend keeps this part of the way to its centre.
const INNER: f64 = 0.7;

/// Handle of a quarter circle of radius 1.
const QUARTER: f64 = 0.552_284_749_830_793_4;

/// The shape of ends and corners.
#[derive(Debug, Clone, Copy)]
pub(super) struct Nib {
    pub cap: Cap,
    pub join: Join,
    /// User units in a px.
    pub px: f64,
}

/// The outline of a line from its distances to the left and to the right at every point of its axis;
/// `None` for one without length.
pub(super) fn outline(axis: &Axis, halves: [&[f64]; 2], nib: &Nib) -> Option<BezPath> {
    if axis.len() < 3 {
        return None;
    }
    let [left, right] = [(halves[0], 1.0), (halves[1], -1.0)];
    let left = Side::new(axis, left.0, left.1, nib.join);
    let right = Side::new(axis, right.0, right.1, nib.join).reversed();
    let tolerance = TOLERANCE_PX * nib.px;
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
    cap(&mut path, *ends[1], end, back, nib);
    right.add_to(tolerance, &mut path);
    cap(&mut path, *ends[0], home, start, nib);
    path.close_path();
    Some(path)
}

/// The outline of a line without corners.
pub(super) fn soft_outline(axis: &Axis, widths: &[f64], nib: &Nib) -> Option<BezPath> {
    let n = axis.len();
    if n < 3 {
        return None;
    }
    let (points, tolerance) = (&axis.points, TOLERANCE_PX * nib.px);
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
        cap(&mut path, points[n - 1], left[n - 1], back[0], nib);
        add_side(&back, tolerance, &mut path);
        cap(&mut path, points[0], back[n - 1], left[0], nib);
        path.close_path();
    }
    Some(path)
}

/// The points moved by half the width to the left and to the right.
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
        let (before, after) = (axis[neighbour(i, -REACH)], axis[neighbour(i, REACH)]);
        let along = if !closed && (i == 0 || i + 1 == n) {
            let end = |k: usize| if i == 0 { axis[k] } else { axis[n - 1 - k] };
            let tangent = end_tangent(end, n);
            if i == 0 { tangent } else { -tangent }
        } else {
            unit(after - before)
        };
        let normal = Vec2::new(along.y, -along.x);
        // Turn to the right is positive, as y points down.
        let (to, from) = (after - axis[i], axis[i] - before);
        let turn = unit(from).cross(unit(to)) / ((length(to) + length(from)) / 2.0).max(f64::MIN_POSITIVE);
        let half = widths[i] / 2.0;
        let inner = half.min(INNER / turn.abs().max(f64::MIN_POSITIVE));
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

/// From the one side round the end of the axis to the other.
fn cap(path: &mut BezPath, middle: Point, from: Point, to: Point, nib: &Nib) {
    let radius = from - middle;
    if length(radius) < TOLERANCE_PX * nib.px {
        path.line_to(to);
        return;
    }
    // Out of the end of the line.
    let out = Vec2::new(-radius.y, radius.x);
    let opposite = to - middle;
    match nib.cap {
        Cap::Butt => {}
        Cap::Square => {
            path.line_to(from + out);
            path.line_to(to + out);
        }
        Cap::Round => {
            let tip = middle + out;
            path.curve_to(from + out * QUARTER, tip + radius * QUARTER, tip);
            path.curve_to(tip + opposite * QUARTER, to + out * QUARTER, to);
            return;
        }
    }
    path.line_to(to);
}

#[cfg(test)]
mod tests {
    use kurbo::{PathEl, Shape};

    use super::*;
    use crate::chain::Sample;
    use crate::lines::LineKind;
    use crate::math::function::{cos, sin};
    use crate::mesh::{MaterialId, PartId};

    const SWELL: Swell = Swell { width: 4.0, fade: 1.0, cap: Cap::Round, px: 1.0 };

    fn chain(points: Vec<Point>, strength: impl Fn(f64) -> f64, closed: bool) -> Chain {
        let n = points.len() as f64 - 1.0;
        let mut path = BezPath::new();
        path.move_to(points[0]);
        points[1..].iter().for_each(|p| path.line_to(*p));
        if closed {
            path.close_path();
        }
        let sample = |i: usize| Sample { depth: 1.0, strength: strength(i as f64 / n) };
        Chain {
            samples: (0..points.len()).map(sample).collect(),
            points,
            closed,
            kind: LineKind::Suggestive,
            silhouette: false,
            invisibility: 0,
            both_seen: true,
            part: PartId(0),
            material: MaterialId(0),
            smooth: true,
            path,
        }
    }

    /// Whether any two sides of a flattened closed path cross.
    fn crosses(path: &BezPath) -> bool {
        let mut points: Vec<Point> = Vec::new();
        kurbo::flatten(path, 0.05, |element| points.extend(element.end_point()));
        points.dedup_by(|a, b| length(*a - *b) < 1e-3);
        let n = points.len();
        let side = |i: usize| (points[i], points[(i + 1) % n]);
        let turn = |a: Point, b: Point, c: Point| (b - a).cross(c - a);
        (0..n).any(|i| {
            (i + 2..n).filter(|j| !(i == 0 && *j + 1 == n)).any(|j| {
                let ((a, b), (c, d)) = (side(i), side(j));
                turn(a, b, c) * turn(a, b, d) < -1e-9 && turn(c, d, a) * turn(c, d, b) < -1e-9
            })
        })
    }

    #[test]
    fn a_straight_line_that_fades_is_a_wedge() {
        let line: Vec<Point> = (0..=100).map(|i| Point::new(f64::from(i), 50.0)).collect();
        let wedge = outline(&chain(line, |t| t, false), &SWELL).expect("an outline");
        assert!((wedge.width - 2.0).abs() < 0.05, "{}", wedge.width);
        // The wedge and the half circle at its thick end.
        let area = 200.0 + std::f64::consts::PI * 2.0;
        assert!((wedge.path.area().abs() - area).abs() < 4.0, "{}", wedge.path.area());
        assert!(wedge.path.elements().len() < 12, "{:?}", wedge.path);
        assert_eq!(wedge.path.elements().last(), Some(&PathEl::ClosePath));
        assert!(!crosses(&wedge.path));
    }

    #[test]
    fn tight_bends_do_not_fold() {
        // A hairpin of radius 1 between straight legs, under a pen of width 4.
        let mut line: Vec<Point> = (0..40).map(|i| Point::new(f64::from(i), 0.0)).collect();
        line.extend((0..=8).map(|i| {
            let angle = std::f64::consts::PI * f64::from(i) / 8.0;
            Point::new(40.0 + 3.0 * sin(angle), 3.0 - 3.0 * cos(angle))
        }));
        line.extend((0..40).map(|i| Point::new(39.0 - f64::from(i), 6.0)));
        let wide = Swell { width: 5.0, ..SWELL };
        let bent = outline(&chain(line, |t| 4.0 * t * (1.0 - t), false), &wide).expect("an outline");
        assert!(!crosses(&bent.path), "{}", bent.path.to_svg());
        assert!(bent.path.elements().len() < 30, "{}", bent.path.elements().len());
    }

    #[test]
    fn a_closed_line_is_a_ring() {
        let ring: Vec<Point> = (0..60)
            .map(|i| std::f64::consts::TAU * f64::from(i) / 60.0)
            .map(|angle| Point::new(100.0 + 40.0 * cos(angle), 100.0 + 40.0 * sin(angle)))
            .collect();
        let made = outline(&chain(ring, |t| 0.6 + 0.3 * cos(std::f64::consts::TAU * t), true), &SWELL);
        let path = made.expect("an outline").path;
        assert_eq!(path.elements().iter().filter(|e| matches!(e, PathEl::ClosePath)).count(), 2);
        assert_eq!(path.winding(Point::new(100.0, 100.0)), 0);
        assert_ne!(path.winding(Point::new(140.0, 100.0)), 0);
        let area = std::f64::consts::TAU * 40.0 * 4.0 * 0.6;
        assert!((path.area().abs() - area).abs() < 0.05 * area, "{} {area}", path.area());
    }
}
