//! [`RectTree`]: tree of 2-D bounding boxes, which finds the boxes that overlap a query box.

/// Box in the plane: minimum x and y, maximum x and y.
pub(crate) type Rect = [f64; 4];

/// Maximum number of boxes in a leaf.
const MAX_LEAF_BOXES: usize = 8;

/// Bounding box tree in an array. Each node splits its boxes at the median along the longer side.
#[derive(Debug, Clone, Default)]
pub(crate) struct RectTree {
    /// Boxes in tree order, with their indices.
    boxes: Vec<(Rect, u32)>,
    nodes: Vec<RectTreeNode>,
}

#[derive(Debug, Clone, Copy)]
struct RectTreeNode {
    bounds: Rect,
    range: [u32; 2],
    /// Index of the second child; the first child follows the node. None in a leaf.
    second: Option<u32>,
}

impl RectTree {
    /// Builds the tree.
    pub(crate) fn new(boxes: &[Rect]) -> Self {
        let mut tree = Self { boxes: boxes.iter().copied().zip(0..).collect(), nodes: Vec::new() };
        if !boxes.is_empty() {
            tree.grow(0, boxes.len());
        }
        tree
    }

    fn grow(&mut self, first: usize, last: usize) {
        let entries = &mut self.boxes[first..last];
        let bounds = entries.iter().fold(EMPTY_RECT, |sum, (own, _)| union(sum, *own));
        let node = self.nodes.len();
        self.nodes.push(RectTreeNode { bounds, range: [first as u32, last as u32], second: None });
        if entries.len() <= MAX_LEAF_BOXES {
            return;
        }
        let along = usize::from(bounds[3] - bounds[1] > bounds[2] - bounds[0]);
        let middle = |(entry_box, _): &(Rect, u32)| entry_box[along] + entry_box[along + 2];
        let half = entries.len() / 2;
        entries.select_nth_unstable_by(half, |a, b| middle(a).total_cmp(&middle(b)).then(a.1.cmp(&b.1)));
        self.grow(first, first + half);
        self.nodes[node].second = Some(self.nodes.len() as u32);
        self.grow(first + half, last);
    }

    /// Calls `found` with the index of each overlapping box until it returns false. Returns whether it never
    /// did.
    pub(crate) fn overlapping(&self, probe: &Rect, found: &mut impl FnMut(u32) -> bool) -> bool {
        self.nodes.is_empty() || self.visit(0, probe, found)
    }

    fn visit(&self, number: usize, probe: &Rect, found: &mut impl FnMut(u32) -> bool) -> bool {
        let node = &self.nodes[number];
        if !overlap(&node.bounds, probe) {
            return true;
        }
        match node.second {
            Some(second) => self.visit(number + 1, probe, found) && self.visit(second as usize, probe, found),
            None => {
                let [first, last] = node.range.map(|k| k as usize);
                let mut near = self.boxes[first..last].iter().filter(|(own, _)| overlap(own, probe));
                near.all(|(_, number)| found(*number))
            }
        }
    }
}

/// Empty box, neutral for [`union`].
pub(crate) const EMPTY_RECT: Rect = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];

/// Smallest box around two boxes.
pub(crate) fn union(a: Rect, b: Rect) -> Rect {
    [a[0].min(b[0]), a[1].min(b[1]), a[2].max(b[2]), a[3].max(b[3])]
}

/// Whether two boxes share a point.
pub(crate) fn overlap(a: &Rect, b: &Rect) -> bool {
    a[0] <= b[2] && b[0] <= a[2] && a[1] <= b[3] && b[1] <= a[3]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::dice::Dice;

    #[test]
    fn rect_tree_finds_every_overlapping_rectangle_once() {
        let mut dice = Dice::new(4);
        let mut random = |size: f64| {
            let (x, y) = (dice.between(0.0, 1.0), dice.between(0.0, 1.0));
            [x, y, x + dice.between(0.0, size), y + dice.between(0.0, size)]
        };
        let boxes: Vec<Rect> = (0..500).map(|k| random(if k % 50 == 0 { 0.7 } else { 0.05 })).collect();
        let tree = RectTree::new(&boxes);
        for _ in 0..100 {
            let probe = random(0.2);
            let mut found = Vec::new();
            tree.overlapping(&probe, &mut |k| {
                found.push(k);
                true
            });
            found.sort_unstable();
            let all: Vec<u32> = (0..500).filter(|k| overlap(&boxes[*k as usize], &probe)).collect();
            assert_eq!(found, all);
        }
    }
}
