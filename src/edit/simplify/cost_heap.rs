//! [`CostHeap`]: a priority queue of points by cost, with costs that can change.

/// Position of a point that is not in the heap.
const NOT_QUEUED: u32 = u32::MAX;

/// Children of a node: a 4-ary heap is flatter and has better cache locality than a binary one.
const CHILDREN_PER_NODE: usize = 4;

/// Heap of points, least cost first; of equal costs, the smaller point number first.
#[derive(Debug)]
pub(crate) struct CostHeap {
    nodes: Vec<(f64, u32)>,
    /// Position of each point in `nodes`.
    node_of_point: Vec<u32>,
}

fn before(a: (f64, u32), b: (f64, u32)) -> bool {
    match a.0.total_cmp(&b.0) {
        std::cmp::Ordering::Equal => a.1 < b.1,
        order => order.is_lt(),
    }
}

impl CostHeap {
    /// Builds a heap of the points that have a cost.
    pub(crate) fn new(costs: &[Option<f64>]) -> Self {
        let nodes: Vec<(f64, u32)> = costs
            .iter()
            .enumerate()
            .filter_map(|(point, cost)| cost.map(|cost| (cost, point as u32)))
            .collect();
        let mut heap = Self { nodes, node_of_point: vec![NOT_QUEUED; costs.len()] };
        for (node_index, &(_, point)) in heap.nodes.iter().enumerate() {
            heap.node_of_point[point as usize] = node_index as u32;
        }
        for node_index in (0..heap.nodes.len().div_ceil(CHILDREN_PER_NODE)).rev() {
            heap.sink(node_index);
        }
        heap
    }

    /// Removes and returns the first point.
    pub(crate) fn pop(&mut self) -> Option<(f64, u32)> {
        let first = *self.nodes.first()?;
        self.remove(first.1);
        Some(first)
    }

    /// Cost of a point in the heap.
    pub(crate) fn cost(&self, point: u32) -> Option<f64> {
        self.nodes.get(self.node_of_point[point as usize] as usize).map(|node| node.0)
    }

    /// Inserts a point, or changes its cost.
    pub(crate) fn set(&mut self, point: u32, cost: f64) {
        let mut place = self.node_of_point[point as usize] as usize;
        if place == NOT_QUEUED as usize {
            place = self.nodes.len();
            self.nodes.push((cost, point));
            self.node_of_point[point as usize] = place as u32;
        } else {
            self.nodes[place].0 = cost;
        }
        let place = self.rise(place);
        self.sink(place);
    }

    /// Removes a point if it is in the heap.
    pub(crate) fn remove(&mut self, point: u32) {
        let old_index = self.node_of_point[point as usize];
        if old_index == NOT_QUEUED {
            return;
        }
        self.node_of_point[point as usize] = NOT_QUEUED;
        let Some(last) = self.nodes.pop() else { return };
        if last.1 != point {
            let node_index = old_index as usize;
            self.nodes[node_index] = last;
            self.node_of_point[last.1 as usize] = node_index as u32;
            let raised_index = self.rise(node_index);
            self.sink(raised_index);
        }
    }

    fn rise(&mut self, mut place: usize) -> usize {
        let node = self.nodes[place];
        while place > 0 {
            let parent = (place - 1) / CHILDREN_PER_NODE;
            if !before(node, self.nodes[parent]) {
                break;
            }
            self.put(place, self.nodes[parent]);
            place = parent;
        }
        self.put(place, node);
        place
    }

    fn sink(&mut self, mut place: usize) {
        let Some(&node) = self.nodes.get(place) else { return };
        loop {
            let first = place * CHILDREN_PER_NODE + 1;
            let mut least = (place, node);
            for child in first..(first + CHILDREN_PER_NODE).min(self.nodes.len()) {
                if before(self.nodes[child], least.1) {
                    least = (child, self.nodes[child]);
                }
            }
            if least.0 == place {
                break;
            }
            self.put(place, least.1);
            place = least.0;
        }
        self.put(place, node);
    }

    fn put(&mut self, place: usize, node: (f64, u32)) {
        self.nodes[place] = node;
        self.node_of_point[node.1 as usize] = place as u32;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cost_heap_pops_points_by_cost_after_any_changes() {
        let chance = |k: u64| (k.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 40) as f64;
        let costs: Vec<Option<f64>> = (0..500).map(|k| (k % 3 != 0).then(|| chance(k))).collect();
        let mut heap = CostHeap::new(&costs);
        let mut plain = costs.clone();
        for k in 0..2000_u64 {
            let point = chance(k * 7 + 1) as usize % 500;
            if k % 5 == 0 {
                heap.remove(point as u32);
                plain[point] = None;
            } else {
                let cost = (chance(k + 9) as u64 % 50) as f64;
                heap.set(point as u32, cost);
                plain[point] = Some(cost);
            }
            assert_eq!(heap.cost(point as u32), plain[point]);
        }
        let mut expected: Vec<(f64, u32)> =
            plain.iter().enumerate().filter_map(|(p, cost)| cost.map(|cost| (cost, p as u32))).collect();
        expected.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let popped: Vec<(f64, u32)> = std::iter::from_fn(|| heap.pop()).collect();
        assert_eq!(popped, expected);
        assert_eq!(heap.cost(3), None);
    }
}
