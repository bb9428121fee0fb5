//! [`BoxTree`]: implicit tree of bounding boxes that lists triangles with overlapping boxes.
//!
//! 1. Boxes are in cells of a grid with 2²⁰ cells per axis, so triangles that touch within rounding overlap. The
//!    mapping is monotone: boxes that overlap in space also overlap on the grid.
//! 2. Triangles are sorted along a Morton curve by centre. Eight consecutive ones form a leaf, eight leaves a
//!    group, and so on. The tree is one array of boxes per level.
//! 3. The boxes of the eight children of a node are compared with a box at once.

use crate::parallel::prelude::*;
use glam::{DVec3, Vec3};

use super::node_boxes::{Box3, NODE_CHILDREN, NodeBoxes, set_bits, union_of};
use crate::geometry::space::morton_curve::spread;
use crate::mesh::PartId;
use crate::mesh::order::counting_sort::counting_sort;

/// Eight-fold tree of bounding boxes over triangles of a mesh.
#[derive(Debug, Clone)]
pub(crate) struct BoxTree {
    grid: CellGrid,
    /// Face at each rank along the Morton curve.
    faces: Vec<u32>,
    /// Level 0 holds the boxes of the triangles by rank. Each level above holds the unions of eight, up to a
    /// level of one node.
    levels: Vec<Vec<NodeBoxes>>,
}

impl BoxTree {
    /// Builds the tree over the triangles for which `active` holds (empty: all). `low` and `high` are the
    /// corners of a box around them.
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
        let grid = CellGrid::new(low, high);
        let cells: Vec<Vec3> =
            positions.par_iter().with_min_len(FACES_PER_TASK).map(|p| grid.cell(*p)).collect();
        let box_of = |face: u32| Box3::around(triangles[face as usize].map(|v| cells[v as usize]));
        let mut entries: Vec<u64> = (0..triangles.len() as u32)
            .into_par_iter()
            .with_min_len(FACES_PER_TASK)
            .filter(|face| active.is_empty() || active[*face as usize])
            .map(|face| u64::from(curve_key(box_of(face))) << 32 | u64::from(face))
            .collect();
        // Stable, so faces with one key stay in order.
        for shift in [0, 10, 20] {
            entries = counting_sort(entries, 1 << 10, |entry| (entry >> (32 + shift)) as u32 & 0x3ff);
        }
        let faces: Vec<u32> = entries.iter().map(|&entry| entry as u32).collect();
        drop(entries);
        let of_leaf = |faces: &[u32]| NodeBoxes::new(faces.iter().map(|face| box_of(*face)));
        let leaves = faces.par_chunks(NODE_CHILDREN).with_min_len(FACES_PER_TASK / NODE_CHILDREN);
        let mut levels: Vec<Vec<NodeBoxes>> = vec![leaves.map(of_leaf).collect()];
        // The search works on groups of 64, so their level always exists.
        while levels.len() < 3 || levels[levels.len() - 1].len() > 1 {
            levels.push(levels[levels.len() - 1].chunks(NODE_CHILDREN).map(union_of).collect());
        }
        Self { grid, faces, levels }
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

    /// Box of a triangle, which need not be in the tree.
    pub(crate) fn box_of(&self, corners: [DVec3; 3]) -> Box3 {
        Box3::around(corners.map(|p| self.grid.cell(p)))
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
    pub(crate) fn with_boxes(&self, changed: &[(u32, Box3)]) -> Self {
        let mut tree = self.clone();
        for (rank, own) in changed {
            let rank = *rank as usize;
            tree.levels[0][rank / NODE_CHILDREN].put(rank % NODE_CHILDREN, *own);
        }
        let mut nodes: Vec<usize> = changed.iter().map(|(rank, _)| *rank as usize / NODE_CHILDREN).collect();
        for level in 1..tree.levels.len() {
            nodes.dedup();
            let (below, above) = tree.levels.split_at_mut(level);
            for node in &mut nodes {
                let around = below[level - 1][*node].around();
                above[0][*node / NODE_CHILDREN].put(*node % NODE_CHILDREN, around);
                *node /= NODE_CHILDREN;
            }
        }
        tree
    }

    /// Calls `visit` for the faces whose boxes overlap the box from `low` to `high`.
    pub(crate) fn near_box(&self, low: DVec3, high: DVec3, visit: impl FnMut(u32)) {
        self.near(&self.box_of([low, high, high]), &mut Vec::new(), visit);
    }

    /// Calls `visit` for the faces whose boxes overlap a given one.
    pub(crate) fn near(&self, query: &Box3, stack: &mut Vec<(usize, usize)>, mut visit: impl FnMut(u32)) {
        stack.push((self.levels.len() - 1, 0));
        while let Some((level, node)) = stack.pop() {
            let Some(boxes) = self.levels[level].get(node) else { continue };
            for child in set_bits(boxes.overlapping(query)).map(|child| node * NODE_CHILDREN + child) {
                if level > 0 {
                    stack.push((level - 1, child));
                } else {
                    visit(self.faces[child]);
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
        for leaf in group * NODE_CHILDREN..((group + 1) * NODE_CHILDREN).min(triangles.len()) {
            let of_leaf = leaves[group].child(leaf % NODE_CHILDREN);
            for &other_group in &search.groups {
                let first = other_group * NODE_CHILDREN;
                let others = set_bits(leaves[other_group].overlapping(&of_leaf)).map(|child| first + child);
                for other_leaf in others.filter(|other| *other >= leaf) {
                    let of_other = leaves[other_group].child(other_leaf - first);
                    for own_slot in set_bits(triangles[leaf].overlapping(&of_other)) {
                        let near = triangles[other_leaf].overlapping(&triangles[leaf].child(own_slot));
                        let (rank, other) = (leaf * NODE_CHILDREN + own_slot, other_leaf * NODE_CHILDREN);
                        let later = set_bits(near).map(|child| other + child).filter(|other| *other > rank);
                        self.add_faces(all, rank, later, &mut search.near[own_slot]);
                    }
                }
            }
            for (own_index, near) in search.near.iter_mut().enumerate().filter(|(_, near)| !near.is_empty()) {
                visit(self.faces[leaf * NODE_CHILDREN + own_index], near, found);
                near.clear();
            }
        }
    }

    /// Collects the groups, from `group` on, whose boxes overlap its own.
    fn overlapping_groups(&self, group: usize, search: &mut OverlapSearch) {
        let wanted = &self.levels[2][group / NODE_CHILDREN].child(group % NODE_CHILDREN);
        search.stack.clear();
        search.stack.push((self.levels.len() - 1, 0));
        while let Some((level, node)) = search.stack.pop() {
            let children = set_bits(self.levels[level][node].overlapping(wanted));
            for child in children.map(|child| node * NODE_CHILDREN + child) {
                if level == 2 {
                    // Pairs with earlier groups are found from the other group.
                    search.groups.extend((child >= group).then_some(child));
                } else if ((child + 1) << (3 * (level - 2))) > group {
                    search.stack.push((level - 1, child));
                }
            }
        }
    }

    /// Adds the faces at some ranks, except neighbours of the triangle at `rank`.
    #[inline]
    fn add_faces(
        &self,
        all: TreeFaces,
        rank: usize,
        others: impl Iterator<Item = usize>,
        near: &mut Vec<u32>,
    ) {
        let own_face = self.faces[rank];
        let own_corners = all.triangles[own_face as usize];
        for face in others.map(|other| self.faces[other]) {
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

/// Grid of cells over a box.
#[derive(Debug, Clone, Copy)]
struct CellGrid {
    low: DVec3,
    /// Cells per length; 0 along an axis without extent.
    per_length: DVec3,
}

/// Cells per axis. Their numbers are exact in single precision.
const CELLS_PER_AXIS: u32 = (1 << 20) - 3;

/// Lower bits of the sum of two cells that the curve leaves out: 10 of 21 remain.
const CURVE_SHIFT: u32 = 11;

impl CellGrid {
    fn new(low: DVec3, high: DVec3) -> Self {
        let cells_of = |length: f64| if length > 0.0 { f64::from(CELLS_PER_AXIS) / length } else { 0.0 };
        Self { low, per_length: (high - low).map(cells_of) }
    }

    /// The cell that contains a point.
    fn cell(&self, p: DVec3) -> Vec3 {
        let cell = |x: f64| (1 + (x as u32).min(CELLS_PER_AXIS)) as f32;
        Vec3::from_array(((p - self.low) * self.per_length).to_array().map(cell))
    }
}

/// Position of the centre of a box along the Morton curve, 30 bits.
fn curve_key(of: Box3) -> u32 {
    let axis = |n: usize| (spread(u64::from((of.low[n] + of.high[n]) as u32 >> CURVE_SHIFT)) as u32) << n;
    axis(0) | axis(1) | axis(2)
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
    near: [Vec<u32>; NODE_CHILDREN],
}
