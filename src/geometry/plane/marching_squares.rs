//! [`level_lines`]: where numbers on a square grid, bilinear in between, pass through 0.
//!
//! Source: Lorensen and Cline, "Marching cubes", SIGGRAPH 1987, in two dimensions; cells with two diagonals as Nielson
//! and Hamann, "The asymptotic decider", 1991.

use glam::DVec2;
use rustc_hash::{FxHashMap, FxHashSet};

/// A side between neighbouring points of the grid: the column and row of the first, and whether the second lies below it.
type Side = (u32, u32, bool);

/// The lines in the cells between so many points a row and rows of them and their neighbours, end to end, with what is above 0 on
/// their left (x to the right, y upwards). `straight` is how far, as part of its length, a piece of a line may be from the
/// curve. None if the grid passes through 0 more often than `most` times.
pub fn level_lines(
    value: &impl Fn(i64, i64) -> f64,
    [columns, rows]: [usize; 2],
    straight: f64,
    most: usize,
) -> Option<Vec<Vec<DVec2>>> {
    let mut next: FxHashMap<Side, Side> = FxHashMap::default();
    let mut starts: Vec<Side> = Vec::new();
    let mut above: Vec<f64> = (0..=columns as i64).map(|i| value(i, 0)).collect();
    for j in 0..rows as u32 {
        let below: Vec<f64> = (0..=columns as i64).map(|i| value(i, i64::from(j) + 1)).collect();
        for i in 0..columns as u32 {
            let k = i as usize;
            let corners = [above[k], above[k + 1], below[k + 1], below[k]];
            let is_in = corners.map(|value| value > 0.0);
            if is_in == [is_in[0]; 4] {
                continue;
            }
            let sides = [(i, j, false), (i + 1, j, true), (i, j + 1, false), (i, j, true)];
            // Round the cell: where it is left, and where it is entered again.
            let leaves = (0..4).filter(|s| is_in[*s] && !is_in[(*s + 1) % 4]);
            let [a, b, c, d] = corners;
            // The value where the bilinear number has its saddle.
            let joined = (a * c - b * d) / (a + c - b - d) >= 0.0;
            for leave in leaves {
                let enters = |s: &usize| !is_in[*s % 4] && is_in[(*s + 1) % 4];
                // Where the saddle is above 0 the next entry ahead belongs to the other corner.
                let enter = match joined {
                    true => (leave + 1..leave + 4).find(enters),
                    false => (leave + 1..leave + 4).rev().find(enters),
                };
                if let Some(enter) = enter {
                    next.insert(sides[leave], sides[enter % 4]);
                    starts.push(sides[leave]);
                }
            }
        }
        above = below;
        if starts.len() > most {
            return None;
        }
    }
    let point = |(i, j, down): Side| {
        let (a, b) =
            (value(i.into(), j.into()), value((i + u32::from(!down)).into(), (j + u32::from(down)).into()));
        let part = a / (a - b);
        DVec2::new(f64::from(i), f64::from(j)) + if down { DVec2::Y } else { DVec2::X } * part
    };
    // Open lines begin where nothing leads to.
    let led_to: FxHashSet<Side> = next.values().copied().collect();
    let (open, closed): (Vec<Side>, Vec<Side>) = starts.into_iter().partition(|side| !led_to.contains(side));
    let mut lines = Vec::new();
    for start in open.into_iter().chain(closed) {
        let mut line = Vec::new();
        let mut at = start;
        while let Some(to) = next.remove(&at) {
            line.push(point(at));
            curve(value, point(at), point(to), straight, &mut line);
            at = to;
        }
        if !line.is_empty() {
            line.push(point(at));
            lines.push(line);
        }
    }
    Some(lines)
}

/// Adds points of a line on its way through a cell, where it is a piece of a hyperbola.
fn curve(value: &impl Fn(i64, i64) -> f64, from: DVec2, to: DVec2, straight: f64, line: &mut Vec<DVec2>) {
    let low = ((from + to) / 2.0).floor();
    let (i, j) = (low.x as i64, low.y as i64);
    let [a, b, c, d] = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(x, y)| value(i + x, j + y));
    let twist = a - b - c + d;
    // The line is where the product of the distances from the axes is `product`.
    let axes = low - DVec2::new(c - a, b - a) / twist;
    let product = ((b - a) * (c - a) / twist - a) / twist;
    if axes.is_finite() && product.is_finite() && (from.x - axes.x) * (to.x - axes.x) > 0.0 {
        bend(axes, product, [from, to], straight, line);
    }
}

/// Adds points of a hyperbola between two of its points until what is left between them is all but straight.
fn bend(axes: DVec2, product: f64, [from, to]: [DVec2; 2], straight: f64, line: &mut Vec<DVec2>) {
    let x = ((from.x - axes.x) * (to.x - axes.x)).sqrt().copysign(from.x - axes.x);
    let middle = axes + DVec2::new(x, product / x);
    let way = to - from;
    let off = way.perp_dot(middle - from).abs();
    if off > straight * way.length() && way.length_squared() > straight * straight {
        bend(axes, product, [from, middle], straight, line);
        line.push(middle);
        bend(axes, product, [middle, to], straight, line);
    }
}
