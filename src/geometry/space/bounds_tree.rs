//! [`BoundsTree`]: bounding volume hierarchy over boxes, for queries by box, by line and by nearest point.
//!
//! A tree handles clustered items. In a uniform grid, all leaves of a tree in a wide field would fall into
//! one cell.
//!
//! Source: Bentley, "Multidimensional binary search trees used for associative searching", 1975, for the
//! order of the items.

use crate::parallel::prelude::*;
use glam::DVec3;

use super::bounds::Bounds;
use crate::parallel::task_size::MIN_TASK_ITEMS;

/// Number of boxes in one box of the next level.
const CHILDREN_PER_BOX: usize = 4;

/// Item by its middle.
type PlacedItem = (DVec3, u32);

/// Items in tree order. Each box covers a run of boxes one level down.
#[derive(Debug, Clone, Default)]
pub(crate) struct BoundsTree {
    /// Numbers of the items in tree order.
    numbers: Vec<u32>,
    /// Boxes of the items first, the box of all items last.
    levels: Vec<Vec<Bounds>>,
}

impl BoundsTree {
    /// Builds the tree. Items are numbered from 0.
    pub(crate) fn new(boxes: &[Bounds]) -> Self {
        let mut items: Vec<PlacedItem> = boxes.iter().map(Bounds::middle).zip(0..).collect();
        part(&mut items);
        let numbers: Vec<u32> = items.into_iter().map(|(_, number)| number).collect();
        let mut levels: Vec<Vec<Bounds>> =
            vec![numbers.iter().map(|number| boxes[*number as usize]).collect()];
        while let Some(last) = levels.last().filter(|last| last.len() > 1) {
            let around = |run: &[Bounds]| run.iter().copied().fold(Bounds::EMPTY, Bounds::union);
            let above = last.par_chunks(CHILDREN_PER_BOX).map(around).collect();
            levels.push(above);
        }
        Self { numbers, levels }
    }

    /// The items whose boxes, and all boxes around them, satisfy `meets`.
    pub(crate) fn near(&self, meets: impl Fn(&Bounds) -> bool) -> impl Iterator<Item = u32> {
        let top = self.levels.len() - 1;
        let mut next = (!self.numbers.is_empty()).then_some((top, 0));
        std::iter::from_fn(move || {
            while let Some((level, at)) = next {
                let is_met = meets(&self.levels[level][at]);
                if is_met && level > 0 {
                    next = Some((level - 1, CHILDREN_PER_BOX * at));
                    continue;
                }
                next = self.box_after(level, at);
                if is_met {
                    return Some(self.numbers[at]);
                }
            }
            None
        })
    }

    /// The box that a query visits after a box and everything in it.
    #[inline]
    fn box_after(&self, level: usize, at: usize) -> Option<(usize, usize)> {
        let (mut level, mut at) = (level, at);
        while level + 1 < self.levels.len() {
            let beside = at + 1;
            if beside % CHILDREN_PER_BOX != 0 && beside < self.levels[level].len() {
                return Some((level, beside));
            }
            (level, at) = (level + 1, at / CHILDREN_PER_BOX);
        }
        None
    }

    /// The item for which `own` returns the least squared distance from a point, and that distance; of
    /// several, the one of lowest number.
    pub(crate) fn nearest(&self, point: DVec3, own: impl Fn(u32) -> f64) -> Option<u32> {
        let mut best = (f64::INFINITY, u32::MAX);
        let mut open = Vec::new();
        open.extend((!self.numbers.is_empty()).then_some((0.0, self.levels.len() - 1, 0)));
        while let Some((distance, level, at)) = open.pop() {
            if distance > best.0 {
                continue;
            }
            if level == 0 {
                let number = self.numbers[at];
                let own = (own(number), number);
                if own < best {
                    best = own;
                }
                continue;
            }
            // Nearer boxes are visited first.
            let first = open.len();
            let below = &self.levels[level - 1];
            open.extend(
                self.children(level, at)
                    .map(|child| (below[child].squared_distance(point), level - 1, child)),
            );
            open[first..].sort_unstable_by(|a, b| b.0.total_cmp(&a.0));
        }
        (best.1 != u32::MAX).then_some(best.1)
    }

    /// The boxes in a box, one level down.
    fn children(&self, level: usize, at: usize) -> std::ops::Range<usize> {
        CHILDREN_PER_BOX * at..(CHILDREN_PER_BOX * (at + 1)).min(self.levels[level - 1].len())
    }
}

/// Sorts items so that each box covers a run of them. Splits in halves (rounded to whole boxes) along the
/// axis of largest extent.
fn part(items: &mut [PlacedItem]) {
    if items.len() <= CHILDREN_PER_BOX {
        return;
    }
    let mut unit = CHILDREN_PER_BOX;
    while unit * CHILDREN_PER_BOX < items.len() {
        unit *= CHILDREN_PER_BOX;
    }
    let axis = Bounds::of(items.iter().map(|(middle, _)| *middle)).size().max_position();
    let at = unit * (items.len().div_ceil(unit) / 2);
    items.select_nth_unstable_by(at, |a, b| a.0[axis].total_cmp(&b.0[axis]).then(a.1.cmp(&b.1)));
    let (first, second) = items.split_at_mut(at);
    if first.len() < MIN_TASK_ITEMS {
        part(first);
        part(second);
    } else {
        crate::parallel::join(|| part(first), || part(second));
    }
}

#[cfg(test)]
mod tests {
    use super::super::bounds::SearchLine;
    use super::super::triangles::{nearest_weights, on};
    use super::*;
    use crate::geometry::dice::Dice;

    /// Clusters of points in a wide field, in mixed order.
    fn point_clusters(count: usize) -> Vec<DVec3> {
        let mut dice = Dice::new(5);
        let middles: Vec<DVec3> = (0..count).map(|_| dice.point(1000.0)).collect();
        (0..500).flat_map(|_| &middles).map(|middle| *middle + dice.point(0.5)).collect()
    }

    fn tree_of_points(points: &[DVec3]) -> BoundsTree {
        let boxes: Vec<Bounds> = points.iter().map(|point| Bounds::of([*point])).collect();
        BoundsTree::new(&boxes)
    }

    #[test]
    fn near_finds_all_points_near_a_line() {
        let all = point_clusters(9);
        let tree = tree_of_points(&all);
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
            let line = SearchLine::new(start, way, 1.0, reach);
            let mut visited: Vec<u32> = tree.near(|around| line.meets(around)).collect();
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
        assert_eq!(tree_of_points(&[]).near(|_| true).count(), 0);
    }

    #[test]
    fn near_visits_few_points_in_dense_clusters() {
        let all = point_clusters(40);
        let tree = tree_of_points(&all);
        let near = |start: &DVec3| {
            let line = SearchLine::new(*start, DVec3::new(0.004, 0.002, 0.001), 1.0, 1e-6);
            tree.near(|around| line.meets(around)).count()
        };
        let visits: usize = all.iter().map(near).sum();
        assert!(visits < 12 * all.len(), "{visits} visits of {}", all.len());
    }

    #[test]
    fn near_finds_points_on_an_axis_parallel_line() {
        let row: Vec<DVec3> = (0..100).map(|k| DVec3::new(f64::from(k), 0.0, 0.0)).collect();
        let tree = tree_of_points(&row);
        for (start, way) in [(DVec3::X * 20.0, DVec3::X * 10.0), (DVec3::X * 30.0, DVec3::X * -10.0)] {
            let line = SearchLine::new(start, way, 1.0, 0.0);
            let mut met: Vec<u32> = tree.near(|around| line.meets(around)).collect();
            met.sort_unstable();
            assert_eq!(met, (20..=30).collect::<Vec<u32>>());
        }
    }

    #[test]
    fn near_finds_every_overlapping_box_once() {
        let mut dice = Dice::new(4);
        let mut random = |size: f64| {
            let low = dice.point(1.0);
            Bounds { low, high: low + dice.point(size).abs() }
        };
        let boxes: Vec<Bounds> = (0..500).map(|k| random(if k % 50 == 0 { 0.7 } else { 0.05 })).collect();
        let tree = BoundsTree::new(&boxes);
        for _ in 0..100 {
            let probe = random(0.4);
            let mut found: Vec<u32> = tree.near(|around| around.meets(&probe)).collect();
            found.sort_unstable();
            let all: Vec<u32> = (0..500).filter(|k| boxes[*k as usize].meets(&probe)).collect();
            assert_eq!(found, all);
        }
    }

    #[test]
    fn nearest_matches_brute_force() {
        let mut dice = Dice::new(7);
        let triangles: Vec<[DVec3; 3]> = (0..500)
            .map(|_| {
                let a = dice.point(1.0);
                [a, a + dice.point(0.1), a + dice.point(0.1)]
            })
            .collect();
        let boxes: Vec<Bounds> = triangles.iter().map(|corners| Bounds::of(*corners)).collect();
        let tree = BoundsTree::new(&boxes);
        for _ in 0..400 {
            let asked = dice.point(1.2);
            let distance =
                |corners: &[DVec3; 3]| on(corners, nearest_weights(asked, corners)).distance_squared(asked);
            let found = tree.nearest(asked, |number| distance(&triangles[number as usize])).unwrap();
            let best = triangles.iter().map(distance).fold(f64::INFINITY, f64::min);
            let own = &triangles[found as usize];
            assert_eq!(distance(own), best);
            // Compared with the corners and with points on the sides.
            for step in 0..=20 {
                let t = f64::from(step) / 20.0;
                for (a, b) in [(0, 1), (1, 2), (2, 0)] {
                    assert!((own[a].lerp(own[b], t) - asked).length() >= best.sqrt() - 1e-12);
                }
            }
        }
        assert_eq!(BoundsTree::new(&[]).nearest(DVec3::ZERO, |_| 0.0), None);
    }
}
