//! [`BoxTree`]: implicit tree of bounding boxes that lists triangles with overlapping boxes.
//!
//! 1. Vertices are quantized to a grid of 2²⁰ cells per axis. The mapping is monotone: boxes that overlap in
//!    space also overlap on the grid, so no box needs a margin.
//! 2. Triangles are sorted along a Morton curve by centre. Eight consecutive ones form a leaf, eight leaves a
//!    group, and so on. The tree is one array of boxes per level.
//! 3. Inner boxes use a coarse grid of 2¹⁵ cells per axis. The same side of four boxes is packed into one
//!    `u64` with a guard bit above each, so that a few subtractions compare one box with eight.
//! 4. Remaining pairs without a common vertex are compared on the fine grid.
//!
//! Source for step 3: L. Lamport, "Multiple byte processing with full-word instructions", CACM 18(8), 1975.

use crate::parallel::prelude::*;
use glam::DVec3;

use super::packed_boxes::{BOXES_PER_NODE, ChildMask, EightBoxes, GridBox, ReplicatedBox};
use super::quantized_box::{BITS_PER_FIELD, FineBox, LAST_FINE_CELL};
use crate::mesh::PartId;

/// Eight-fold tree of bounding boxes over triangles of a mesh.
#[derive(Debug, Clone)]
pub(crate) struct BoxTree {
    cells: QuantizationGrid,
    /// Face at each rank along the Morton curve.
    faces: Vec<u32>,
    fine: Vec<FineBox>,
    /// Level 0 holds the boxes of the triangles by rank. Each level above holds the unions of eight, up to a
    /// level of one block.
    levels: Vec<Vec<EightBoxes>>,
}

impl BoxTree {
    /// Builds the tree over the triangles for which `active` holds (empty: all). `low` and `high` are the
    /// corners of a box around them; the grid covers this box.
    ///
    /// Every index of `triangles` must be one of `positions`.
    #[must_use]
    pub(crate) fn new(
        positions: &[DVec3],
        triangles: &[[u32; 3]],
        active: &[bool],
        low: DVec3,
        high: DVec3,
    ) -> Self {
        let cells = QuantizationGrid::new(low, high);
        let vertex_cells: Vec<u64> = positions.par_iter().map(|p| cells.of(*p)).collect();
        let box_of = |[a, b, c]: [u32; 3]| {
            FineBox::of_cells([vertex_cells[a as usize], vertex_cells[b as usize], vertex_cells[c as usize]])
        };

        let mut entries: Vec<u64> = triangles
            .par_chunks(FACES_PER_TASK)
            .with_max_len(1)
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

        // Arrays are dropped as soon as possible, which lowers peak memory.
        let faces: Vec<u32> = entries.par_iter().map(|&entry| entry as u32).collect();
        drop(entries);
        let fine: Vec<FineBox> = faces.par_iter().map(|&face| box_of(triangles[face as usize])).collect();
        drop(vertex_cells);
        let mut level: Vec<EightBoxes> = fine
            .par_chunks(BOXES_PER_NODE)
            .with_min_len(FACES_PER_TASK / BOXES_PER_NODE)
            .map(of_leaf)
            .collect();
        let mut levels = Vec::new();
        loop {
            let boxes: Vec<GridBox> = level.iter().map(EightBoxes::union).collect();
            let above: Vec<EightBoxes> = boxes.chunks(BOXES_PER_NODE).map(EightBoxes::new).collect();
            levels.push(level);
            level = above;
            // The search works on groups of 64, so their level always exists.
            if levels.len() > 1 && level.len() <= 1 {
                levels.push(level);
                break;
            }
        }
        Self { cells, faces, fine, levels }
    }

    /// Calls `visit` for each triangle with others whose boxes overlap its box, except neighbours, and
    /// returns everything that the calls pushed. Each pair occurs in one call. `faces` must be those the tree
    /// was built from.
    ///
    /// Runs in parallel; the order of the result does not depend on the number of threads.
    pub(crate) fn overlaps<T, F>(&self, faces: TreeFaces, visit: F) -> Vec<T>
    where
        T: Send,
        F: Fn(u32, &[u32], &mut Vec<T>) + Sync,
    {
        let groups = self.levels[1].len();
        let tasks = groups.div_ceil(GROUPS_PER_TASK);
        let found: Vec<Vec<T>> = (0..tasks)
            .into_par_iter()
            .with_max_len(1)
            .map(|task| {
                let mut found = Vec::new();
                let mut search = OverlapSearch::default();
                for group in task * GROUPS_PER_TASK..((task + 1) * GROUPS_PER_TASK).min(groups) {
                    self.search_group(faces, group, &mut search, &visit, &mut found);
                }
                found
            })
            .collect();
        let mut all = Vec::with_capacity(found.iter().map(Vec::len).sum());
        found.into_iter().for_each(|found| all.extend(found));
        all
    }

    /// Box of a triangle on the fine grid. The triangle need not be in the tree.
    #[inline]
    pub(crate) fn box_of(&self, corners: [DVec3; 3]) -> FineBox {
        FineBox::of_cells(corners.map(|p| self.cells.of(p)))
    }

    /// Rank along the Morton curve of each of `faces` faces; `u32::MAX` for those that are not in the tree.
    pub(crate) fn ranks(&self, faces: usize) -> Vec<u32> {
        let mut ranks = vec![u32::MAX; faces];
        for (rank, face) in self.faces.iter().enumerate() {
            ranks[*face as usize] = rank as u32;
        }
        ranks
    }

    /// Copy of the tree with other boxes at some ranks, given in ascending order.
    pub(crate) fn with_boxes(&self, changed: &[(u32, FineBox)]) -> Self {
        let mut tree = self.clone();
        for (rank, fine) in changed {
            tree.fine[*rank as usize] = *fine;
        }
        let mut blocks: Vec<usize> =
            changed.iter().map(|(rank, _)| *rank as usize / BOXES_PER_NODE).collect();
        blocks.dedup();
        for block in &blocks {
            let first = block * BOXES_PER_NODE;
            tree.levels[0][*block] =
                of_leaf(&tree.fine[first..(first + BOXES_PER_NODE).min(tree.fine.len())]);
        }
        for level in 1..tree.levels.len() {
            let (below, above) = tree.levels.split_at_mut(level);
            blocks.iter_mut().for_each(|block| *block /= BOXES_PER_NODE);
            blocks.dedup();
            for block in &blocks {
                let first = block * BOXES_PER_NODE;
                let children = &below[level - 1][first..(first + BOXES_PER_NODE).min(below[level - 1].len())];
                let mut boxes = [GridBox::EMPTY; BOXES_PER_NODE];
                boxes.iter_mut().zip(children).for_each(|(one, child)| *one = child.union());
                above[0][*block] = EightBoxes::new(&boxes);
            }
        }
        tree
    }

    /// Calls `visit` for the faces whose boxes come near a box given by its corners.
    pub(crate) fn near_box(&self, low: DVec3, high: DVec3, visit: impl FnMut(u32)) {
        self.near(self.box_of([low, high, high]), &mut Vec::new(), visit);
    }

    /// Calls `visit` for the faces whose boxes overlap a given one.
    pub(crate) fn near(&self, query: FineBox, stack: &mut Vec<(usize, usize)>, mut visit: impl FnMut(u32)) {
        let wanted = &query.coarse().into();
        stack.push((self.levels.len() - 1, 0));
        while let Some((level, block)) = stack.pop() {
            let Some(boxes) = self.levels[level].get(block) else { continue };
            for node in boxes.overlapping(wanted).map(|child| block * BOXES_PER_NODE + child) {
                if level > 0 {
                    stack.push((level - 1, node));
                } else if query.overlaps(self.fine[node]) {
                    visit(self.faces[node]);
                }
            }
        }
    }

    /// Visits the triangles of one group with all later triangles on the curve that overlap them.
    fn search_group<T>(
        &self,
        all: TreeFaces,
        group: usize,
        search: &mut OverlapSearch,
        visit: &impl Fn(u32, &[u32], &mut Vec<T>),
        found: &mut Vec<T>,
    ) {
        let (triangles, leaves) = (&self.levels[0], &self.levels[1]);
        search.groups.clear();
        self.overlapping_groups(group, search);
        for leaf in group * BOXES_PER_NODE..((group + 1) * BOXES_PER_NODE).min(triangles.len()) {
            let of_leaf = &leaves[group].get(leaf % BOXES_PER_NODE).into();
            let mut own_boxes = [ReplicatedBox { low: [0; 3], high: [0; 3] }; BOXES_PER_NODE];
            own_boxes.iter_mut().enumerate().for_each(|(slot, own)| *own = triangles[leaf].get(slot).into());
            for &other_group in &search.groups {
                let first = other_group * BOXES_PER_NODE;
                let others = leaves[other_group].overlapping(of_leaf);
                for other_leaf in others.from(leaf.saturating_sub(first)).map(|child| first + child) {
                    let of_other = &leaves[other_group].get(other_leaf - first).into();
                    for own_slot in triangles[leaf].overlapping(of_other) {
                        let near = triangles[other_leaf].overlapping(&own_boxes[own_slot]);
                        // Within the same leaf, only later triangles.
                        let near = if other_leaf == leaf { near.from(own_slot + 1) } else { near };
                        self.add_overlapping_faces(
                            all,
                            leaf * BOXES_PER_NODE + own_slot,
                            other_leaf,
                            near,
                            &mut search.near[own_slot],
                        );
                    }
                }
            }
            for (own_index, near) in search.near.iter_mut().enumerate().filter(|(_, near)| !near.is_empty()) {
                visit(self.faces[leaf * BOXES_PER_NODE + own_index], near, found);
                near.clear();
            }
        }
    }

    /// Collects the groups, from `group` on, whose boxes overlap its own.
    fn overlapping_groups(&self, group: usize, search: &mut OverlapSearch) {
        let wanted = &self.levels[2][group / BOXES_PER_NODE].get(group % BOXES_PER_NODE).into();
        search.stack.clear();
        search.stack.push((self.levels.len() - 1, 0));
        while let Some((level, block)) = search.stack.pop() {
            for node in
                self.levels[level][block].overlapping(wanted).map(|child| block * BOXES_PER_NODE + child)
            {
                if level == 2 {
                    // Pairs with earlier groups are found from the other group.
                    search.groups.extend((node >= group).then_some(node));
                } else if ((node + 1) << (3 * (level - 2))) > group {
                    search.stack.push((level - 1, node));
                }
            }
        }
    }

    /// Adds the faces of a leaf, selected by `overlap_mask`, that overlap the triangle at `rank` on the fine grid
    /// and are not its neighbours.
    #[inline]
    fn add_overlapping_faces(
        &self,
        all: TreeFaces,
        rank: usize,
        leaf: usize,
        overlap_mask: ChildMask,
        near: &mut Vec<u32>,
    ) {
        if overlap_mask == ChildMask(0) {
            return;
        }
        let (own_face, own_box) = (self.faces[rank], self.fine[rank]);
        let own_corners = all.triangles[own_face as usize];
        for other_rank in overlap_mask.map(|child| leaf * BOXES_PER_NODE + child) {
            let face = self.faces[other_rank];
            if !own_box.overlaps(self.fine[other_rank]) {
                continue;
            }
            let shares = share_a_vertex(own_corners, all.triangles[face as usize]);
            if !(shares && all.are_joined(own_face, face)) {
                near.push(face);
            }
        }
    }
}

/// Triangles, and their bodies.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TreeFaces<'a> {
    /// Vertices of each triangle.
    pub triangles: &'a [[u32; 3]],
    /// Body of each triangle, or empty if there is only one.
    pub bodies: &'a [PartId],
}

impl TreeFaces<'_> {
    /// Whether two faces with a common vertex are neighbours: in the same body, or with a common edge. Bodies
    /// that touch at a vertex may still intersect.
    #[inline]
    pub(crate) fn are_joined(&self, a: u32, b: u32) -> bool {
        let (a_corners, b_corners) = (self.triangles[a as usize], self.triangles[b as usize]);
        self.bodies.is_empty()
            || self.bodies[a as usize] == self.bodies[b as usize]
            || a_corners.iter().filter(|v| b_corners.contains(v)).count() > 1
    }
}

/// The boxes of a leaf.
fn of_leaf(fine: &[FineBox]) -> EightBoxes {
    let mut boxes = [GridBox::EMPTY; BOXES_PER_NODE];
    boxes.iter_mut().zip(fine).for_each(|(one, fine)| *one = fine.coarse());
    EightBoxes::new(&boxes)
}

/// Fine grid over a box. Points outside are clamped to the outermost cells.
#[derive(Debug, Clone, Copy)]
struct QuantizationGrid {
    low: DVec3,
    per_length: DVec3,
}

impl QuantizationGrid {
    fn new(low: DVec3, high: DVec3) -> Self {
        let extent = high - low;
        let cells_of = |length: f64| if length > 0.0 { f64::from(LAST_FINE_CELL - 1) / length } else { 0.0 };
        Self { low, per_length: DVec3::new(cells_of(extent.x), cells_of(extent.y), cells_of(extent.z)) }
    }

    /// The cell that contains a point, packed.
    #[inline]
    fn of(&self, p: DVec3) -> u64 {
        let c = (p - self.low) * self.per_length;
        let cell = |x: f64| u64::from(1 + (x as u32).min(LAST_FINE_CELL - 1));
        cell(c.x) | cell(c.y) << BITS_PER_FIELD | cell(c.z) << (2 * BITS_PER_FIELD)
    }
}

#[inline]
pub(crate) fn share_a_vertex(a: [u32; 3], b: [u32; 3]) -> bool {
    let holds = |v: u32| (b[0] == v) | (b[1] == v) | (b[2] == v);
    holds(a[0]) | holds(a[1]) | holds(a[2])
}

/// Number of faces per task of the build.
const FACES_PER_TASK: usize = 1 << 13;
/// Number of groups per task of the search.
const GROUPS_PER_TASK: usize = 16;

/// Buffers of one task, reused between groups.
#[derive(Default)]
struct OverlapSearch {
    stack: Vec<(usize, usize)>,
    groups: Vec<usize>,
    /// Nearby faces of each triangle of a leaf.
    near: [Vec<u32>; BOXES_PER_NODE],
}

/// Stable radix sort by the upper half of each entry, ten bits per pass.
fn sort_by_key(entries: &mut Vec<u64>) {
    const RADIX_BITS: u32 = 10;
    let mut sorted = vec![0; entries.len()];
    for shift in [32, 32 + RADIX_BITS, 32 + 2 * RADIX_BITS] {
        let mut offsets = [0_usize; 1 << RADIX_BITS];
        let digit = |entry: u64| (entry >> shift) as usize & ((1 << RADIX_BITS) - 1);
        for &entry in entries.iter() {
            offsets[digit(entry)] += 1;
        }
        let mut offset = 0;
        for count in &mut offsets {
            offset += std::mem::replace(count, offset);
        }
        for &entry in entries.iter() {
            let slot = &mut offsets[digit(entry)];
            sorted[*slot] = entry;
            *slot += 1;
        }
        std::mem::swap(entries, &mut sorted);
    }
}
