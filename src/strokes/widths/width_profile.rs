//! The width of a line at every point of its axis: its pen's, times what swells and fades it.

use kurbo::Vec2;

use super::swell::Swell;
use crate::chains::fit::bezier_fit::unit;
use crate::geometry::plane::planar_distance::length;
use crate::strokes::axes::stroke_axis::Axis;

/// Length over which the width is evened out, px.
const EVEN_PX: f64 = 10.0;

/// Bends are measured over this length to either side, px.
const BEND_PX: f64 = 5.0;

/// Length over which bends are evened out, px: a brush does not follow every wiggle.
const BEND_EVEN_PX: f64 = 24.0;

/// Length over which lines of unlike width that go on in each other become alike, px.
const MEET_PX: f64 = 16.0;

/// No line of varying width is thinner than this, px.
const LEAST_PX: f64 = 0.12;

/// Where surfaces are painted, lines that bound them are by this part of a px thicker than what they must
/// cover.
const MORE_PX: f64 = 0.1;

/// What widths follow beside the line itself.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Setting {
    /// Width of the pen, user units.
    pub width: f64,
    /// The part of the width that is lost where there is no strength.
    pub fade: f64,
    pub swell: Swell,
    /// User units in a px.
    pub px: f64,
    /// The depths of what counts as near and as far.
    pub depths: [f64; 2],
    /// User units in which bends count by half.
    pub bend_radius: f64,
    /// The part of its width that the line has by chance.
    pub chance: f64,
    /// How far to either side the line has to cover the border of something painted, user units.
    pub covers: Option<f64>,
}

impl Setting {
    /// The least width of a line.
    pub fn least(&self) -> f64 {
        let least = self.covers.map_or(LEAST_PX * self.px, |to_side| 2.0 * to_side + MORE_PX * self.px);
        least.min(self.width)
    }
}

/// The width by strength alone.
pub(crate) fn faded(axis: &Axis, width: f64, fade: f64) -> Vec<f64> {
    let strengths: Vec<f64> = axis.samples.iter().map(|sample| sample.strength).collect();
    let strengths = even(&strengths, axis.closed, EVEN_PX as usize);
    strengths.iter().map(|s| width * (1.0 - fade * (1.0 - s))).collect()
}

/// The width at each point of an axis, before its ends are tapered.
pub(crate) fn widths(axis: &Axis, setting: &Setting) -> Vec<f64> {
    let swell = &setting.swell;
    let n = axis.len();
    if n < 2 {
        return vec![setting.width; n];
    }
    let [nearest, farthest] = setting.depths;
    let range = (farthest - nearest).max(f64::MIN_POSITIVE);
    let factor = |i: usize| {
        let sample = &axis.samples[i];
        let far = ((sample.depth - nearest) / range).clamp(0.0, 1.0);
        setting.chance
            * (1.0 - setting.fade * (1.0 - sample.strength))
            * (1.0 - swell.lit * sample.light.clamp(0.0, 1.0))
            * (1.0 - swell.near * far)
            * (1.0 - swell.gap * (1.0 - sample.gap.clamp(0.0, 1.0)))
    };
    let mut factors = even(&(0..n).map(factor).collect::<Vec<f64>>(), axis.closed, EVEN_PX as usize);
    if swell.bend > 0.0 {
        for (factor, bend) in factors.iter_mut().zip(bends(axis, setting)) {
            *factor *= 1.0 + swell.bend * bend;
        }
    }
    factors.iter().map(|factor| (setting.width * factor).max(setting.least())).collect()
}

/// How much each point bends out of the shape, -1 to 1: x/(1 + |x|) with x the bend's radius of half
/// effect times the curvature.
fn bends(axis: &Axis, setting: &Setting) -> Vec<f64> {
    let n = axis.len();
    let reach = BEND_PX as isize;
    let curvature = |i: usize| {
        let (first, last) = axis.stretch(i);
        let k = i as isize;
        let (before, after) = ((k - reach).max(first), (k + reach).min(last));
        if before >= k || after <= k {
            return 0.0;
        }
        let (p, q, r) = (axis.point(before), axis.point(k), axis.point(after));
        let (from, to): (Vec2, Vec2) = (q - p, r - q);
        // A turn to the right is positive, as y points down. Sine of the turn between chords, over half the
        // way: the circle through the three points.
        let way = length(r - p).max(f64::MIN_POSITIVE);
        2.0 * unit(from).cross(unit(to)) / way
    };
    let curvatures = even(&(0..n).map(curvature).collect::<Vec<f64>>(), axis.closed, BEND_EVEN_PX as usize);
    let sides: Vec<f64> = axis.samples.iter().map(|sample| sample.side).collect();
    let sides = even(&sides, axis.closed, BEND_EVEN_PX as usize);
    let hand = handedness(axis);
    let bend = |(curvature, side): (f64, f64)| {
        // With the shape on the right, a line that bulges out of it turns to the right.
        let outward = if side.abs() > 0.3 { -side.signum() * side.abs().min(1.0) } else { hand };
        let x = curvature * outward * setting.bend_radius;
        x / (1.0 + x.abs())
    };
    curvatures.into_iter().zip(sides).map(bend).collect()
}

/// Where no side is nearer, lines are drawn as a right hand draws them, from left to right or from the top
/// down, and closed ones clockwise; to the right is out. 1 if the axis runs so, -1 if it runs backwards.
fn handedness(axis: &Axis) -> f64 {
    let points = &axis.points;
    let (first, last) = (points[0], points[points.len() - 1]);
    let runs_on = if axis.closed {
        let middle = first.to_vec2();
        let area: f64 =
            points.windows(2).map(|p| (p[0].to_vec2() - middle).cross(p[1].to_vec2() - middle)).sum();
        area >= 0.0
    } else {
        let way = last - first;
        if way.x.abs() > way.y.abs() { way.x > 0.0 } else { way.y > 0.0 }
    };
    if runs_on { 1.0 } else { -1.0 }
}

/// Thins the ends of an open axis that are to be tapered, over a length: (2 - t) t of the width, t from 0 at
/// the end to 1. Lines shorter than that are thinner throughout, as they would be dots.
pub(crate) fn taper(axis: &Axis, widths: &mut [f64], ends: [bool; 2], over: f64, to: f64, least: f64) {
    let (Some(first), Some(last)) = (axis.arcs.first(), axis.arcs.last()) else { return };
    let count = ends.iter().filter(|end| **end).count();
    let total = last - first;
    if count == 0 || over <= 0.0 || total <= 0.0 {
        return;
    }
    let eased = |t: f64| to + (1.0 - to) * t * (2.0 - t);
    let whole = eased((total / over).min(1.0));
    let over = over.min(total / count as f64);
    widths.iter_mut().for_each(|width| *width *= whole);
    let part = |way: f64| eased((way / over).clamp(0.0, 1.0));
    for (width, arc) in widths.iter_mut().zip(&axis.arcs) {
        for (end, way) in [(ends[0], arc - first), (ends[1], last - arc)] {
            if end {
                *width *= part(way);
            }
        }
        *width = width.max(least);
    }
}

/// Brings the ends of a line that go on in others half-way to the widths of these.
pub(crate) fn meet(axis: &Axis, widths: &mut [f64], others: [Option<f64>; 2], px: f64) {
    let (Some(first), Some(last)) = (axis.arcs.first(), axis.arcs.last()) else { return };
    let over = (MEET_PX * px).min((last - first) / 2.0);
    let (Some(start), Some(end)) = (widths.first().copied(), widths.last().copied()) else { return };
    if over <= 0.0 {
        return;
    }
    for (width, arc) in widths.iter_mut().zip(&axis.arcs) {
        for (other, own, way) in [(others[0], start, arc - first), (others[1], end, last - arc)] {
            let t = (1.0 - way / over).max(0.0);
            *width += other.map_or(0.0, |other| (other - own) / 2.0 * t * t * (3.0 - 2.0 * t));
        }
    }
}

/// The mean of widths along an axis.
pub(crate) fn mean(axis: &Axis, widths: &[f64]) -> f64 {
    let pairs = widths.windows(2).zip(axis.arcs.windows(2));
    let area: f64 = pairs.map(|(w, a)| (w[0] + w[1]) / 2.0 * (a[1] - a[0])).sum();
    area / axis.length().max(f64::MIN_POSITIVE)
}

/// Values evened out by two running means; at the ends of an open line the window shrinks, so that
/// the ends stay.
fn even(values: &[f64], closed: bool, window: usize) -> Vec<f64> {
    let n = values.len();
    let mut even = values.to_vec();
    for _ in 0..2 {
        // Closed lines repeat their first point.
        let ring = n - 1;
        let mut sums = vec![0.0; n + 1];
        for i in 0..n {
            sums[i + 1] = sums[i] + even[i];
        }
        let mean = |i: usize| {
            if closed {
                let reach = (window / 2).min(ring / 2);
                let ids = (0..=2 * reach).map(|k| (i + ring + k - reach) % ring);
                ids.map(|k| even[k]).sum::<f64>() / (2 * reach + 1) as f64
            } else {
                let reach = (window / 2).min(i).min(n - 1 - i);
                (sums[i + reach + 1] - sums[i - reach]) / (2 * reach + 1) as f64
            }
        };
        even = (0..n).map(mean).collect();
    }
    even
}
