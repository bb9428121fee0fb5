//! Fits smoothly joined cubic Béziers to densely spaced points.
//!
//! Each cubic is the least-squares fit for its points with given end tangents. Source: Schneider, An
//! algorithm for automatically fitting digitized curves, Graphics Gems 1990. Deviation: instead of halving
//! where a fit fails, each cubic reaches as far as it can. This takes about half as many cubics.

use crate::chains::tolerances;
use crate::geometry::plane::planar_distance::{length, unit};
use kurbo::{BezPath, CubicBez, ParamCurve, Point, Vec2};

/// Rounds of reparameterization: each point's parameter moves to the foot point on the curve.
const MAX_NEWTON_ROUNDS: usize = 4;

/// Maximum number of points in the least-squares system. Longer runs are sampled evenly, but all points are
/// checked.
const MAX_SOLVED_POINTS: usize = 40;

/// Appends cubics through `points` to `path`, which ends at the first of them. Both tangents point along the
/// line. No point deviates by more than `tolerance`.
pub(crate) fn fit(points: &[Point], start: Vec2, end: Vec2, tolerance: f64, path: &mut BezPath) {
    let last = points.len().saturating_sub(1);
    let mut from = 0;
    let mut tangent = start;
    let mut guess = 16;
    while from < last {
        let tangent_at = |to: usize| if to == last { end } else { tangent_of(points, to) };
        let attempt = |to: usize| cubic(&points[from..=to], tangent, tangent_at(to), tolerance);
        let mut best: Option<(usize, CubicBez)> = None;
        let mut low = from;
        let mut high = last + 1;
        let mut to = (from + guess).min(last);
        // Double the length while it fits, then bisect between the longest fit and the shortest failure.
        loop {
            if let Some(found) = attempt(to) {
                best = Some((to, found));
                low = to;
            } else {
                high = to;
            }
            if low == last || high - low <= 1 + (low - from) / 12 {
                break;
            }
            to = if high > last { (from + 2 * (low - from)).min(last) } else { low + (high - low) / 2 };
        }
        match best {
            Some((to, curve)) => {
                path.curve_to(curve.p1, curve.p2, curve.p3);
                guess = to - from;
                tangent = tangent_at(to);
                from = to;
            }
            None => {
                path.line_to(points[from + 1]);
                from += 1;
                tangent = if from < last { tangent_of(points, from) } else { end };
            }
        }
    }
}

/// Direction of the line at an inner point.
pub(crate) fn tangent_of(points: &[Point], i: usize) -> Vec2 {
    let last = points.len().saturating_sub(1);
    let (a, b) = (i.saturating_sub(2), (i + 2).min(last));
    unit(points[b] - points[a])
}

/// Direction at the first point, from the circle through three points: the first, one farther on, and one in
/// between.
pub(crate) fn end_tangent(points: impl Fn(usize) -> Point, count: usize) -> Vec2 {
    let reach = (count - 1).min(6);
    if reach < 2 {
        return unit(points(reach) - points(0));
    }
    let (a, b) = (points(reach / 2) - points(0), points(reach) - points(0));
    let (la, lb) = (length(a), length(b));
    if la <= 0.0 || lb <= 0.0 {
        return unit(b);
    }
    // The tangent turns away from the chords as they turn from each other, in proportion to length.
    unit(unit(a) * (1.0 + la / (lb - la).max(0.1 * lb)) - unit(b) * (la / (lb - la).max(0.1 * lb)))
}

/// Cubic through the first and last point that passes all others within `tolerance`.
fn cubic(points: &[Point], start: Vec2, end: Vec2, tolerance: f64) -> Option<CubicBez> {
    let (&first, &last) = (points.first()?, points.last()?);
    let chord = length(last - first);
    if points.len() <= 2 {
        let third = chord / 3.0;
        return Some(CubicBez::new(first, first + start * third, last - end * third, last));
    }
    let stride = points.len().div_ceil(MAX_SOLVED_POINTS);
    let chosen: Vec<Point> =
        points.iter().copied().step_by(stride).take((points.len() - 2) / stride + 1).chain([last]).collect();
    let mut parameters = Vec::with_capacity(chosen.len());
    let mut along = 0.0;
    for (i, p) in chosen.iter().enumerate() {
        if i > 0 {
            along += length(*p - chosen[i - 1]);
        }
        parameters.push(along);
    }
    if along <= 0.0 || chord <= 0.05 * along {
        return None;
    }
    for parameter in &mut parameters {
        *parameter /= along;
    }
    for round in 0..MAX_NEWTON_ROUNDS {
        let curve = solve(&chosen, &parameters, start, end, chord, along)?;
        // Reparameterization cannot correct a larger distance than this.
        let hopeless = if round == 0 { 36.0 } else { 6.0 } * tolerance * tolerance;
        let mut worst = 0.0_f64;
        for (p, t) in chosen.iter().zip(&mut parameters) {
            *t = foot(&curve, *p, *t);
            let off = (curve.eval(*t) - *p).hypot2();
            if off > hopeless {
                return None;
            }
            worst = worst.max(off);
        }
        if worst <= tolerance * tolerance {
            return passes(&curve, points, stride, &parameters, tolerance).then_some(curve);
        }
    }
    None
}

/// Whether the curve passes all points within the tolerance, not only the sampled ones.
fn passes(curve: &CubicBez, points: &[Point], stride: usize, parameters: &[f64], tolerance: f64) -> bool {
    if stride == 1 {
        return true;
    }
    let last = parameters.len() - 1;
    points.iter().enumerate().all(|(i, p)| {
        let k = (i / stride).min(last - 1);
        let part = (i - k * stride) as f64 / stride as f64;
        let guess = parameters[k] + (parameters[k + 1] - parameters[k]) * part.min(1.0);
        let t = foot(curve, *p, guess);
        (curve.eval(t) - *p).hypot2() <= tolerance * tolerance
    })
}

/// Least-squares solution for the lengths of the two handles.
fn solve(
    points: &[Point],
    parameters: &[f64],
    start: Vec2,
    end: Vec2,
    chord: f64,
    along: f64,
) -> Option<CubicBez> {
    let (first, last) = (*points.first()?, *points.last()?);
    let (mut c00, mut c01, mut c11, mut x0, mut x1) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for (p, t) in points.iter().zip(parameters) {
        let (t, s) = (*t, 1.0 - *t);
        let (b0, b1, b2, b3) = (s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t);
        let (a0, a1) = (start * b1, end * -b2);
        let rest = p.to_vec2() - first.to_vec2() * (b0 + b1) - last.to_vec2() * (b2 + b3);
        c00 += a0.dot(a0);
        c01 += a0.dot(a1);
        c11 += a1.dot(a1);
        x0 += a0.dot(rest);
        x1 += a1.dot(rest);
    }
    let determinant = c00 * c11 - c01 * c01;
    let third = along / 3.0;
    let (mut a, mut b) = if determinant > tolerances::MIN_DETERMINANT_SHARE * c00 * c11 {
        ((x0 * c11 - x1 * c01) / determinant, (c00 * x1 - c01 * x0) / determinant)
    } else {
        (third, third)
    };
    // Handles that point backward or reach too far cause loops and cusps.
    let (least, most) = (0.05 * chord, along);
    if !(least..=most).contains(&a) || !(least..=most).contains(&b) {
        a = a.clamp(least, most);
        b = b.clamp(least, most);
    }
    Some(CubicBez::new(first, first + start * a, last - end * b, last))
}

/// One Newton step towards the parameter of the point's foot on the curve.
fn foot(curve: &CubicBez, p: Point, t: f64) -> f64 {
    let s = 1.0 - t;
    let (p0, p1, p2, p3) = (curve.p0, curve.p1, curve.p2, curve.p3);
    let away = curve.eval(t) - p;
    let first = ((p1 - p0) * (s * s) + (p2 - p1) * (2.0 * s * t) + (p3 - p2) * (t * t)) * 3.0;
    let second = ((p2 - p1 - (p1 - p0)) * s + (p3 - p2 - (p2 - p1)) * t) * 6.0;
    let slope = first.dot(first) + away.dot(second);
    if slope <= 0.0 {
        return t;
    }
    (t - away.dot(first) / slope).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fit_reproduces_a_cubic_of_uneven_speed_with_one_curve() {
        // Cubics of very uneven speed, for which arc lengths are a poor first guess of the parameters.
        for (bend, tolerance) in [(0.3, 0.5), (0.6, 0.5), (0.9, 1.0)] {
            let whole = CubicBez::new((0.0, 0.0), (10.0, 60.0 * bend), (40.0, 60.0), (120.0, 10.0));
            let points: Vec<Point> = (0..=30).map(|k| whole.eval(f64::from(k) / 30.0)).collect();
            let mut path = BezPath::new();
            path.move_to(points[0]);
            fit(&points, unit(whole.p1 - whole.p0), unit(whole.p3 - whole.p2), tolerance, &mut path);
            assert_eq!(path.elements().len(), 2, "{bend}: {}", path.to_svg());
        }
    }
}
