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

use crate::parallel::prelude::*;
use glam::DVec3;

use super::packed_boxes::{EightBoxes, GridBox, Places, Probe, WIDTH};
use super::quantized_box::{FINE_FIELD, FineBox, LAST_FINE};
use crate::mesh::PartId;

/// Boxes of some triangles of a mesh, in an eight-fold tree.
#[derive(Debug, Clone)]
pub struct BoxTree {
    cells: Cells,
    /// Face of each rank along the curve.
    faces: Vec<u32>,
    fine: Vec<FineBox>,
    /// Level 0 holds the boxes of the triangles by rank, each level above the unions of eight, up to a level of
    /// one block.
    levels: Vec<Vec<EightBoxes>>,
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
        let cells = Cells::new(low, high);
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

        // What is no longer needed goes before the next array comes, so that the peak stays low.
        let faces: Vec<u32> = entries.par_iter().map(|&entry| entry as u32).collect();
        drop(entries);
        let fine: Vec<FineBox> = faces.par_iter().map(|&face| box_of(triangles[face as usize])).collect();
        drop(vertex_cells);
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
        Self { cells, faces, fine, levels }
    }

    /// Calls `visit` for triangles with others whose boxes overlap theirs and that are no neighbours of theirs, every pair in one call,
    /// and returns what the calls pushed. `faces` are those that the tree was made of.
    ///
    /// Works in parallel; the order of the result does not depend on the number of threads.
    pub fn overlaps<T, F>(&self, faces: Faces, visit: F) -> Vec<T>
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
                let mut search = Search::default();
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

    /// The box on the fine grid of a triangle, which need not be one of the tree's.
    #[inline]
    pub(crate) fn box_of(&self, corners: [DVec3; 3]) -> FineBox {
        FineBox::of_cells(corners.map(|p| self.cells.of(p)))
    }

    /// The place of each of so many faces along the curve; `u32::MAX` for those that the tree does not have.
    pub(crate) fn ranks(&self, faces: usize) -> Vec<u32> {
        let mut ranks = vec![u32::MAX; faces];
        for (rank, face) in self.faces.iter().enumerate() {
            ranks[*face as usize] = rank as u32;
        }
        ranks
    }

    /// The tree with other boxes at some places along the curve, which ascend.
    pub(crate) fn with_boxes(&self, changed: &[(u32, FineBox)]) -> Self {
        let mut tree = self.clone();
        for (rank, fine) in changed {
            tree.fine[*rank as usize] = *fine;
        }
        let mut blocks: Vec<usize> = changed.iter().map(|(rank, _)| *rank as usize / WIDTH).collect();
        blocks.dedup();
        for block in &blocks {
            let first = block * WIDTH;
            tree.levels[0][*block] = of_leaf(&tree.fine[first..(first + WIDTH).min(tree.fine.len())]);
        }
        for level in 1..tree.levels.len() {
            let (below, above) = tree.levels.split_at_mut(level);
            blocks.iter_mut().for_each(|block| *block /= WIDTH);
            blocks.dedup();
            for block in &blocks {
                let first = block * WIDTH;
                let children = &below[level - 1][first..(first + WIDTH).min(below[level - 1].len())];
                let mut boxes = [GridBox::EMPTY; WIDTH];
                boxes.iter_mut().zip(children).for_each(|(one, child)| *one = child.union());
                above[0][*block] = EightBoxes::new(&boxes);
            }
        }
        tree
    }

    /// Calls `visit` for the faces whose boxes come near a box given by its corners.
    pub fn near_box(&self, low: DVec3, high: DVec3, visit: impl FnMut(u32)) {
        self.near(self.box_of([low, high, high]), &mut Vec::new(), visit);
    }

    /// Calls `visit` for the faces whose boxes overlap a given one.
    pub(crate) fn near(&self, own: FineBox, stack: &mut Vec<(usize, usize)>, mut visit: impl FnMut(u32)) {
        let wanted = &own.coarse().into();
        stack.push((self.levels.len() - 1, 0));
        while let Some((level, block)) = stack.pop() {
            let Some(boxes) = self.levels[level].get(block) else { continue };
            for node in boxes.overlapping(wanted).map(|place| block * WIDTH + place) {
                if level > 0 {
                    stack.push((level - 1, node));
                } else if own.overlaps(self.fine[node]) {
                    visit(self.faces[node]);
                }
            }
        }
    }

    /// Visits the triangles of one group with all that overlap them and come later on the curve.
    fn search_group<T>(
        &self,
        all: Faces,
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
                        self.add_strangers(all, leaf * WIDTH + place, other, near, &mut search.near[place]);
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

    /// Adds the faces at some places of a leaf that are no neighbours of the triangle of a rank and overlap it
    /// on the fine grid as well.
    #[inline]
    fn add_strangers(&self, all: Faces, rank: usize, leaf: usize, places: Places, near: &mut Vec<u32>) {
        if places == Places(0) {
            return;
        }
        let (own_face, own_box) = (self.faces[rank], self.fine[rank]);
        let own = all.triangles[own_face as usize];
        for other in places.map(|place| leaf * WIDTH + place) {
            let face = self.faces[other];
            if !own_box.overlaps(self.fine[other]) {
                continue;
            }
            let shares = share_a_vertex(own, all.triangles[face as usize]);
            if !(shares && all.are_joined(own_face, face)) {
                near.push(face);
            }
        }
    }
}

/// Triangles, and to which bodies they belong.
#[derive(Debug, Clone, Copy)]
pub struct Faces<'a> {
    /// Vertices of each.
    pub triangles: &'a [[u32; 3]],
    /// The body of each, or empty if there is only one.
    pub bodies: &'a [PartId],
}

impl Faces<'_> {
    /// Whether two faces with a vertex in common are neighbours: of one body, or with an edge in common. Bodies may touch at a vertex
    /// and pass through each other all the same.
    #[inline]
    pub(crate) fn are_joined(&self, a: u32, b: u32) -> bool {
        let (own, other) = (self.triangles[a as usize], self.triangles[b as usize]);
        self.bodies.is_empty()
            || self.bodies[a as usize] == self.bodies[b as usize]
            || own.iter().filter(|v| other.contains(v)).count() > 1
    }
}

/// The boxes of a leaf.
fn of_leaf(fine: &[FineBox]) -> EightBoxes {
    let mut boxes = [GridBox::EMPTY; WIDTH];
    boxes.iter_mut().zip(fine).for_each(|(one, fine)| *one = fine.coarse());
    EightBoxes::new(&boxes)
}

/// The fine grid over a box. What lies outside counts as in its outermost cells.
#[derive(Debug, Clone, Copy)]
struct Cells {
    low: DVec3,
    per_length: DVec3,
}

impl Cells {
    fn new(low: DVec3, high: DVec3) -> Self {
        let extent = high - low;
        let cells_of = |length: f64| if length > 0.0 { f64::from(LAST_FINE - 1) / length } else { 0.0 };
        Self { low, per_length: DVec3::new(cells_of(extent.x), cells_of(extent.y), cells_of(extent.z)) }
    }

    /// The cell that a point lies in, packed.
    #[inline]
    fn of(&self, p: DVec3) -> u64 {
        let c = (p - self.low) * self.per_length;
        let cell = |x: f64| u64::from(1 + (x as u32).min(LAST_FINE - 1));
        cell(c.x) | cell(c.y) << FINE_FIELD | cell(c.z) << (2 * FINE_FIELD)
    }
}

#[inline]
pub(crate) fn share_a_vertex(a: [u32; 3], b: [u32; 3]) -> bool {
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
