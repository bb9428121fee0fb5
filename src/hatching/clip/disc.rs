//! [`Disc`]: a dot drawn with cubic curves.

use std::f64::consts::TAU;

use kurbo::{BezPath, Point, Vec2};

use crate::geometry::numbers::portable_math::{cos, sin, tan};
use crate::hatching::tolerances;

/// Dot in user units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Disc {
    pub centre: Point,
    pub radius: f64,
}

impl Disc {
    /// Adds the whole circle to a path, turning from x to y. `px` is the length of a px in user units.
    pub(crate) fn draw(self, path: &mut BezPath, px: f64) {
        let start = Vec2::new(self.radius, 0.0);
        path.move_to(self.centre + start);
        self.arc(path, 0.0, TAU, start, px);
        path.close_path();
    }

    /// Adds an arc to a path whose current point is the start of the arc. It starts at angle `from` and ends
    /// at `end`, relative to the centre.
    pub(crate) fn arc(self, path: &mut BezPath, from: f64, sweep: f64, end: Vec2, px: f64) {
        let near = |n: &f64| self.radius * off_circle(*n) < tolerances::MAX_DOT_OUTLINE_ERROR_PX * px;
        let a_turn = [3.0, 4.0, 6.0].into_iter().find(near).unwrap_or(8.0);
        let count = (sweep / TAU * a_turn - tolerances::ARC_COUNT_ROUNDING).ceil().max(1.0);
        let step = sweep / count;
        let handle = 4.0 / 3.0 * tan(step / 4.0) * self.radius;
        let at = |angle: f64| Vec2::new(cos(angle), sin(angle));
        let mut start_point = at(from);
        for k in 1..=count as usize {
            let end_point = at(from + step * k as f64);
            let to = if k == count as usize { end } else { end_point * self.radius };
            let along = |unit: Vec2| Vec2::new(-unit.y, unit.x) * handle;
            path.curve_to(
                self.centre + start_point * self.radius + along(start_point),
                self.centre + to - along(end_point),
                self.centre + to,
            );
            start_point = end_point;
        }
    }
}

/// Greatest distance of `n` cubics per turn from the unit circle. It is 0.0184 for two cubics and falls with
/// the sixth power of `n`.
fn off_circle(n: f64) -> f64 {
    let angle = 2.0 / n;
    0.0184 * (angle * angle * angle) * (angle * angle * angle)
}

#[cfg(test)]
mod tests {
    use kurbo::{ParamCurve, Shape};

    use super::*;

    #[test]
    fn a_disc_is_drawn_as_a_circle() {
        let centre = Point::new(30.0, 20.0);
        for radius in [0.3, 2.0, 9.0, 100.0] {
            let mut path = BezPath::new();
            Disc { centre, radius }.draw(&mut path, 1.0);
            assert!((path.area() / (TAU / 2.0 * radius * radius) - 1.0).abs() < 2e-3);
            for t in 0..30 {
                let p = path.segments().map(|s| s.eval(f64::from(t) / 30.0));
                p.for_each(|p| assert!(((p - centre).hypot2().sqrt() - radius).abs() < 0.016));
            }
        }
    }
}
