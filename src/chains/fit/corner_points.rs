//! Corner detection on jagged lines: where a line turns lastingly, and not only from one triangle to the
//! next.

use crate::geometry::plane::planar_distance::length;
use kurbo::{Point, Vec2};

/// Cosine of the smallest turn of a corner (45 degrees) over the whole window.
const MAX_WINDOW_COSINE: f64 = 0.707;

/// Cosine of the smallest turn of a corner (40 degrees) over half the window. A tight bend turns less there.
const MAX_HALF_WINDOW_COSINE: f64 = 0.766;

/// Indices of the corners among points `spacing` apart, measured over `window`. The ends of an open line are
/// excluded.
pub(crate) fn corners(points: &[Point], closed: bool, spacing: f64, window: f64) -> Vec<usize> {
    let n = points.len();
    let wide = ((window / spacing).round() as usize).max(1);
    let narrow = (wide / 2).max(1);
    if n < 2 * narrow + 1 {
        return Vec::new();
    }
    let turns: Vec<f64> = (0..n).map(|i| cosine(points, closed, i, wide)).collect();
    let mut found = Vec::new();
    for i in 0..n {
        if turns[i] > MAX_WINDOW_COSINE || cosine(points, closed, i, narrow) > MAX_HALF_WINDOW_COSINE {
            continue;
        }
        // Non-maximum suppression: only the sharpest point within a window is a corner.
        let sharpest = (1..=wide).all(|k| {
            let before = neighbour(n, closed, i, -(k as isize));
            let after = neighbour(n, closed, i, k as isize);
            before.is_none_or(|j| turns[i] < turns[j]) && after.is_none_or(|j| turns[i] <= turns[j])
        });
        if sharpest {
            found.push(i);
        }
    }
    found
}

/// Cosine of the turn between the chords to the points `reach` before and after.
fn cosine(points: &[Point], closed: bool, i: usize, reach: usize) -> f64 {
    let n = points.len();
    let reach = reach as isize;
    // Near the ends of an open line chords are shorter, down to half the window.
    let step = (1..=reach)
        .rev()
        .take_while(|k| 2 * k >= reach)
        .find(|k| neighbour(n, closed, i, *k).is_some() && neighbour(n, closed, i, -k).is_some());
    let Some(step) = step else { return 1.0 };
    let (Some(back), Some(ahead)) = (neighbour(n, closed, i, -step), neighbour(n, closed, i, step)) else {
        return 1.0;
    };
    let (a, b): (Vec2, Vec2) = (points[i] - points[back], points[ahead] - points[i]);
    let lengths = length(a) * length(b);
    if lengths > 0.0 { a.dot(b) / lengths } else { -1.0 }
}

fn neighbour(n: usize, closed: bool, i: usize, step: isize) -> Option<usize> {
    let j = i as isize + step;
    if closed {
        Some(j.rem_euclid(n as isize) as usize)
    } else {
        (0..n as isize).contains(&j).then_some(j as usize)
    }
}
