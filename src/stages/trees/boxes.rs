//! [`BoxTree`]: an implicit tree of bounding boxes that lists which triangles come near each other.
//!
//! Every vertex is put on a grid of 2²⁰ cells an axis, and its three cells are packed into one
//! `u64` with a spare bit above each. The map to cells is monotone, so boxes that overlap in
//! space overlap on the grid: nothing is missed and no box need be widened. The spare bits let
//! one subtraction compare all three axes at once, after L. Lamport, "Multiple byte processing
//! with full-word instructions", CACM 18(8), 1975.
//!
//! Triangles are sorted along a Morton curve by centre; eight neighbours on it make a leaf, eight
//! leaves a group, and so on: the tree is nothing but one array of boxes a level.

use glam::DVec3;
use rayon::prelude::*;

use crate::mesh::space_curve::spread;
/// Bits of a cell along one axis; the next bit is the spare one.
const CELL_BITS: u32 = 20;
/// Distance between the fields of a packed triple.
const FIELD_BITS: u32 = CELL_BITS + 1;
/// The lowest bit of each field.
const ONES: u64 = 1 | 1 << FIELD_BITS | 1 << (2 * FIELD_BITS);
/// The spare bit of each field.
const SPARE: u64 = ONES << CELL_BITS;
/// The value bits of each field.
const CELLS: u64 = SPARE - ONES;
/// The outermost cells stay free, so that the empty box overlaps nothing.
const LAST_CELL: u32 = (1 << CELL_BITS) - 2;
/// Children of a node, and triangles of a leaf.
const WIDTH: usize = 8;

/// A box on the grid: its lowest and its highest cell along each axis, packed, the latter with all
/// spare bits set.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct GridBox {
    low: u64,
    high: u64,
}

impl GridBox {
    /// Overlaps nothing, and adds nothing to a union.
    const EMPTY: Self = Self { low: CELLS, high: SPARE };

    #[inline]
    fn of_cells([a, b, c]: [u64; 3]) -> Self {
        Self { low: lesser(lesser(a, b), c), high: greater(greater(a, b), c) | SPARE }
    }

    #[inline]
    fn union(self, other: Self) -> Self {
        Self { low: lesser(self.low, other.low), high: greater(self.high, other.high & CELLS) | SPARE }
    }

    #[inline]
    fn overlaps(self, other: Self) -> bool {
        // A spare bit stays where its cell of `high` is at least that of `low`.
        (self.high - other.low) & (other.high - self.low) & SPARE == SPARE
    }

    /// Position of the centre along the Morton curve, 30 bits.
    #[inline]
    fn curve_key(self) -> u32 {
        // The sum of two cells fills the spare bit, never the next field.
        let twice_centre = self.low + (self.high & CELLS);
        let axis = |n: u32| {
            let top = (twice_centre >> (n * FIELD_BITS + FIELD_BITS - 10)) as u32 & 0x3ff;
            (spread(u64::from(top)) as u32) << n
        };
        axis(0) | axis(1) | axis(2)
    }
}

/// Value bits set where the cell of `a` is at least that of `b`.
#[inline]
fn not_less_mask(a: u64, b: u64) -> u64 {
    let spare = ((a | SPARE) - b) & SPARE;
    spare - (spare >> CELL_BITS)
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

/// Boxes of some triangles of a mesh, in an eight-fold tree.
#[derive(Debug, Clone)]
pub struct BoxTree {
    /// Face of each rank along the curve.
    faces: Vec<u32>,
    /// Vertices of each rank, beside each other so that neighbours are told apart quickly.
    vertices: Vec<[u32; 3]>,
    /// Level 0 holds the boxes of the triangles by rank, each level above the unions of eight;
    /// all padded with empty boxes to a multiple of eight.
    levels: Vec<Vec<GridBox>>,
}

impl BoxTree {
    /// The tree of the triangles for which `active` holds (empty: all); `low` and `high` are the
    /// corners of a box around them, for which the grid is made.
    ///
    /// Every index of `triangles` must be one of `positions`.
    #[must_use]
    pub fn new(
        positions: &[DVec3],
        triangles: &[[u32; 3]],
        active: &[bool],
        low: DVec3,
        high: DVec3,
    ) -> Self {
        let extent = high - low;
        let cells_of = |length: f64| if length > 0.0 { f64::from(LAST_CELL - 1) / length } else { 0.0 };
        let per_length = DVec3::new(cells_of(extent.x), cells_of(extent.y), cells_of(extent.z));
        let cell = |x: f64| u64::from(1 + (x as u32).min(LAST_CELL - 1));
        let vertex_cells: Vec<u64> = positions
            .par_iter()
            .map(|&p| {
                let c = (p - low) * per_length;
                cell(c.x) | cell(c.y) << FIELD_BITS | cell(c.z) << (2 * FIELD_BITS)
            })
            .collect();
        let box_of = |corners: [u32; 3]| GridBox::of_cells(corners.map(|v| vertex_cells[v as usize]));

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
        let mut boxes = vec![GridBox::EMPTY; faces.len().next_multiple_of(WIDTH)];
        boxes.par_iter_mut().zip(&faces).for_each(|(b, &face)| *b = box_of(triangles[face as usize]));
        drop(vertex_cells);
        let vertices: Vec<[u32; 3]> = faces.par_iter().map(|&face| triangles[face as usize]).collect();
        let mut levels = Vec::new();
        loop {
            boxes.resize(boxes.len().next_multiple_of(WIDTH), GridBox::EMPTY);
            let above: Vec<GridBox> = boxes
                .chunks(WIDTH)
                .map(|children| children.iter().fold(GridBox::EMPTY, |sum, &child| sum.union(child)))
                .collect();
            levels.push(boxes);
            boxes = above;
            // Groups of 64 are the unit of the search, so two levels are always there.
            if levels.len() > 2 && boxes.len() <= 1 {
                break;
            }
        }
        Self { faces, vertices, levels }
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
        let groups = self.levels[1].len() / WIDTH;
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
        let (triangles, leaves, groups) = (&self.levels[0], &self.levels[1], &self.levels[2]);
        search.groups.clear();
        self.overlapping_groups(group, search);
        for leaf in group * WIDTH..(group + 1) * WIDTH {
            let leaf_box = leaves[leaf];
            // Whether boxes overlap is as good as chance, so the lists are filled without branches.
            search.leaves.resize(search.groups.len() * WIDTH + 1, (0, GridBox::EMPTY));
            let mut count = 0;
            for &other in &search.groups {
                if !groups[other].overlaps(leaf_box) {
                    continue;
                }
                let first = other * WIDTH;
                let Some(boxes) = leaves[first..].first_chunk::<WIDTH>() else { continue };
                for (place, &candidate) in boxes.iter().enumerate() {
                    search.leaves[count] = ((first + place) as u32, candidate);
                    count += usize::from(candidate.overlaps(leaf_box) & (first + place >= leaf));
                }
            }
            search.leaves.truncate(count);
            for rank in leaf * WIDTH..((leaf + 1) * WIDTH).min(self.faces.len()) {
                self.overlapping_strangers(rank, triangles, search);
                if !search.faces.is_empty() {
                    visit(self.faces[rank], &search.faces, found);
                }
            }
        }
    }

    /// Gathers the groups, from `group` on, whose boxes overlap its own.
    fn overlapping_groups(&self, group: usize, search: &mut Search) {
        let wanted = self.levels[2][group];
        let top = self.levels.len() - 1;
        search.stack.clear();
        search.stack.extend((0..self.levels[top].len()).rev().map(|node| (top, node)));
        while let Some((level, node)) = search.stack.pop() {
            // Nodes that end before the group hold only pairs that were seen from the other side.
            let last_group = ((node + 1) << (3 * (level - 2))) - 1;
            if last_group < group || !self.levels[level][node].overlaps(wanted) {
                continue;
            }
            if level == 2 {
                search.groups.push(node);
            } else {
                search.stack.extend((node * WIDTH..(node + 1) * WIDTH).rev().map(|child| (level - 1, child)));
            }
        }
    }

    /// Gathers the later triangles of the gathered leaves whose boxes overlap that of `rank` and
    /// that share no vertex with it.
    #[inline]
    fn overlapping_strangers(&self, rank: usize, triangles: &[GridBox], search: &mut Search) {
        let Search { leaves, near_leaves, ranks, faces, .. } = search;
        let own = triangles[rank];
        let vertices = self.vertices[rank];
        faces.clear();
        near_leaves.resize(leaves.len() + 1, 0);
        let mut near = 0;
        for &(leaf, leaf_box) in leaves.iter() {
            near_leaves[near] = leaf;
            near += usize::from(leaf_box.overlaps(own));
        }
        ranks.resize(near * WIDTH + 1, 0);
        let mut count = 0;
        for &leaf in &near_leaves[..near] {
            let first = leaf as usize * WIDTH;
            let Some(boxes) = triangles[first..].first_chunk::<WIDTH>() else { continue };
            for (place, other) in boxes.iter().enumerate() {
                ranks[count] = (first + place) as u32;
                count += usize::from(own.overlaps(*other) & (first + place > rank));
            }
        }
        for &other in &ranks[..count] {
            if !share_a_vertex(vertices, self.vertices[other as usize]) {
                faces.push(self.faces[other as usize]);
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
    leaves: Vec<(u32, GridBox)>,
    near_leaves: Vec<u32>,
    ranks: Vec<u32>,
    faces: Vec<u32>,
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

    fn pack([x, y, z]: [u64; 3]) -> u64 {
        x | y << FIELD_BITS | z << (2 * FIELD_BITS)
    }

    #[test]
    fn packed_boxes_overlap_as_their_axes_do() {
        let cells = [0, 1, 2, u64::from(LAST_CELL) - 1, u64::from(LAST_CELL)];
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
                    let a = GridBox::of_cells([place(a0), place(a1), place(a0)]);
                    let b = GridBox::of_cells([place(b1), place(b0), place(b0)]);
                    assert_eq!(a.overlaps(b), a0 <= b1 && b0 <= a1);
                    assert_eq!(a.union(b).low, place(a0.min(b0)));
                    assert_eq!(a.union(b).high, place(a1.max(b1)) | SPARE);
                    assert!(!a.overlaps(GridBox::EMPTY));
                }
            }
        }
    }
}
