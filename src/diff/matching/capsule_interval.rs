//! Interval of a segment within a distance of another segment.
//!
//! The points within `r` of a segment form its capsule: two discs and the rectangle between them. The capsule
//! is convex, so the points of another segment inside it form one interval. Its ends are roots of quadratics
//! or crossings with the sides of the rectangle.

use kurbo::Point;

/// Share of the segment `p`–`q` within distance `r` of the segment `a`–`b`, as parameters 0 to 1.
pub(crate) fn within(p: Point, q: Point, a: Point, b: Point, r: f64) -> Option<(f64, f64)> {
    let along = q - p;
    let mut found: Option<(f64, f64)> = None;
    let mut add = |from: f64, to: f64| {
        let (from, to) = (from.max(0.0), to.min(1.0));
        if from <= to {
            found = Some(found.map_or((from, to), |(low, high)| (low.min(from), high.max(to))));
        }
    };
    let length2 = along.hypot2();
    for centre in [a, b] {
        let offset = p - centre;
        if length2 == 0.0 {
            if offset.hypot2() <= r * r {
                add(0.0, 1.0);
            }
            continue;
        }
        let half = along.dot(offset);
        let root2 = half * half - length2 * (offset.hypot2() - r * r);
        if root2 >= 0.0 {
            let root = root2.sqrt();
            add((-half - root) / length2, (-half + root) / length2);
        }
    }
    // The rectangle between the two discs is the intersection of two strips.
    let axis = b - a;
    let size = axis.hypot();
    if size > 0.0 {
        let unit = axis / size;
        let offset = p - a;
        let across = clip(offset.cross(unit), along.cross(unit), -r, r);
        let lengthwise = clip(offset.dot(unit), along.dot(unit), 0.0, size);
        if let Some(((f0, t0), (f1, t1))) = across.zip(lengthwise)
            && f0.max(f1) <= t0.min(t1)
        {
            add(f0.max(f1), t0.min(t1));
        }
    }
    found
}

/// Interval of `t` for which `start + t * rate` is between two bounds.
fn clip(start: f64, rate: f64, low: f64, high: f64) -> Option<(f64, f64)> {
    if rate == 0.0 {
        return (low..=high).contains(&start).then_some((f64::NEG_INFINITY, f64::INFINITY));
    }
    let (t0, t1) = ((low - start) / rate, (high - start) / rate);
    Some((t0.min(t1), t0.max(t1)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diff::curves::segment::nearest_on;

    #[test]
    fn capsule_interval_matches_dense_sampling() {
        let mut state = 5u64;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f64 / f64::from(1u32 << 24)
        };
        let mut hits = 0;
        for _ in 0..2000 {
            let mut point = || Point::new(next() * 4.0, next() * 4.0);
            let (p, q, a, b) = (point(), point(), point(), point());
            let inside = |t: f64| {
                let at = p.lerp(q, t);
                at.distance(nearest_on(a, b, at)) <= 0.5
            };
            let sampled: Vec<f64> =
                (0..=1000).map(|i| f64::from(i) / 1000.0).filter(|t| inside(*t)).collect();
            match (within(p, q, a, b, 0.5), sampled.first().zip(sampled.last())) {
                (Some((from, to)), Some((first, last))) => {
                    hits += 1;
                    assert!(
                        (from - first).abs() <= 1.1e-3 && (to - last).abs() <= 1.1e-3,
                        "{from} {first} {to} {last}"
                    );
                }
                (Some((from, to)), None) => assert!(to - from <= 1.1e-3),
                (None, Some(_)) => panic!("an interval was not found"),
                (None, None) => {}
            }
        }
        assert!(hits > 300);
    }
}
