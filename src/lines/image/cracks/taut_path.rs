//! Taut path: the shortest line through a sequence of gates (funnel algorithm).
//!
//! A line in the image is known to pass between two pixel centres at each crack. Of all such lines the
//! shortest has no bend without a reason in the image: a straight edge gives a straight line at any angle.
//! Source: Lee and Preparata, Euclidean shortest paths in the presence of rectilinear barriers, Networks
//! 1984.

use glam::DVec2;

/// Gate: its left and right end, seen along the path.
pub(crate) type Gate = [DVec2; 2];

/// Bend of a taut path, and the number of gates before it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TautBend {
    pub at: DVec2,
    pub gate: usize,
}

/// Shortest line from `start` through the gates to `end`, as its bends. Both ends are included.
pub(crate) fn shortest_path(start: DVec2, gates: &[Gate], end: DVec2) -> Vec<TautBend> {
    let mut bends = vec![TautBend { at: start, gate: 0 }];
    let gate = |i: usize| if i < gates.len() { gates[i] } else { [end, end] };
    // Tip of the funnel, its two sides, and the gates that last moved these.
    let mut tip = start;
    let [mut left, mut right] = gate(0);
    let (mut left_at, mut right_at) = (0, 0);
    let mut i = 1;
    while i <= gates.len() {
        let [to_left, to_right] = gate(i);
        // The right side narrows the funnel, or crosses the left side.
        if turn(tip, right, to_right) <= 0.0 {
            if tip == right || turn(tip, left, to_right) > 0.0 {
                (right, right_at) = (to_right, i);
            } else {
                (tip, i) = (left, left_at);
                bends.push(TautBend { at: tip, gate: left_at });
                (left, right, left_at, right_at) = (tip, tip, i, i);
                i += 1;
                continue;
            }
        }
        if turn(tip, left, to_left) >= 0.0 {
            if tip == left || turn(tip, right, to_left) < 0.0 {
                (left, left_at) = (to_left, i);
            } else {
                (tip, i) = (right, right_at);
                bends.push(TautBend { at: tip, gate: right_at });
                (left, right, left_at, right_at) = (tip, tip, i, i);
                i += 1;
                continue;
            }
        }
        i += 1;
    }
    bends.push(TautBend { at: end, gate: gates.len() });
    bends.dedup_by(|later, first| later.at == first.at);
    bends
}

/// Twice the signed area of a triangle: positive if c is on the right of the line from a to b, with y down.
fn turn(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).perp_dot(c - a)
}

/// Points where a taut path crosses each gate.
pub(crate) fn crossings(bends: &[TautBend], gates: &[Gate]) -> Vec<DVec2> {
    let mut piece = 0;
    let mut crossings = Vec::with_capacity(gates.len());
    for (i, [left, right]) in gates.iter().enumerate() {
        while piece + 2 < bends.len() && bends[piece + 1].gate < i {
            piece += 1;
        }
        let (a, b) = (bends[piece].at, bends[(piece + 1).min(bends.len() - 1)].at);
        let (along, across) = (b - a, *right - *left);
        let area = across.perp_dot(along);
        let t = if area == 0.0 { 0.5 } else { ((a - *left).perp_dot(along) / area).clamp(0.0, 1.0) };
        crossings.push(*left + across * t);
    }
    crossings
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Gates at x = 0, 1, 2 … between the given heights.
    fn gates(heights: &[[f64; 2]]) -> Vec<Gate> {
        heights
            .iter()
            .enumerate()
            .map(|(i, [left, right])| [DVec2::new(i as f64, *left), DVec2::new(i as f64, *right)])
            .collect()
    }

    #[test]
    fn shortest_path_along_a_staircase_is_almost_straight() {
        let steps: Vec<[f64; 2]> =
            (0..40).map(|i| (f64::from(i) * 0.3).floor()).map(|y| [y - 0.5, y + 0.5]).collect();
        let bends = shortest_path(DVec2::new(-1.0, -0.3), &gates(&steps), DVec2::new(40.0, 11.7));
        assert!(bends.len() <= 4, "{bends:?}");
        let length: f64 = bends.windows(2).map(|pair| pair[0].at.distance(pair[1].at)).sum();
        assert!(length < DVec2::new(41.0, 12.0).length() + 0.02);
    }

    #[test]
    fn shortest_path_bends_only_at_obstacles() {
        let bends =
            shortest_path(DVec2::ZERO, &gates(&[[-1.0, 1.0], [1.0, 2.0], [-1.0, 1.0]]), DVec2::new(3.0, 0.0));
        let at: Vec<[f64; 2]> = bends.iter().map(|bend| bend.at.to_array()).collect();
        assert_eq!(at, [[0.0, 0.0], [1.0, 1.0], [3.0, 0.0]]);
        assert_eq!(bends[1].gate, 1);
        let through = crossings(&bends, &gates(&[[-1.0, 1.0], [1.0, 2.0], [-1.0, 1.0]]));
        assert_eq!(through, [DVec2::ZERO, DVec2::new(1.0, 1.0), DVec2::new(2.0, 0.5)]);
    }

    #[test]
    fn shortest_path_is_as_short_as_a_relaxed_path() {
        // Reference by relaxation: each crossing moves repeatedly to the midpoint of its neighbours.
        let mut state = 7_u64;
        let mut chance = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as f64 / f64::from(1_u32 << 31)
        };
        for _ in 0..50 {
            let heights: Vec<[f64; 2]> =
                (0..30).map(|_| chance() * 6.0).map(|low| [low, low + 0.5]).collect();
            let gates = gates(&heights);
            let (start, end) = (DVec2::new(-1.0, 3.0), DVec2::new(30.0, 3.0));
            let bends = shortest_path(start, &gates, end);
            let length: f64 = bends.windows(2).map(|pair| pair[0].at.distance(pair[1].at)).sum();
            let mut ys: Vec<f64> = heights.iter().map(|[a, b]| f64::midpoint(*a, *b)).collect();
            for _ in 0..20_000 {
                for i in 0..ys.len() {
                    let before = if i > 0 { ys[i - 1] } else { start.y };
                    let behind = ys.get(i + 1).copied().unwrap_or(end.y);
                    ys[i] = f64::midpoint(before, behind).clamp(heights[i][0], heights[i][1]);
                }
            }
            let mut points = vec![start];
            points.extend(ys.iter().enumerate().map(|(i, y)| DVec2::new(i as f64, *y)));
            points.push(end);
            let relaxed: f64 = points.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
            assert!((length - relaxed).abs() < 1e-3 * relaxed, "{length} {relaxed}");
        }
    }
}
