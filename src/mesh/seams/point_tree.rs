//! [`PointTree`]: k-d tree of points that finds those near a segment.
//!
//! A tree handles clustered points. In a uniform grid, all leaves of a tree in a wide field would fall into
//! one cell.
//!
//! Source: Bentley, "Multidimensional binary search trees used for associative searching", 1975, for the
//! order of the points.

use crate::parallel::prelude::*;
use glam::DVec3;

use crate::mesh::tolerances;
use crate::parallel::task_size::MIN_TASK_ITEMS;

/// Number of points or boxes in one box.
const CHILDREN_PER_BOX: usize = 4;

/// Point with its index.
type IndexedPoint = (DVec3, u32);

/// Bounding box of some points.
#[derive(Clone, Copy)]
struct PointBox {
    low: DVec3,
    high: DVec3,
}

/// Points in tree order. Each box covers a run of points, or of boxes one level down.
pub(crate) struct PointTree {
    points: Vec<IndexedPoint>,
    /// Boxes of points first, the box of all points last.
    levels: Vec<Vec<PointBox>>,
}

impl PointTree {
    /// Builds the tree. Points are numbered from 0.
    pub(crate) fn new(points: impl IntoIterator<Item = DVec3>) -> Self {
        let mut places: Vec<IndexedPoint> = points.into_iter().zip(0..).collect();
        part(&mut places);
        let of_points =
            |run: &[IndexedPoint]| PointBox::all(run.iter().map(|(p, _)| PointBox { low: *p, high: *p }));
        let of_boxes = |run: &[PointBox]| PointBox::all(run.iter().copied());
        let mut levels: Vec<Vec<PointBox>> =
            vec![places.par_chunks(CHILDREN_PER_BOX).map(of_points).collect()];
        while let Some(last) = levels.last().filter(|last| last.len() > 1) {
            let above = last.par_chunks(CHILDREN_PER_BOX).map(of_boxes).collect();
            levels.push(above);
        }
        Self { points: places, levels }
    }

    /// Visits all points within `reach` of the segment from `start` to `start + way`, and some others, each
    /// once.
    pub(crate) fn visit_near(&self, start: DVec3, way: DVec3, reach: f64, mut visit: impl FnMut(u32, DVec3)) {
        let line = QuerySegment { start, per_way: way.recip(), reach };
        let top = self.levels.len() - 1;
        for k in 0..self.levels[top].len() {
            self.visit_box(&line, top, k, &mut visit);
        }
    }

    /// Visits the points in a box of a level.
    fn visit_box(&self, line: &QuerySegment, level: usize, k: usize, visit: &mut impl FnMut(u32, DVec3)) {
        if !line.meets(&self.levels[level][k]) {
            return;
        }
        let all = if level == 0 { self.points.len() } else { self.levels[level - 1].len() };
        let run = CHILDREN_PER_BOX * k..(CHILDREN_PER_BOX * (k + 1)).min(all);
        if level == 0 {
            self.points[run].iter().for_each(|(place, number)| visit(*number, *place));
        } else {
            run.for_each(|k| self.visit_box(line, level - 1, k, visit));
        }
    }
}

/// Sorts points so that each box covers a run of them. Splits in halves (rounded to whole boxes) along the
/// axis of largest extent.
fn part(places: &mut [IndexedPoint]) {
    if places.len() <= CHILDREN_PER_BOX {
        return;
    }
    let mut unit = CHILDREN_PER_BOX;
    while unit * CHILDREN_PER_BOX < places.len() {
        unit *= CHILDREN_PER_BOX;
    }
    let PointBox { low, high } = PointBox::all(places.iter().map(|(p, _)| PointBox { low: *p, high: *p }));
    let axis = (high - low).max_position();
    let at = unit * (places.len().div_ceil(unit) / 2);
    places.select_nth_unstable_by(at, |a, b| a.0[axis].total_cmp(&b.0[axis]));
    let (first, second) = places.split_at_mut(at);
    if first.len() < MIN_TASK_ITEMS {
        part(first);
        part(second);
    } else {
        crate::parallel::join(|| part(first), || part(second));
    }
}

impl PointBox {
    /// The box around some boxes.
    fn all(boxes: impl Iterator<Item = Self>) -> Self {
        let nothing = Self { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY };
        boxes.fold(nothing, |all, one| Self { low: all.low.min(one.low), high: all.high.max(one.high) })
    }
}

/// Segment with a search distance.
struct QuerySegment {
    start: DVec3,
    /// Inverse of the vector along each axis; infinite where that is zero.
    per_way: DVec3,
    reach: f64,
}

impl QuerySegment {
    /// Whether the segment comes within reach of a box along each axis. May rarely return true for a box out
    /// of reach.
    fn meets(&self, around: &PointBox) -> bool {
        let (low, high) = (around.low - self.start - self.reach, around.high - self.start + self.reach);
        let (mut from, mut to) = (0.0f64, 1.0f64);
        for axis in 0..3 {
            if self.per_way[axis].is_infinite() {
                if low[axis] > 0.0 || high[axis] < 0.0 {
                    return false;
                }
                continue;
            }
            let (a, b) = (low[axis] * self.per_way[axis], high[axis] * self.per_way[axis]);
            (from, to) = (from.max(a.min(b)), to.min(a.max(b)));
        }
        from <= to + tolerances::PARAMETER_ROUNDING
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::dice::Dice;

    /// Clusters of points in a wide field, in mixed order.
    fn point_clusters(count: usize) -> Vec<DVec3> {
        let mut dice = Dice::new(5);
        let middles: Vec<DVec3> = (0..count).map(|_| dice.point(1000.0)).collect();
        (0..500).flat_map(|_| &middles).map(|middle| *middle + dice.point(0.5)).collect()
    }

    #[test]
    fn visit_near_finds_all_points_near_a_segment() {
        let all = point_clusters(9);
        let places = PointTree::new(all.iter().copied());
        let mut dice = Dice::new(6);
        let mut found = 0;
        for k in 0..600 {
            let start = all[k * 7 % all.len()] + dice.point(0.01);
            // Along an axis, short, between clusters, and of length zero.
            let way = match k % 4 {
                0 => DVec3::X * 0.3,
                1 => dice.point(0.1),
                2 => all[k * 31 % all.len()] - start,
                _ => DVec3::ZERO,
            };
            let reach = [0.0, 0.001, 0.02, 0.2][k / 4 % 4];
            let mut visited = Vec::new();
            places.visit_near(start, way, reach, |number, place| {
                assert_eq!(place, all[number as usize]);
                visited.push(number);
            });
            visited.sort_unstable();
            assert!(visited.is_sorted_by(|a, b| a < b), "some twice");
            for (number, point) in (0..).zip(&all) {
                let t = ((*point - start).dot(way) / way.length_squared().max(1e-300)).clamp(0.0, 1.0);
                if (*point - start - way * t).length() <= reach {
                    found += 1;
                    assert!(visited.binary_search(&number).is_ok(), "{number} beside line {k}");
                }
            }
        }
        assert!(found > 1000, "{found}");
        let none = PointTree::new(Vec::new());
        none.visit_near(DVec3::ZERO, DVec3::X, 1.0, |_, _| unreachable!("there is no point"));
    }

    #[test]
    fn visit_near_visits_few_points_in_dense_clusters() {
        let all = point_clusters(40);
        let places = PointTree::new(all.iter().copied());
        let mut visits = 0;
        for start in &all {
            places.visit_near(*start, DVec3::new(0.004, 0.002, 0.001), 1e-6, |_, _| visits += 1);
        }
        assert!(visits < 12 * all.len(), "{visits} visits of {}", all.len());
    }

    #[test]
    fn visit_near_finds_points_on_an_axis_parallel_segment() {
        let row = || (0..100).map(|k| DVec3::new(f64::from(k), 0.0, 0.0));
        let places = PointTree::new(row());
        for (start, way) in [(DVec3::X * 20.0, DVec3::X * 10.0), (DVec3::X * 30.0, DVec3::X * -10.0)] {
            let mut met = Vec::new();
            places.visit_near(start, way, 0.0, |number, place| {
                if (20.0..=30.0).contains(&place.x) {
                    met.push(number);
                }
            });
            met.sort_unstable();
            assert_eq!(met, (20..=30).collect::<Vec<u32>>());
        }
    }
}
