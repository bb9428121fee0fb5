//! [`dimension`]: a length between two points, with its lines, arrows and value (ISO 129-1).

use kurbo::{Point, Vec2};

use super::ink::{Ink, NARROW};
use crate::error::Error;

/// Height of values, length of arrows, how far lines go on beyond the dimension line, mm.
pub(super) const HIGH: f64 = 3.5;
pub(super) const ARROW: f64 = 3.0;
const BEYOND: f64 = 2.0;

/// Between the shape and the line that leads from it.
const GAP: f64 = 0.8;

/// Draws the length between two points along a direction, on a line through `through`.
pub(super) fn dimension(
    [a, b]: [Point; 2],
    along: Vec2,
    through: Point,
    text: &str,
    ink: &mut Ink,
) -> Result<(), Error> {
    let along = along / along.hypot2().sqrt();
    let foot = |p: Point| through + along * (p - through).dot(along);
    let (from, to) = (foot(a), foot(b));
    for (p, foot) in [(a, from), (b, to)] {
        let out = foot - p;
        let far = out.hypot2().sqrt();
        if far > GAP {
            ink.line(p + out * (GAP / far), foot + out * (BEYOND / far), NARROW);
        }
    }
    let length = (to - from).hypot2().sqrt();
    let wide = ink.width(text, HIGH)?;
    let inside = length >= 2.0 * ARROW + 1.0;
    let (way, reach) = if length > 0.0 { ((to - from) / length, 2.0 * ARROW) } else { (along, 2.0 * ARROW) };
    if inside {
        ink.line(from, to, NARROW);
        ink.arrow(from, -way, ARROW);
        ink.arrow(to, way, ARROW);
    } else {
        ink.line(from - way * reach, to + way * reach, NARROW);
        ink.arrow(from, way, ARROW);
        ink.arrow(to, -way, ARROW);
    }
    // Values are read from below or from the right.
    let mut reading = along;
    if reading.x < -1e-9 || reading.x.abs() <= 1e-9 && reading.y > 0.0 {
        reading = -reading;
    }
    let up = Vec2::new(reading.y, -reading.x);
    // Where there is no room between the arrows, the value stands beside them.
    let beside = if inside && wide < length - 2.0 * ARROW { 0.0 } else { length / 2.0 + reach + wide / 2.0 };
    ink.turned_word(text, from.midpoint(to) + way * beside + up * 1.0, HIGH, reading)
}
