//! [`Boxes`]: a tree of boxes in the plane, which lists what a box may overlap.

/// A box in the plane: least x and y, greatest x and y.
pub(super) type Rect = [f64; 4];

/// Boxes below one node of the lowest level.
const LEAF: usize = 8;

/// A tree in an array: each node halves its range of the boxes, put in order along its longer side.
#[derive(Debug, Clone, Default)]
pub(super) struct Boxes {
    /// The numbers of the boxes in the order of the tree.
    order: Vec<u32>,
    nodes: Vec<Node>,
}

#[derive(Debug, Clone, Copy)]
struct Node {
    bounds: Rect,
    range: [u32; 2],
    /// The second child; the first follows the node. None in a leaf.
    second: Option<u32>,
}

impl Boxes {
    /// The tree of some boxes.
    pub fn new(boxes: &[Rect]) -> Self {
        let mut tree = Self { order: (0..boxes.len() as u32).collect(), nodes: Vec::new() };
        if !boxes.is_empty() {
            tree.grow(boxes, 0, boxes.len());
        }
        tree
    }

    fn grow(&mut self, boxes: &[Rect], first: usize, last: usize) {
        let own = &mut self.order[first..last];
        let bounds = own.iter().fold(EMPTY, |sum, k| union(sum, boxes[*k as usize]));
        let node = self.nodes.len();
        self.nodes.push(Node { bounds, range: [first as u32, last as u32], second: None });
        if own.len() <= LEAF {
            return;
        }
        let along = usize::from(bounds[3] - bounds[1] > bounds[2] - bounds[0]);
        let middle = |k: &u32| boxes[*k as usize][along] + boxes[*k as usize][along + 2];
        let half = own.len() / 2;
        own.select_nth_unstable_by(half, |a, b| middle(a).total_cmp(&middle(b)).then(a.cmp(b)));
        self.grow(boxes, first, first + half);
        self.nodes[node].second = Some(self.nodes.len() as u32);
        self.grow(boxes, first + half, last);
    }

    /// Calls `found` with the number of each box near `probe`, until it returns false: at least all that overlap it.
    pub fn near(&self, probe: &Rect, found: &mut impl FnMut(u32) -> bool) -> bool {
        let mut open: Vec<u32> = if self.nodes.is_empty() { Vec::new() } else { vec![0] };
        while let Some(number) = open.pop() {
            let node = &self.nodes[number as usize];
            if !overlap(&node.bounds, probe) {
                continue;
            }
            match node.second {
                Some(second) => open.extend([second, number + 1]),
                None => {
                    let [first, last] = node.range.map(|k| k as usize);
                    if !self.order[first..last].iter().all(|k| found(*k)) {
                        return false;
                    }
                }
            }
        }
        true
    }
}

/// The box around nothing.
pub(super) const EMPTY: Rect = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];

/// The box around two boxes.
pub(super) fn union(a: Rect, b: Rect) -> Rect {
    [a[0].min(b[0]), a[1].min(b[1]), a[2].max(b[2]), a[3].max(b[3])]
}

/// Whether two boxes have a point in common.
pub(super) fn overlap(a: &Rect, b: &Rect) -> bool {
    a[0] <= b[2] && b[0] <= a[2] && a[1] <= b[3] && b[1] <= a[3]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::dice::Dice;

    #[test]
    fn all_boxes_that_overlap_are_found_once() {
        let mut dice = Dice::new(4);
        let mut random = |size: f64| {
            let (x, y) = (dice.between(0.0, 1.0), dice.between(0.0, 1.0));
            [x, y, x + dice.between(0.0, size), y + dice.between(0.0, size)]
        };
        let boxes: Vec<Rect> = (0..500).map(|k| random(if k % 50 == 0 { 0.7 } else { 0.05 })).collect();
        let tree = Boxes::new(&boxes);
        for _ in 0..100 {
            let probe = random(0.2);
            let mut found = Vec::new();
            tree.near(&probe, &mut |k| {
                found.push(k);
                true
            });
            found.retain(|k| overlap(&boxes[*k as usize], &probe));
            found.sort_unstable();
            let all: Vec<u32> = (0..500).filter(|k| overlap(&boxes[*k as usize], &probe)).collect();
            assert_eq!(found, all);
        }
    }
}
