//! [`insertion_order`]: insertion order of points into the triangulation (BRIO).

use crate::parallel::prelude::*;

use crate::geometry::numbers::noise::hash;
use crate::geometry::space::morton_curve::spread;
use crate::parallel::task_size::MIN_TASK_ITEMS;
use crate::regions::arrangement::grid_tiles::GridPoint;

/// Bits per coordinate in a Morton code.
const MAX_COORDINATE_BITS: u32 = 21;

/// Biased randomized insertion order of points.
///
/// Points are assigned to rounds at random, each about twice as large as the one before. Random order keeps
/// the number of edge flips low for any input. Within a round points follow a space-filling curve, so that
/// each is near the one before. Sorting all points by position would cause far more flips, since most points
/// of a page lie along curves.
///
/// Source: Amenta, Choi and Rote, "Incremental constructions con BRIO", SoCG 2003.
pub(crate) fn insertion_order(points: &[GridPoint]) -> Vec<u32> {
    let mut low = [i64::MAX; 2];
    let mut high = [i64::MIN; 2];
    for point in points {
        for axis in 0..2 {
            low[axis] = low[axis].min(point[axis]);
            high[axis] = high[axis].max(point[axis]);
        }
    }
    let size = (0..2).map(|axis| high[axis].abs_diff(low[axis])).max().unwrap_or(0);
    let shift = (u64::BITS - size.leading_zeros()).saturating_sub(MAX_COORDINATE_BITS);
    let along = |point: &GridPoint| {
        let [x, y] = [0, 1].map(|axis| spread(point[axis].abs_diff(low[axis]) >> shift));
        x | y << 1
    };
    let mut keys: Vec<(u32, u64, u32)> = points
        .par_iter()
        .with_min_len(MIN_TASK_ITEMS)
        .enumerate()
        .map(|(number, point)| {
            // The last round holds half of the points, the one before it a quarter, and so on.
            let lot = hash(0, &[number as u64]).trailing_zeros();
            (u64::BITS - lot, along(point), number as u32)
        })
        .collect();
    keys.par_sort_unstable();
    keys.into_iter().map(|(_, _, number)| number).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn insertion_order_visits_each_point_once_along_a_curve() {
        let points: Vec<GridPoint> =
            (0..4096).map(|k| [k % 64 * 1_000_000_007, k / 64 * 1_000_000_007]).collect();
        let order = insertion_order(&points);
        let mut sorted = order.clone();
        sorted.sort_unstable();
        assert!(sorted.into_iter().eq(0..4096));
        // The last round has about half of the points, each two or three steps from the next.
        let steps = order[2300..].windows(2).map(|pair| {
            let [a, b] = [pair[0], pair[1]].map(|number| points[number as usize]);
            (0..2).map(|axis| a[axis].abs_diff(b[axis]) / 1_000_000_007).sum::<u64>()
        });
        assert!(steps.sum::<u64>() < 3 * 1796);
    }

    #[test]
    fn insertion_order_accepts_extreme_coordinates() {
        assert!(insertion_order(&[]).is_empty());
        assert_eq!(insertion_order(&[[7, 7]]), [0]);
        assert_eq!(insertion_order(&[[i64::MIN, 0], [i64::MAX, i64::MAX]]).len(), 2);
    }
}
