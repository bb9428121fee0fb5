//! Comparison of two sets of segments by the length they cover, independent of how they are split.

use kurbo::Point;

/// Total length.
pub(crate) fn total_length(segments: &[[Point; 2]]) -> f64 {
    segments.iter().map(|[a, b]| distance(*a, *b)).sum()
}

pub(crate) fn distance(a: Point, b: Point) -> f64 {
    (b - a).hypot2().sqrt()
}

/// Length of `segments` that no segment of `by` covers within `nearness`.
pub(crate) fn uncovered_length(segments: &[[Point; 2]], by: &[[Point; 2]], nearness: f64) -> f64 {
    let others: Vec<&[Point; 2]> = by.iter().collect();
    segments.iter().map(|s| segment_length(*s) - covered_length(*s, &others, nearness)).sum()
}

/// Length that is covered more than once.
pub(crate) fn doubled_length(segments: &[[Point; 2]], nearness: f64) -> f64 {
    (0..segments.len())
        .map(|i| covered_length(segments[i], &segments[..i].iter().collect::<Vec<_>>(), nearness))
        .sum()
}

/// Fails if either set covers more than `slack` of length that the other does not.
pub(crate) fn check_equal_cover(
    one: &[[Point; 2]],
    other: &[[Point; 2]],
    nearness: f64,
    slack: f64,
) -> Result<(), String> {
    let (missing, extra) = (uncovered_length(one, other, nearness), uncovered_length(other, one, nearness));
    if missing > slack || extra > slack {
        return Err(format!(
            "{missing} of {} is not covered, and {extra} of {} too much",
            total_length(one),
            total_length(other)
        ));
    }
    Ok(())
}

fn segment_length([a, b]: [Point; 2]) -> f64 {
    distance(a, b)
}

/// Length of a segment that any of the others covers within `nearness`.
fn covered_length([a, b]: [Point; 2], others: &[&[Point; 2]], nearness: f64) -> f64 {
    let length = distance(a, b);
    if length == 0.0 {
        return 0.0;
    }
    let along = (b - a) / length;
    let mut ranges: Vec<(f64, f64)> = Vec::new();
    for other in others {
        let [mut p, mut q] = other.map(|p| (along.dot(p - a), along.cross(p - a)));
        if p.0 > q.0 {
            std::mem::swap(&mut p, &mut q);
        }
        let (from, to) = (p.0.max(0.0), q.0.min(length));
        if from >= to {
            continue;
        }
        let off = |s: f64| (p.1 + (q.1 - p.1) * (s - p.0) / (q.0 - p.0)).abs();
        if off(from) <= nearness && off(to) <= nearness {
            ranges.push((from, to));
        }
    }
    ranges.sort_by(|p, q| p.0.total_cmp(&q.0));
    let (mut sum, mut at) = (0.0, 0.0_f64);
    for (from, to) in ranges {
        sum += (to - from.max(at)).max(0.0);
        at = at.max(to);
    }
    sum
}
