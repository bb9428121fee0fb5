//! [`douglas_peucker`]: the points of a line that remain when it is simplified.
//!
//! Source: Douglas and Peucker, "Algorithms for the reduction of the number of points required to represent a
//! digitized line or its caricature", 1973.

/// Minimum number of points for which both halves run in parallel, and the largest ratio of the whole to its
/// smaller half.
const MIN_PARALLEL_POINTS: usize = 512;
const MAX_SPLIT_IMBALANCE: usize = 8;

/// Whether each of `count` points remains.
///
/// The points at `stops`, ascending, always remain; the first and the last point of the line are among them.
/// `farthest` returns the point between two others that has to remain, or `None` if a straight segment is
/// close enough to all of them.
pub(crate) fn douglas_peucker(
    count: usize,
    stops: &[usize],
    farthest: impl Fn(usize, usize) -> Option<usize> + Sync,
) -> Vec<bool> {
    let mut remains = vec![false; count];
    for pair in stops.windows(2) {
        split(&farthest, [pair[0], pair[1]], remains.get_mut(pair[0] + 1..pair[1]).unwrap_or_default());
    }
    stops.iter().for_each(|stop| remains[*stop] = true);
    remains
}

/// Marks the points that remain between two that do.
fn split(
    farthest: &(impl Fn(usize, usize) -> Option<usize> + Sync),
    [mut a, mut b]: [usize; 2],
    mut between: &mut [bool],
) {
    while let Some(k) = farthest(a, b) {
        let (low, high) = between.split_at_mut(k - a - 1);
        let Some((remains, high)) = high.split_first_mut() else { return };
        *remains = true;
        let (below, above) = (k - a, b - k);
        // Only near-even splits fork, so that the recursion depth stays logarithmic.
        if below.min(above) * MAX_SPLIT_IMBALANCE >= b - a && b - a >= MIN_PARALLEL_POINTS {
            crate::parallel::join(|| split(farthest, [a, k], low), || split(farthest, [k, b], high));
            return;
        }
        if below < above {
            split(farthest, [a, k], low);
            (a, between) = (k, high);
        } else {
            split(farthest, [k, b], high);
            (b, between) = (k, low);
        }
    }
}

/// First of some points with the largest error, if that exceeds a limit.
#[inline]
pub(crate) fn farthest_point(
    points: impl Iterator<Item = usize>,
    error: impl Fn(usize) -> f64,
    limit: f64,
) -> Option<usize> {
    let mut worst = (limit, None);
    for k in points {
        let own = error(k);
        if own > worst.0 {
            worst = (own, Some(k));
        }
    }
    worst.1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn douglas_peucker_keeps_stops_and_points_off_the_segments() {
        let heights = [0.0, 0.1, 3.0, 0.0, 0.0, 1.0, 0.2];
        let farthest = |a: usize, b: usize| {
            let on = |k: usize| heights[a] + (heights[b] - heights[a]) * (k - a) as f64 / (b - a) as f64;
            farthest_point(a + 1..b, |k| (heights[k] - on(k)).abs(), 0.5)
        };
        let kept = |stops: &[usize]| -> Vec<usize> {
            (0..7).filter(|k| douglas_peucker(7, stops, farthest)[*k]).collect()
        };
        assert_eq!(kept(&[0, 6]), [0, 1, 2, 3, 5, 6]);
        assert_eq!(kept(&[0, 4, 6]), [0, 1, 2, 3, 4, 5, 6]);
        assert_eq!(kept(&[0, 3, 4, 5]), [0, 1, 2, 3, 4, 5]);
    }
}
