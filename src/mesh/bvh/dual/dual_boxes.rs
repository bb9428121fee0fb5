//! [`DualBoxes`]: 16-ary tree of four-dimensional boxes, queried by a hyperplane.
//!
//! 1. Each item is stored in the smallest cube that contains it.
//! 2. Each cube has two bounding boxes: one for the items stored in it, and one for the items of its
//!    children.
//! 3. A cube that stores many items keeps them in blocks, each with a box. Many items lie on a border between
//!    large cubes, and not all of them need a test.
//!
//! Source: Claes, Di Fiore, Vansichem and Van Reeth, "Fast 3D cartoon rendering with improved quality by
//! exploiting graphics hardware", IVCNZ 2001, section 4. Blocks are an addition.

use crate::parallel::prelude::*;
use glam::DVec4;

/// Number of halvings of each axis.
const HALVINGS_PER_AXIS: u32 = 16;
/// Number of items in a block, and in a cube that is not divided further.
const ITEMS_PER_BLOCK: usize = 8;

/// Item with its box in the cube from −1 to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct DualItem {
    /// Lower corner.
    pub low: DVec4,
    /// Upper corner.
    pub high: DVec4,
    /// Number of the item.
    pub id: u32,
}

/// Box in single precision, rounded outward.
#[derive(Debug, Clone, Copy)]
struct Box4 {
    low: [f32; 4],
    high: [f32; 4],
}

impl Box4 {
    const EMPTY: Self = Self { low: [f32::INFINITY; 4], high: [f32::NEG_INFINITY; 4] };

    /// Rounds outward, so that the box still contains the item.
    fn of(item: &DualItem) -> Self {
        Self {
            low: item.low.to_array().map(|x| (x as f32).next_down()),
            high: item.high.to_array().map(|x| (x as f32).next_up()),
        }
    }

    fn union(self, other: Self) -> Self {
        let mut sum = self;
        for k in 0..4 {
            sum.low[k] = sum.low[k].min(other.low[k]);
            sum.high[k] = sum.high[k].max(other.high[k]);
        }
        sum
    }

    /// Whether the dot product with `plane` may lie between `low` and `high` somewhere in the box.
    #[inline]
    fn may_hold(&self, plane: &[f64; 4], low: f64, high: f64) -> bool {
        let (mut least, mut most) = (0.0, 0.0);
        for ((l, h), v) in self.low.iter().zip(&self.high).zip(plane) {
            let (a, b) = (f64::from(*l) * v, f64::from(*h) * v);
            least += a.min(b);
            most += a.max(b);
        }
        least <= high && most >= low
    }
}

/// Cube with own items, or with several children.
#[derive(Debug, Clone)]
struct Cube {
    /// Box around the items of the children; empty if there are none.
    children: Box4,
    /// Box around its own items; empty if there are none.
    own: Box4,
    /// First block of the items stored in it. They end where those of the next cube begin.
    first_block: u32,
    /// The next cube that is not a descendant.
    after: u32,
}

/// Result of a query.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct DualCandidates {
    /// Numbers of the items that the hyperplane may cut, ascending.
    pub items: Vec<u32>,
    /// Number of boxes tested.
    pub boxes: usize,
}

/// Four-dimensional boxes in a 16-ary tree.
#[derive(Debug, Clone, Default)]
pub(crate) struct DualBoxes {
    /// The cubes, each before its children.
    cubes: Vec<Cube>,
    /// Box of each block, with its first item; one extra entry at the end.
    blocks: Vec<(Box4, u32)>,
    /// Numbers of the items, block by block.
    ids: Vec<u32>,
}

/// Sort key of an item in the tree: Morton code of its cube with zeros below its level, then the level, then
/// the leading bits of the Morton code of its centre.
///
/// A cube sorts directly before its children.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct TreeKey(u128);

impl TreeKey {
    fn of(item: &DualItem) -> Self {
        let (low, high) = (morton(item.low), morton(item.high));
        let level = (low ^ high).leading_zeros() / 4;
        let cube = if level == 0 { 0 } else { low & u64::MAX << (64 - 4 * level) };
        let middle = morton((item.low + item.high) / 2.0);
        Self(u128::from(cube) << 64 | u128::from(level) << 59 | u128::from(middle >> 5))
    }

    /// Depth of the cube.
    fn level(self) -> u32 {
        (self.0 >> 59) as u32 & 31
    }

    /// Index of the child, 0 to 15, of its ancestor at a level.
    fn child(self, level: u32) -> u32 {
        (self.0 >> (64 + 4 * (HALVINGS_PER_AXIS - 1 - level))) as u32 & 15
    }
}

/// Items in tree order.
struct SortedItems<'a> {
    items: &'a [DualItem],
    places: &'a [(TreeKey, u32)],
}

impl DualBoxes {
    /// Builds the tree; the result does not depend on the order of the items.
    pub(crate) fn new(mut items: Vec<DualItem>) -> Self {
        items.par_sort_unstable_by_key(|item| item.id);
        let mut places: Vec<(TreeKey, u32)> = items
            .par_iter()
            .with_min_len(1 << 10)
            .enumerate()
            .map(|(i, item)| (TreeKey::of(item), i as u32))
            .collect();
        places.par_sort_unstable();
        let mut tree = Self::default();
        tree.ids.reserve_exact(items.len());
        if !items.is_empty() {
            tree.add(&SortedItems { items: &items, places: &places }, 0);
        }
        tree.blocks.push((Box4::EMPTY, tree.ids.len() as u32));
        tree
    }

    /// Adds a cube of this level with all its contents, and returns the box around it.
    fn add(&mut self, SortedItems { items, places }: &SortedItems, level: u32) -> Box4 {
        let own = if places.len() <= ITEMS_PER_BLOCK || level == HALVINGS_PER_AXIS {
            places.len()
        } else {
            places.iter().take_while(|(place, _)| place.level() == level).count()
        };
        let child = |(place, _): &(TreeKey, u32)| place.child(level);
        if own == 0 && child(&places[0]) == child(&places[places.len() - 1]) {
            // A cube with a single child and no items is replaced by the child.
            return self.add(&SortedItems { items, places }, level + 1);
        }
        let cube = self.cubes.len();
        let first_block = self.blocks.len() as u32;
        self.cubes.push(Cube { children: Box4::EMPTY, own: Box4::EMPTY, first_block, after: 0 });
        let mut around = Box4::EMPTY;
        for block in places[..own].chunks(ITEMS_PER_BLOCK) {
            let mut sum = Box4::EMPTY;
            let first = self.ids.len() as u32;
            for (_, index) in block {
                let item = &items[*index as usize];
                sum = sum.union(Box4::of(item));
                self.ids.push(item.id);
            }
            self.blocks.push((sum, first));
            around = around.union(sum);
        }
        self.cubes[cube].own = around;
        let mut children = Box4::EMPTY;
        if own < places.len() {
            for places in places[own..].chunk_by(|a, b| child(a) == child(b)) {
                children = children.union(self.add(&SortedItems { items, places }, level + 1));
            }
        }
        self.cubes[cube].children = children;
        self.cubes[cube].after = self.cubes.len() as u32;
        around.union(children)
    }

    /// Number of cubes.
    pub(crate) fn cubes(&self) -> usize {
        self.cubes.len()
    }

    /// The items whose boxes contain points with a dot product between `low` and `high`.
    pub(crate) fn find(&self, plane: DVec4, low: f64, high: f64) -> DualCandidates {
        let plane = plane.to_array();
        let mut found = DualCandidates::default();
        let mut at = 0;
        while let Some(cube) = self.cubes.get(at) {
            found.boxes += 2;
            if cube.own.may_hold(&plane, low, high) {
                let end = self.cubes.get(at + 1).map_or(self.blocks.len() - 1, |c| c.first_block as usize);
                let blocks = &self.blocks[cube.first_block as usize..=end];
                for pair in blocks.windows(2) {
                    // A single block has the box of its cube.
                    found.boxes += usize::from(blocks.len() > 2);
                    if blocks.len() == 2 || pair[0].0.may_hold(&plane, low, high) {
                        found.items.extend(&self.ids[pair[0].1 as usize..pair[1].1 as usize]);
                    }
                }
            }
            let inside = cube.children.may_hold(&plane, low, high);
            at = if inside { at + 1 } else { cube.after as usize };
        }
        found.items.sort_unstable();
        found
    }
}

/// Position along the Morton curve of a point in the cube from −1 to 1: four bits per level.
fn morton(p: DVec4) -> u64 {
    let cells = f64::from((1_u32 << HALVINGS_PER_AXIS) - 1);
    let axis = |x: f64| spread(((x + 1.0) / 2.0 * cells).clamp(0.0, cells) as u64);
    axis(p.x) << 3 | axis(p.y) << 2 | axis(p.z) << 1 | axis(p.w)
}

/// Spreads sixteen bits, with three zeros after each.
fn spread(sixteen: u64) -> u64 {
    let mut bits = sixteen;
    bits = (bits | bits << 24) & 0x0000_00ff_0000_00ff;
    bits = (bits | bits << 12) & 0x000f_000f_000f_000f;
    bits = (bits | bits << 6) & 0x0303_0303_0303_0303;
    (bits | bits << 3) & 0x1111_1111_1111_1111
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn morton_codes_interleave_the_bits_of_four_axes() {
        assert_eq!(spread(0xffff), 0x1111_1111_1111_1111);
        for bit in 0..16 {
            assert_eq!(spread(1 << bit), 1 << (4 * bit));
        }
        assert_eq!(morton(DVec4::NEG_ONE), 0);
        assert_eq!(morton(DVec4::ONE), u64::MAX);
        assert_eq!(morton(DVec4::new(1.0, -1.0, -1.0, -1.0)) >> 60, 8);
    }

    #[test]
    fn dual_boxes_find_all_items_near_a_plane_but_not_everything() {
        // Points on a lattice, some extended to boxes across the borders of cubes.
        let mut items = Vec::new();
        for id in 0..4000_u32 {
            let axis = |n: u32| f64::from(id.wrapping_mul(2_654_435_761 + 97 * n) >> 12 & 1023) / 512.0 - 1.0;
            let low = DVec4::new(axis(1), axis(2), axis(3), axis(4));
            let reach = if id % 10 == 0 { 0.3 } else { 0.001 };
            items.push(DualItem { low, high: (low + DVec4::splat(reach)).min(DVec4::ONE), id });
        }
        let tree = DualBoxes::new(items.clone());
        for k in 0..30 {
            let v = f64::from(k);
            let plane = DVec4::new(v - 15.0, 7.0 - v, (v * 5.0) % 11.0 - 5.0, f64::from(k % 2));
            let found = tree.find(plane, -0.5, 0.5);
            let wanted: Vec<u32> = items
                .iter()
                .filter(|i| {
                    let (a, b) = (i.low * plane, i.high * plane);
                    a.min(b).element_sum() <= 0.5 && a.max(b).element_sum() >= -0.5
                })
                .map(|i| i.id)
                .collect();
            assert!(found.items.is_sorted());
            assert!(wanted.iter().all(|id| found.items.binary_search(id).is_ok()));
            assert!(found.items.len() < items.len(), "plane {k} found all");
        }
        items.reverse();
        let again = DualBoxes::new(items);
        assert_eq!(tree.ids, again.ids);
    }

    #[test]
    fn empty_dual_boxes_have_no_cubes() {
        let tree = DualBoxes::new(Vec::new());
        assert_eq!((tree.cubes(), tree.find(DVec4::ONE, -1.0, 1.0)), (0, DualCandidates::default()));
    }
}
