//! Widths of a line at every point of its axis: the pen's width times swell and fade.

use kurbo::Vec2;

use super::swell::Swell;
use crate::geometry::plane::planar_distance::{length, unit};
use crate::strokes::axes::stroke_axis::StrokeAxis;

/// Window for smoothing widths, px.
const SMOOTHING_PX: f64 = 10.0;

/// Length to either side for measuring bends, px.
const BEND_REACH_PX: f64 = 5.0;

/// Window for smoothing bends, px, so that the width does not follow every small wiggle.
const BEND_SMOOTHING_PX: f64 = 24.0;

/// Length of the blend between joined lines of different widths, px.
const JOIN_BLEND_PX: f64 = 16.0;

/// Least width of a line of varying width, px.
const MIN_WIDTH_PX: f64 = 0.12;

/// Extra width of lines that border painted surfaces, on top of the border that they cover, px.
const COVER_MARGIN_PX: f64 = 0.1;

/// Inputs of the width, besides the line itself.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WidthSettings {
    /// Width of the pen, user units.
    pub width: f64,
    /// Share of the width lost where strength is 0.
    pub fade: f64,
    pub swell: Swell,
    /// User units in a px.
    pub px: f64,
    /// Depths that count as near and far.
    pub depths: [f64; 2],
    /// Bend radius where bends have half their effect, user units.
    pub bend_radius: f64,
    /// Random factor of the line's width.
    pub chance: f64,
    /// Distance to either side that the line must cover on the border of paint, user units.
    pub covers: Option<f64>,
}

impl WidthSettings {
    /// The least width of a line.
    pub(crate) fn least(&self) -> f64 {
        let least =
            self.covers.map_or(MIN_WIDTH_PX * self.px, |to_side| 2.0 * to_side + COVER_MARGIN_PX * self.px);
        least.min(self.width)
    }
}

/// Widths from strength alone.
pub(crate) fn faded(axis: &StrokeAxis, width: f64, fade: f64) -> Vec<f64> {
    let strengths: Vec<f64> = axis.samples.iter().map(|sample| sample.strength).collect();
    let strengths = even(&strengths, axis.closed, SMOOTHING_PX as usize);
    strengths.iter().map(|s| width * (1.0 - fade * (1.0 - s))).collect()
}

/// The width at each point of an axis, before its ends are tapered.
pub(crate) fn widths(axis: &StrokeAxis, setting: &WidthSettings) -> Vec<f64> {
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
    let mut factors = even(&(0..n).map(factor).collect::<Vec<f64>>(), axis.closed, SMOOTHING_PX as usize);
    if swell.bend > 0.0 {
        for (factor, bend) in factors.iter_mut().zip(bends(axis, setting)) {
            *factor *= 1.0 + swell.bend * bend;
        }
    }
    factors.iter().map(|factor| (setting.width * factor).max(setting.least())).collect()
}

/// Bend of each point out of the shape, -1 to 1: x/(1 + |x|), where x is curvature times the radius of half
/// effect.
fn bends(axis: &StrokeAxis, setting: &WidthSettings) -> Vec<f64> {
    let n = axis.len();
    let reach = BEND_REACH_PX as isize;
    let curvature = |i: usize| {
        let (first, last) = axis.stretch(i);
        let k = i as isize;
        let (before, after) = ((k - reach).max(first), (k + reach).min(last));
        if before >= k || after <= k {
            return 0.0;
        }
        let (p, q, r) = (axis.point(before), axis.point(k), axis.point(after));
        let (from, to): (Vec2, Vec2) = (q - p, r - q);
        // The page's y points down, so a turn to the right is positive. The curvature is that of the circle
        // through the three points: twice the sine of the turn between chords, divided by their span.
        let way = length(r - p).max(f64::MIN_POSITIVE);
        2.0 * unit(from).cross(unit(to)) / way
    };
    let curvatures =
        even(&(0..n).map(curvature).collect::<Vec<f64>>(), axis.closed, BEND_SMOOTHING_PX as usize);
    let sides: Vec<f64> = axis.samples.iter().map(|sample| sample.side).collect();
    let sides = even(&sides, axis.closed, BEND_SMOOTHING_PX as usize);
    let hand = handedness(axis);
    let bend = |(curvature, side): (f64, f64)| {
        // With the shape on the right, a line that bulges outwards turns to the right.
        let outward = if side.abs() > 0.3 { -side.signum() * side.abs().min(1.0) } else { hand };
        let x = curvature * outward * setting.bend_radius;
        x / (1.0 + x.abs())
    };
    curvatures.into_iter().zip(sides).map(bend).collect()
}

/// Assumed drawing direction for lines with no nearer side: 1 if the axis runs that way, -1 if it runs
/// backwards.
///
/// Lines are drawn left to right or top to bottom, and closed ones clockwise, as by a right-handed artist.
/// The right side counts as outside.
fn handedness(axis: &StrokeAxis) -> f64 {
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

/// Tapers the ends of an open axis over the length `over`. The width is multiplied by a factor that rises
/// from `to` at the end to 1, as (2 - t) t for t from 0 to 1. Shorter lines are thinner throughout, so that
/// they do not become dots.
pub(crate) fn taper(
    axis: &StrokeAxis,
    widths: &mut [f64],
    ends: [bool; 2],
    over: f64,
    to: f64,
    min_width: f64,
) {
    let (Some(first), Some(last)) = (axis.arcs.first(), axis.arcs.last()) else { return };
    let count = ends.iter().filter(|end| **end).count();
    let total = last - first;
    if count == 0 || over <= 0.0 || total <= 0.0 {
        return;
    }
    let eased = |t: f64| to + (1.0 - to) * t * (2.0 - t);
    let overall_factor = eased((total / over).min(1.0));
    let over = over.min(total / count as f64);
    widths.iter_mut().for_each(|width| *width *= overall_factor);
    let part = |distance: f64| eased((distance / over).clamp(0.0, 1.0));
    for (width, arc) in widths.iter_mut().zip(&axis.arcs) {
        for (end, end_distance) in [(ends[0], arc - first), (ends[1], last - arc)] {
            if end {
                *width *= part(end_distance);
            }
        }
        *width = width.max(min_width);
    }
}

/// Blends the ends of a line half-way towards the widths of the lines that continue there.
pub(crate) fn meet(axis: &StrokeAxis, widths: &mut [f64], others: [Option<f64>; 2], px: f64) {
    let (Some(first), Some(last)) = (axis.arcs.first(), axis.arcs.last()) else { return };
    let over = (JOIN_BLEND_PX * px).min((last - first) / 2.0);
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
pub(crate) fn mean(axis: &StrokeAxis, widths: &[f64]) -> f64 {
    let pairs = widths.windows(2).zip(axis.arcs.windows(2));
    let area: f64 = pairs.map(|(w, a)| (w[0] + w[1]) / 2.0 * (a[1] - a[0])).sum();
    area / axis.length().max(f64::MIN_POSITIVE)
}

/// Smooths values with two running means. At the ends of an open line the window shrinks, so the end values
/// stay.
fn even(values: &[f64], closed: bool, window: usize) -> Vec<f64> {
    let n = values.len();
    let mut even = values.to_vec();
    for _ in 0..2 {
        // Closed lines repeat their first point at the end.
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
