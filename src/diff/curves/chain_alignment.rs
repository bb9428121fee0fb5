//! Correspondence of the points of two chains, and the motion between them.

use kurbo::{Point, Vec2};

use super::chain::OutlineChain;
use super::hausdorff_distance::evenly_spaced_points;
use super::segment::nearest_on;

/// Fewest points compared along each chain. The number is about two per vertex, within bounds.
const MIN_SAMPLES: usize = 5;
/// Most points compared along each chain.
const MAX_SAMPLES: usize = 33;

/// Distances of two chains whose points correspond by arc length, in px.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Alignment {
    /// Largest distance of corresponding points: an upper bound of the Fréchet distance.
    pub largest: f64,
    /// Mean shift from the first chain to the second.
    pub shift: Vec2,
    /// Largest distance that remains after the shift.
    pub after_shift: f64,
    /// Largest distance that remains after the best similarity (shift, rotation and scale).
    pub after_similarity: f64,
}

/// Aligns two chains so that the largest distance is smallest, over both directions and several starts.
/// Swapping the chains only changes signs.
pub(crate) fn align(a: &OutlineChain, b: &OutlineChain) -> Alignment {
    let count = (a.points.len().max(b.points.len()) * 2 - 1).clamp(MIN_SAMPLES, MAX_SAMPLES);
    let on_a: Vec<Point> = evenly_spaced_points(a, count).collect();
    let on_b: Vec<Point> = evenly_spaced_points(b, count).collect();
    let mut best: Option<Alignment> = None;
    let mut try_alignment = |a: &[Point], b: &[Point]| {
        let candidate = measure(a, b);
        if best.is_none_or(|best| candidate.largest + candidate.after_shift < best.largest + best.after_shift)
        {
            best = Some(candidate);
        }
    };
    if a.closed && b.closed {
        // Closed chains have no fixed start: try their least point, and the point nearest to the start of the
        // other chain.
        let turned_b = on_a.first().map_or_else(|| on_b.clone(), |start| from_nearest(b, *start, count));
        let turned_a = on_b.first().map_or_else(|| on_a.clone(), |start| from_nearest(a, *start, count));
        for (a, b) in [(&on_a, &on_b), (&on_a, &turned_b), (&turned_a, &on_b)] {
            try_alignment(a, b);
            try_alignment(a, &reversed(b));
        }
    } else {
        try_alignment(&on_a, &on_b);
        try_alignment(&on_a, &reversed(&on_b));
    }
    best.unwrap_or(Alignment { largest: 0.0, shift: Vec2::ZERO, after_shift: 0.0, after_similarity: 0.0 })
}

fn reversed(points: &[Point]) -> Vec<Point> {
    points.iter().rev().copied().collect()
}

/// Evenly spaced points along a closed chain, starting at its point nearest to `start`.
fn from_nearest(chain: &OutlineChain, start: Point, count: usize) -> Vec<Point> {
    let nearest = chain
        .segments()
        .enumerate()
        .map(|(index, (p, q))| {
            (start.distance_squared(nearest_on(p, q, start)), index, nearest_on(p, q, start))
        })
        .min_by(|a, b| a.0.total_cmp(&b.0));
    let Some((_, index, point)) = nearest else { return evenly_spaced_points(chain, count).collect() };
    let mut points = vec![point];
    points.extend_from_slice(&chain.points[index + 1..]);
    points.extend(chain.points.iter().skip(1).take(index));
    points.push(point);
    evenly_spaced_points(&OutlineChain { points, ..chain.clone() }, count).collect()
}

/// Distances of two point lists of equal length, before and after the best motions.
fn measure(a: &[Point], b: &[Point]) -> Alignment {
    let count = a.len().min(b.len()).max(1) as f64;
    let mean =
        |points: &[Point]| points.iter().map(|p| p.to_vec2()).fold(Vec2::ZERO, |sum, v| sum + v) / count;
    let (mean_a, mean_b) = (mean(a), mean(b));
    let shift = mean_b - mean_a;
    // Points as complex numbers: b - mean_b = turn (a - mean_a), with `turn` by least squares.
    let (mut turn, mut squared_size) = (Vec2::ZERO, 0.0);
    for (p, q) in a.iter().zip(b) {
        let (p, q) = (p.to_vec2() - mean_a, q.to_vec2() - mean_b);
        turn += Vec2::new(p.dot(q), p.cross(q));
        squared_size += p.hypot2();
    }
    let turn = if squared_size > 0.0 { turn / squared_size } else { Vec2::new(1.0, 0.0) };
    let mut alignment = Alignment { largest: 0.0, shift, after_shift: 0.0, after_similarity: 0.0 };
    for (p, q) in a.iter().zip(b) {
        let displacement = *q - *p;
        let offset_from_mean = p.to_vec2() - mean_a;
        let turned = Vec2::new(
            offset_from_mean.x * turn.x - offset_from_mean.y * turn.y,
            offset_from_mean.x * turn.y + offset_from_mean.y * turn.x,
        );
        alignment.largest = alignment.largest.max(displacement.hypot());
        alignment.after_shift = alignment.after_shift.max((displacement - shift).hypot());
        alignment.after_similarity = alignment.after_similarity.max((q.to_vec2() - mean_b - turned).hypot());
    }
    alignment
}

#[cfg(test)]
mod tests {
    use kurbo::Affine;

    use super::*;

    fn chain(points: &[(f64, f64)], closed: bool) -> OutlineChain {
        let points = points.iter().map(|p| Point::from(*p)).collect();
        OutlineChain { group: 0, points, closed, shapes: Vec::new() }
    }

    fn reversed_and_moved(chain: &OutlineChain, motion: Affine) -> OutlineChain {
        OutlineChain { points: chain.points.iter().rev().map(|p| motion * *p).collect(), ..chain.clone() }
    }

    #[test]
    fn align_finds_translations_and_rotations() {
        let open = chain(&[(0.0, 0.0), (40.0, 10.0), (60.0, 40.0)], false);
        let closed = chain(&[(0.0, 0.0), (40.0, 0.0), (40.0, 30.0), (0.0, 0.0)], true);
        for chain in [open, closed] {
            let shifted = align(&chain, &reversed_and_moved(&chain, Affine::translate((3.0, 4.0))));
            assert!((shifted.shift - Vec2::new(3.0, 4.0)).hypot() < 0.5, "{shifted:?}");
            assert!(!chain.closed || shifted.after_shift < 6.0);
            let turned = align(&chain, &reversed_and_moved(&chain, Affine::rotate(0.02)));
            assert!(turned.after_similarity < 0.2 * turned.largest.max(1.0), "{turned:?}");
        }
    }
}
