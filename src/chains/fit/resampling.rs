//! Resamples a line at even spacing.

use crate::chains::sampled_line::SampledLine;
use crate::geometry::plane::planar_distance::length;

/// Evenly spaced points at most `spacing` apart, ends included. Returns the line and its actual spacing.
///
/// A closed line keeps its first point.
pub(crate) fn resample(line: &SampledLine, spacing: f64) -> (SampledLine, f64) {
    let n = line.len();
    let sides = if line.closed { n } else { n.saturating_sub(1) };
    let lengths: Vec<f64> = (0..sides).map(|i| length(line.points[(i + 1) % n] - line.points[i])).collect();
    let total: f64 = lengths.iter().sum();
    if n < 2 || total <= 0.0 {
        return (line.clone(), spacing);
    }
    let least = if line.closed { 3 } else { 1 };
    let count = ((total / spacing).ceil() as usize).max(least);
    let step = total / count as f64;
    let last = if line.closed { count } else { count + 1 };
    let mut even = SampledLine {
        points: Vec::with_capacity(last),
        samples: Vec::with_capacity(last),
        sides: Vec::with_capacity(last),
        closed: line.closed,
    };
    let (mut side, mut before) = (0, 0.0);
    for k in 0..last {
        let at = step * k as f64;
        while side + 1 < sides && before + lengths[side] < at {
            before += lengths[side];
            side += 1;
        }
        let (i, j) = (side, (side + 1) % n);
        let t = if lengths[side] > 0.0 { ((at - before) / lengths[side]).clamp(0.0, 1.0) } else { 0.0 };
        even.points.push(line.points[i].lerp(line.points[j], t));
        even.samples.push(line.samples[i].lerp(line.samples[j], t));
        even.sides.push(line.sides[i]);
    }
    if !line.closed {
        // The last point stays exact to the bit.
        if let (Some(to), Some(from)) = (even.points.last_mut(), line.points.last()) {
            *to = *from;
        }
    }
    (even, step)
}
