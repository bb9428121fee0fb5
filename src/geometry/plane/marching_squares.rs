//! [`marching_squares`]: traces the zero lines of a bilinearly interpolated grid as polylines.
//!
//! Source: Lorensen and Cline, "Marching cubes", SIGGRAPH 1987, in two dimensions. Cells with four crossings
//! are resolved as in Nielson and Hamann, "The asymptotic decider", 1991.

use glam::DVec2;
use rustc_hash::{FxHashMap, FxHashSet};

/// Edge between neighbouring grid points: column and row of the first, and whether the second is below it.
type GridEdge = (u32, u32, bool);

/// Traces the zero lines of `value` in a grid of `columns` by `rows` cells. Returns polylines in grid units;
/// the last point of a closed one repeats the first.
///
/// Positive values are on the left of a line (x to the right, y upwards). Where a line is curved it gets
/// extra points, until the deviation from the exact hyperbola is at most `straight` times the length of a
/// segment. Returns `None` if the grid has more than `most` crossings.
pub(crate) fn marching_squares(
    value: &impl Fn(i64, i64) -> f64,
    [columns, rows]: [usize; 2],
    straight: f64,
    most: usize,
) -> Option<Vec<Vec<DVec2>>> {
    let mut next: FxHashMap<GridEdge, GridEdge> = FxHashMap::default();
    let mut starts: Vec<GridEdge> = Vec::new();
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
            // Pair each exit of the cell's contour with the entry that continues it.
            let leaves = (0..4).filter(|s| is_in[*s] && !is_in[(*s + 1) % 4]);
            let [a, b, c, d] = corners;
            // The sign of the bilinear function at its saddle decides which corners are connected.
            let joined = (a * c - b * d) / (a + c - b - d) >= 0.0;
            for leave in leaves {
                let enters = |s: &usize| !is_in[*s % 4] && is_in[(*s + 1) % 4];
                // If the saddle is positive, the next entry in order belongs to the other corner.
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
    let point = |(i, j, down): GridEdge| {
        let (a, b) =
            (value(i.into(), j.into()), value((i + u32::from(!down)).into(), (j + u32::from(down)).into()));
        let part = a / (a - b);
        DVec2::new(f64::from(i), f64::from(j)) + if down { DVec2::Y } else { DVec2::X } * part
    };
    // Open lines start at an edge that no other edge leads to. The rest are closed.
    let led_to: FxHashSet<GridEdge> = next.values().copied().collect();
    let (open, closed): (Vec<GridEdge>, Vec<GridEdge>) =
        starts.into_iter().partition(|side| !led_to.contains(side));
    let mut lines = Vec::new();
    for start in open.into_iter().chain(closed) {
        let mut line = Vec::new();
        let mut at = start;
        while let Some(to) = next.remove(&at) {
            line.push(point(at));
            flatten_hyperbola(value, point(at), point(to), straight, &mut line);
            at = to;
        }
        if !line.is_empty() {
            line.push(point(at));
            lines.push(line);
        }
    }
    Some(lines)
}

/// Adds points of the hyperbola arc between two crossings of a cell.
fn flatten_hyperbola(
    value: &impl Fn(i64, i64) -> f64,
    from: DVec2,
    to: DVec2,
    straight: f64,
    line: &mut Vec<DVec2>,
) {
    let low = ((from + to) / 2.0).floor();
    let (i, j) = (low.x as i64, low.y as i64);
    let [a, b, c, d] = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(x, y)| value(i + x, j + y));
    let twist = a - b - c + d;
    // On a zero line, the product of the coordinates relative to the asymptotes is constant.
    let axes = low - DVec2::new(c - a, b - a) / twist;
    let product = ((b - a) * (c - a) / twist - a) / twist;
    if axes.is_finite() && product.is_finite() && (from.x - axes.x) * (to.x - axes.x) > 0.0 {
        bend(axes, product, [from, to], straight, line);
    }
}

/// Subdivides a hyperbola arc until each segment is straight enough.
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
