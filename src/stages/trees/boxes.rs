//! [`BoxTree`]: an implicit tree of bounding boxes that lists which triangles come near each other.
//!
//! Every vertex is put on a grid of 2¹⁵ cells an axis. The map to cells is monotone, so boxes that
//! overlap in space overlap on the grid: nothing is missed and no box need be widened. Boxes are
//! kept by eights, the same side of four in one `u64` with a spare bit above each, so that
//! a few subtractions compare one box with eight, after L. Lamport, "Multiple byte processing
//! with full-word instructions", CACM 18(8), 1975. What few pairs that leaves of triangles without
//! a common vertex is compared once more on a grid of 2²⁰ cells.
//!
//! Triangles are sorted along a Morton curve by centre; eight neighbours on it make a leaf, eight
//! leaves a group, and so on: the tree is nothing but one array of boxes a level.

use glam::DVec3;
use rayon::prelude::*;

use crate::mesh::space_curve::spread;

/// Bits of a cell along one axis; the next bit is the spare one.
const CELL_BITS: u32 = 15;
/// The lowest bit of each of the fields in a word.
const ONES: u64 = 0x0001_0001_0001_0001;
/// The spare bit of each field.
const SPARE: u64 = ONES << CELL_BITS;
/// The outermost cell stays free, so that the empty box overlaps nothing.
const OUTSIDE: u16 = (1 << CELL_BITS) - 1;
/// Children of a node, and triangles of a leaf.
const WIDTH: usize = 8;

/// Bits of a fine cell along one axis; the next bit is a spare one.
const FINE_BITS: u32 = 20;
/// Distance between the three fields of a word of fine cells.
const FINE_FIELD: u32 = FINE_BITS + 1;
/// The spare bit of each field of fine cells.
const FINE_SPARE: u64 = (1 | 1 << FINE_FIELD | 1 << (2 * FINE_FIELD)) << FINE_BITS;
/// The last of the fine cells.
const LAST_FINE: u32 = (1 << FINE_BITS) - 2;

/// The box of a triangle on the fine grid: its lowest and its highest cell along each axis, packed, the latter with all
/// spare bits set.
#[derive(Debug, Clone, Copy)]
struct FineBox {
    low: u64,
    high: u64,
}

impl FineBox {
    #[inline]
    fn of_cells([a, b, c]: [u64; 3]) -> Self {
        Self { low: lesser(lesser(a, b), c), high: greater(greater(a, b), c) | FINE_SPARE }
    }

    #[inline]
    fn overlaps(self, other: Self) -> bool {
        // A spare bit stays where its cell of `high` is at least that of `low`.
        (self.high - other.low) & (other.high - self.low) & FINE_SPARE == FINE_SPARE
    }

    /// The box on the grid around it.
    #[inline]
    fn coarse(self) -> GridBox {
        let mut made = GridBox::EMPTY;
        for axis in 0..3 {
            let cell = |cells: u64| {
                let fine = (cells >> (axis as u32 * FINE_FIELD)) as u32 & ((1 << FINE_BITS) - 1);
                ((fine >> (FINE_BITS - CELL_BITS)) as u16).min(OUTSIDE - 1)
            };
            made.low[axis] = cell(self.low);
            made.high[axis] = cell(self.high);
        }
        made
    }

    /// Position of the centre along the Morton curve, 30 bits.
    #[inline]
    fn curve_key(self) -> u32 {
        // The sum of two cells fills the spare bit, never the next field.
        let twice_centre = self.low + (self.high & !FINE_SPARE);
        let axis = |n: u32| {
            let top = (twice_centre >> (n * FINE_FIELD + FINE_FIELD - 10)) as u32 & 0x3ff;
            (spread(u64::from(top)) as u32) << n
        };
        axis(0) | axis(1) | axis(2)
    }
}

/// Value bits set where the fine cell of `a` is at least that of `b`.
#[inline]
fn not_less_mask(a: u64, b: u64) -> u64 {
    let spare = ((a | FINE_SPARE) - b) & FINE_SPARE;
    spare - (spare >> FINE_BITS)
}

#[inline]
fn greater(a: u64, b: u64) -> u64 {
    let mask = not_less_mask(a, b);
    (a & mask) | (b & !mask)
}

#[inline]
fn lesser(a: u64, b: u64) -> u64 {
    let mask = not_less_mask(a, b);
    (b & mask) | (a & !mask)
}

/// A box on the grid: its lowest and its highest cell along each axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct GridBox {
    low: [u16; 3],
    high: [u16; 3],
}

impl GridBox {
    /// Overlaps nothing, and adds nothing to a union.
    const EMPTY: Self = Self { low: [OUTSIDE; 3], high: [0; 3] };

    #[inline]
    fn union(mut self, other: Self) -> Self {
        for axis in 0..3 {
            self.low[axis] = self.low[axis].min(other.low[axis]);
            self.high[axis] = self.high[axis].max(other.high[axis]);
        }
        self
    }
}

/// A box that is compared with many: its cells in every field of a word.
#[derive(Clone, Copy)]
struct Probe {
    low: [u64; 3],
    /// With all spare bits set.
    high: [u64; 3],
}

impl From<GridBox> for Probe {
    #[inline]
    fn from(one: GridBox) -> Self {
        let mut made = Self { low: [0; 3], high: [0; 3] };
        for axis in 0..3 {
            made.low[axis] = u64::from(one.low[axis]) * ONES;
            made.high[axis] = (u64::from(one.high[axis]) * ONES) | SPARE;
        }
        made
    }
}

/// Eight boxes: the even ones in the first of two words, the odd ones in the second.
#[derive(Debug, Clone, Copy)]
struct EightBoxes {
    low: [[u64; 2]; 3],
    /// With all spare bits set.
    high: [[u64; 2]; 3],
}

impl EightBoxes {
    fn new(boxes: &[GridBox]) -> Self {
        let mut eight = Self { low: [[0; 2]; 3], high: [[SPARE; 2]; 3] };
        for place in 0..WIDTH {
            let one = boxes.get(place).copied().unwrap_or(GridBox::EMPTY);
            let (word, shift) = (place & 1, 16 * (place >> 1));
            for axis in 0..3 {
                eight.low[axis][word] |= u64::from(one.low[axis]) << shift;
                eight.high[axis][word] |= u64::from(one.high[axis]) << shift;
            }
        }
        eight
    }

    #[inline]
    fn get(&self, place: usize) -> GridBox {
        let (word, shift) = (place & 1, 16 * (place >> 1));
        let mut one = GridBox::EMPTY;
        for axis in 0..3 {
            one.low[axis] = (self.low[axis][word] >> shift) as u16 & OUTSIDE;
            one.high[axis] = (self.high[axis][word] >> shift) as u16 & OUTSIDE;
        }
        one
    }

    fn union(&self) -> GridBox {
        (0..WIDTH).fold(GridBox::EMPTY, |sum, place| sum.union(self.get(place)))
    }

    /// Which of the boxes overlap another.
    #[inline]
    fn overlapping(&self, other: &Probe) -> Places {
        let mut both = [SPARE; 2];
        for axis in 0..3 {
            for (word, both) in both.iter_mut().enumerate() {
                // A spare bit stays where its cell of `high` is at least that of `low`.
                *both &=
                    (other.high[axis] - self.low[axis][word]) & (self.high[axis][word] - other.low[axis]);
            }
        }
        Places(both[0] >> CELL_BITS | both[1] >> (CELL_BITS - 1))
    }
}

/// Some of eight places, ascending: two bits at the bottom of each field.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Places(u64);

impl Places {
    /// Those from a place on.
    #[inline]
    fn from(self, place: usize) -> Self {
        if place >= WIDTH { Self(0) } else { Self(self.0 & (u64::MAX << Self::bit(place))) }
    }

    #[inline]
    fn bit(place: usize) -> usize {
        16 * (place >> 1) + (place & 1)
    }
}

impl Iterator for Places {
    type Item = usize;

    #[inline]
    fn next(&mut self) -> Option<usize> {
        if self.0 == 0 {
            return None;
        }
        let bit = self.0.trailing_zeros() as usize;
        self.0 &= self.0 - 1;
        Some(2 * (bit / 16) + bit % 16)
    }
}

/// Boxes of some triangles of a mesh, in an eight-fold tree.
#[derive(Debug, Clone)]
pub struct BoxTree<'a> {
    triangles: &'a [[u32; 3]],
    /// Face of each rank along the curve.
    faces: Vec<u32>,
    fine: Vec<FineBox>,
    /// Level 0 holds the boxes of the triangles by rank, each level above the unions of eight, up to a level of
    /// one block.
    levels: Vec<Vec<EightBoxes>>,
}

impl<'a> BoxTree<'a> {
    /// The tree of the triangles for which `active` holds (empty: all); `low` and `high` are the
    /// corners of a box around them, for which the grid is made.
    ///
    /// Every index of `triangles` must be one of `positions`.
    #[must_use]
    pub fn new(
        positions: &[DVec3],
        triangles: &'a [[u32; 3]],
        active: &[bool],
        low: DVec3,
        high: DVec3,
    ) -> Self {
        let extent = high - low;
        let cells_of = |length: f64| if length > 0.0 { f64::from(LAST_FINE - 1) / length } else { 0.0 };
        let per_length = DVec3::new(cells_of(extent.x), cells_of(extent.y), cells_of(extent.z));
        let cell = |x: f64| u64::from(1 + (x as u32).min(LAST_FINE - 1));
        let vertex_cells: Vec<u64> = positions
            .par_iter()
            .map(|&p| {
                let c = (p - low) * per_length;
                cell(c.x) | cell(c.y) << FINE_FIELD | cell(c.z) << (2 * FINE_FIELD)
            })
            .collect();
        let box_of = |[a, b, c]: [u32; 3]| {
            FineBox::of_cells([vertex_cells[a as usize], vertex_cells[b as usize], vertex_cells[c as usize]])
        };

        let mut entries: Vec<u64> = triangles
            .par_chunks(FACES_PER_TASK)
            .enumerate()
            .flat_map_iter(|(chunk, corners)| {
                let first = chunk * FACES_PER_TASK;
                corners.iter().enumerate().filter_map(move |(i, &corners)| {
                    let face = first + i;
                    (active.is_empty() || active[face])
                        .then(|| u64::from(box_of(corners).curve_key()) << 32 | face as u64)
                })
            })
            .collect();
        sort_by_key(&mut entries);

        // What is no longer needed goes before the next array comes, so that the peak stays low.
        let faces: Vec<u32> = entries.par_iter().map(|&entry| entry as u32).collect();
        drop(entries);
        let fine: Vec<FineBox> = faces.par_iter().map(|&face| box_of(triangles[face as usize])).collect();
        drop(vertex_cells);
        let of_leaf = |fine: &[FineBox]| {
            let mut boxes = [GridBox::EMPTY; WIDTH];
            boxes.iter_mut().zip(fine).for_each(|(b, fine)| *b = fine.coarse());
            EightBoxes::new(&boxes)
        };
        let mut level: Vec<EightBoxes> =
            fine.par_chunks(WIDTH).with_min_len(FACES_PER_TASK / WIDTH).map(of_leaf).collect();
        let mut levels = Vec::new();
        loop {
            let boxes: Vec<GridBox> = level.iter().map(EightBoxes::union).collect();
            let above: Vec<EightBoxes> = boxes.chunks(WIDTH).map(EightBoxes::new).collect();
            levels.push(level);
            level = above;
            // Groups of 64 are the unit of the search, so their level is always there.
            if levels.len() > 1 && level.len() <= 1 {
                levels.push(level);
                break;
            }
        }
        Self { triangles, faces, fine, levels }
    }

    /// Calls `visit` for triangles with others whose boxes overlap theirs and that have no vertex
    /// in common with them, every pair in one call, and returns what the calls pushed.
    ///
    /// Works in parallel; the order of the result does not depend on the number of threads.
    pub fn overlaps<T, F>(&self, visit: F) -> Vec<T>
    where
        T: Send,
        F: Fn(u32, &[u32], &mut Vec<T>) + Sync,
    {
        let groups = self.levels[1].len();
        let tasks = groups.div_ceil(GROUPS_PER_TASK);
        (0..tasks)
            .into_par_iter()
            .flat_map_iter(|task| {
                let mut found = Vec::new();
                let mut search = Search::default();
                for group in task * GROUPS_PER_TASK..((task + 1) * GROUPS_PER_TASK).min(groups) {
                    self.search_group(group, &mut search, &visit, &mut found);
                }
                found
            })
            .collect()
    }

    /// Visits the triangles of one group with all that overlap them and come later on the curve.
    fn search_group<T>(
        &self,
        group: usize,
        search: &mut Search,
        visit: &impl Fn(u32, &[u32], &mut Vec<T>),
        found: &mut Vec<T>,
    ) {
        let (triangles, leaves) = (&self.levels[0], &self.levels[1]);
        search.groups.clear();
        self.overlapping_groups(group, search);
        for leaf in group * WIDTH..((group + 1) * WIDTH).min(triangles.len()) {
            let of_leaf = &leaves[group].get(leaf % WIDTH).into();
            let mut own = [Probe { low: [0; 3], high: [0; 3] }; WIDTH];
            own.iter_mut().enumerate().for_each(|(place, own)| *own = triangles[leaf].get(place).into());
            for &other_group in &search.groups {
                let first = other_group * WIDTH;
                let others = leaves[other_group].overlapping(of_leaf);
                for other in others.from(leaf.saturating_sub(first)).map(|place| first + place) {
                    let of_other = &leaves[other_group].get(other - first).into();
                    for place in triangles[leaf].overlapping(of_other) {
                        let near = triangles[other].overlapping(&own[place]);
                        // Within one leaf, those that come later.
                        let near = if other == leaf { near.from(place + 1) } else { near };
                        self.add_strangers(leaf * WIDTH + place, other, near, &mut search.near[place]);
                    }
                }
            }
            for (place, near) in search.near.iter_mut().enumerate().filter(|(_, near)| !near.is_empty()) {
                visit(self.faces[leaf * WIDTH + place], near, found);
                near.clear();
            }
        }
    }

    /// Gathers the groups, from `group` on, whose boxes overlap its own.
    fn overlapping_groups(&self, group: usize, search: &mut Search) {
        let wanted = &self.levels[2][group / WIDTH].get(group % WIDTH).into();
        search.stack.clear();
        search.stack.push((self.levels.len() - 1, 0));
        while let Some((level, block)) = search.stack.pop() {
            for node in self.levels[level][block].overlapping(wanted).map(|place| block * WIDTH + place) {
                if level == 2 {
                    // Earlier ones hold only pairs that were seen from the other side.
                    search.groups.extend((node >= group).then_some(node));
                } else if ((node + 1) << (3 * (level - 2))) > group {
                    search.stack.push((level - 1, node));
                }
            }
        }
    }

    /// Adds the faces at some places of a leaf that share no vertex with the triangle of a rank and overlap it
    /// on the fine grid as well.
    #[inline]
    fn add_strangers(&self, rank: usize, leaf: usize, places: Places, near: &mut Vec<u32>) {
        if places == Places(0) {
            return;
        }
        let (own, own_box) = (self.triangles[self.faces[rank] as usize], self.fine[rank]);
        for other in places.map(|place| leaf * WIDTH + place) {
            let face = self.faces[other];
            if own_box.overlaps(self.fine[other]) && !share_a_vertex(own, self.triangles[face as usize]) {
                near.push(face);
            }
        }
    }
}

#[inline]
fn share_a_vertex(a: [u32; 3], b: [u32; 3]) -> bool {
    let holds = |v: u32| (b[0] == v) | (b[1] == v) | (b[2] == v);
    holds(a[0]) | holds(a[1]) | holds(a[2])
}

/// Faces handled by one task of the build.
const FACES_PER_TASK: usize = 1 << 13;
/// Groups handled by one task of the search.
const GROUPS_PER_TASK: usize = 16;

/// Lists of one task, kept between groups so that they are allocated once.
#[derive(Default)]
struct Search {
    stack: Vec<(usize, usize)>,
    groups: Vec<usize>,
    /// What is near each triangle of a leaf.
    near: [Vec<u32>; WIDTH],
}

/// Sorts by the upper half of each entry, ten bits at a time, keeping the order of equals.
fn sort_by_key(entries: &mut Vec<u64>) {
    const DIGIT: u32 = 10;
    let mut sorted = vec![0; entries.len()];
    for shift in [32, 32 + DIGIT, 32 + 2 * DIGIT] {
        let mut places = [0_usize; 1 << DIGIT];
        let digit = |entry: u64| (entry >> shift) as usize & ((1 << DIGIT) - 1);
        for &entry in entries.iter() {
            places[digit(entry)] += 1;
        }
        let mut place = 0;
        for count in &mut places {
            place += std::mem::replace(count, place);
        }
        for &entry in entries.iter() {
            let place = &mut places[digit(entry)];
            sorted[*place] = entry;
            *place += 1;
        }
        std::mem::swap(entries, &mut sorted);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eight_boxes_overlap_as_their_axes_do() {
        let cells = [0, 1, 2, OUTSIDE - 2, OUTSIDE - 1];
        let spans: Vec<[u16; 2]> = cells
            .iter()
            .flat_map(|&a| cells.iter().filter(move |&&b| a <= b).map(move |&b| [a, b]))
            .collect();
        for axis in 0..3 {
            let of_span = |&[low, high]: &[u16; 2]| {
                let mut one = GridBox { low: [5; 3], high: [5; 3] };
                (one.low[axis], one.high[axis]) = (low, high);
                one
            };
            let boxes: Vec<GridBox> = spans.iter().map(of_span).collect();
            for (some, own) in boxes.chunks(5).zip(spans.chunks(5)) {
                let eight = EightBoxes::new(some);
                assert_eq!((0..some.len()).map(|place| eight.get(place)).collect::<Vec<_>>(), some);
                assert_eq!(eight.get(7), GridBox::EMPTY);
                for (other, &[low, high]) in boxes.iter().zip(&spans) {
                    let met: Vec<usize> = eight.overlapping(&Probe::from(*other)).collect();
                    let expected = own.iter().enumerate().filter(|(_, s)| s[0] <= high && low <= s[1]);
                    assert_eq!(met, expected.map(|(place, _)| place).collect::<Vec<_>>());
                    let from = eight.overlapping(&Probe::from(*other)).from(2);
                    assert_eq!(
                        from.collect::<Vec<_>>(),
                        met.iter().copied().filter(|p| *p >= 2).collect::<Vec<_>>()
                    );
                }
            }
        }
    }

    fn pack([x, y, z]: [u64; 3]) -> u64 {
        x | y << FINE_FIELD | z << (2 * FINE_FIELD)
    }

    #[test]
    fn packed_boxes_overlap_as_their_axes_do() {
        let cells = [0, 1, 2, u64::from(LAST_FINE) - 1, u64::from(LAST_FINE)];
        let spans: Vec<[u64; 2]> = cells
            .iter()
            .flat_map(|&a| cells.iter().filter(move |&&b| a <= b).map(move |&b| [a, b]))
            .collect();
        for &[a0, a1] in &spans {
            for &[b0, b1] in &spans {
                for axis in 0..3 {
                    let place = |cell| {
                        let mut triple = [5; 3];
                        triple[axis] = cell;
                        pack(triple)
                    };
                    let a = FineBox::of_cells([place(a0), place(a1), place(a0)]);
                    let b = FineBox::of_cells([place(b1), place(b0), place(b0)]);
                    assert_eq!(a.overlaps(b), a0 <= b1 && b0 <= a1);
                    assert_eq!((a.low, a.high), (place(a0), place(a1) | FINE_SPARE));
                    let cell = |cell: u64| ((cell >> 5) as u16).min(OUTSIDE - 1);
                    assert_eq!((a.coarse().low[axis], a.coarse().high[axis]), (cell(a0), cell(a1)));
                }
            }
        }
    }
}
