//! [`NearestTree`]: bounding volume hierarchy that finds the triangle nearest to a point.

use glam::DVec3;

/// Maximum number of triangles in a leaf.
const MAX_TRIANGLES_PER_LEAF: usize = 4;

/// Binary tree of bounding boxes over triangles, for nearest-point queries.
#[derive(Debug, Clone, Default)]
pub(crate) struct NearestTree {
    nodes: Vec<NearestNode>,
    /// Triangles in leaf order, and the original number of each.
    corners: Vec<[DVec3; 3]>,
    numbers: Vec<u32>,
}

#[derive(Debug, Clone, Copy)]
struct NearestNode {
    low: DVec3,
    high: DVec3,
    /// Range of the triangles in this node.
    from: u32,
    to: u32,
    /// Index of the second child; the first child is the next node. 0 for a leaf.
    second: u32,
}

/// Point on a triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct NearestPoint {
    /// Number of the triangle.
    pub triangle: u32,
    /// Barycentric weights; the sum is 1.
    pub weights: DVec3,
}

impl NearestTree {
    /// Builds the tree. Triangles with corners that are not finite are ignored.
    #[must_use]
    pub(crate) fn new(triangles: &[[DVec3; 3]]) -> Self {
        let finite = |corners: &[DVec3; 3]| corners.iter().all(|corner| corner.is_finite());
        let mut order: Vec<u32> = (0..triangles.len() as u32)
            .filter(|number| triangles.get(*number as usize).is_some_and(finite))
            .collect();
        let mut tree = Self::default();
        if !order.is_empty() {
            tree.split(triangles, &mut order, 0);
        }
        tree.corners = order.iter().filter_map(|number| triangles.get(*number as usize).copied()).collect();
        tree.numbers = order;
        tree
    }

    /// The nearest point on any triangle; at equal distance, on the triangle of lowest number. `None` without
    /// triangles.
    #[must_use]
    pub(crate) fn nearest(&self, point: DVec3) -> Option<NearestPoint> {
        let mut best = (f64::INFINITY, u32::MAX, DVec3::ZERO);
        let mut open: Vec<(f64, usize)> =
            self.nodes.first().map(|root| (root.away(point), 0)).into_iter().collect();
        while let Some((away, at)) = open.pop() {
            let Some(node) = self.nodes.get(at).filter(|_| away <= best.0) else { continue };
            if node.second == 0 {
                for place in node.from as usize..node.to as usize {
                    let (Some(corners), Some(number)) = (self.corners.get(place), self.numbers.get(place))
                    else {
                        continue;
                    };
                    let weights = nearest_weights(point, corners);
                    let own = (on(corners, weights) - point).length_squared();
                    if own < best.0 || (own == best.0 && *number < best.1) {
                        best = (own, *number, weights);
                    }
                }
                continue;
            }
            let mut children = [at + 1, node.second as usize]
                .map(|child| (self.nodes.get(child).map_or(f64::INFINITY, |node| node.away(point)), child));
            // The nearer child is processed first.
            if children[0].0 < children[1].0 {
                children.swap(0, 1);
            }
            open.extend(children);
        }
        (best.1 != u32::MAX).then_some(NearestPoint { triangle: best.1, weights: best.2 })
    }

    /// Adds a node over some triangles, and all nodes below it. Reorders the triangles.
    fn split(&mut self, triangles: &[[DVec3; 3]], order: &mut [u32], from: u32) {
        let own = |number: &u32| triangles.get(*number as usize).copied().unwrap_or_default();
        let none = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (low, high) =
            order.iter().flat_map(own).fold(none, |(low, high), corner| (low.min(corner), high.max(corner)));
        let at = self.nodes.len();
        let to = from + order.len() as u32;
        self.nodes.push(NearestNode { low, high, from, to, second: 0 });
        if order.len() <= MAX_TRIANGLES_PER_LEAF {
            return;
        }
        let size = high - low;
        let axis = (0..3).max_by(|a, b| size[*a].total_cmp(&size[*b])).unwrap_or(0);
        let key = |number: &u32| own(number).iter().map(|corner| corner[axis]).sum::<f64>();
        let half = order.len() / 2;
        order.select_nth_unstable_by(half, |a, b| key(a).total_cmp(&key(b)).then(a.cmp(b)));
        let (first, second) = order.split_at_mut(half);
        self.split(triangles, first, from);
        let place = self.nodes.len() as u32;
        self.split(triangles, second, from + half as u32);
        if let Some(node) = self.nodes.get_mut(at) {
            node.second = place;
        }
    }
}

impl NearestNode {
    /// Squared distance from a point to the box.
    fn away(&self, point: DVec3) -> f64 {
        (point.clamp(self.low, self.high) - point).length_squared()
    }
}

fn on(corners: &[DVec3; 3], weights: DVec3) -> DVec3 {
    corners[0] * weights.x + corners[1] * weights.y + corners[2] * weights.z
}

/// Barycentric weights of the nearest point on a triangle, by its Voronoi regions.
///
/// Source: Ericson, "Real-Time Collision Detection", 5.1.5.
fn nearest_weights(point: DVec3, [a, b, c]: &[DVec3; 3]) -> DVec3 {
    let (ab, ac, ap) = (b - a, c - a, point - a);
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return DVec3::X;
    }
    let bp = point - b;
    let (d3, d4) = (ab.dot(bp), ac.dot(bp));
    if d3 >= 0.0 && d4 <= d3 {
        return DVec3::Y;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        let t = d1 / (d1 - d3);
        return DVec3::new(1.0 - t, t, 0.0);
    }
    let cp = point - c;
    let (d5, d6) = (ab.dot(cp), ac.dot(cp));
    if d6 >= 0.0 && d5 <= d6 {
        return DVec3::Z;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        let t = d2 / (d2 - d6);
        return DVec3::new(1.0 - t, 0.0, t);
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        let t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return DVec3::new(0.0, 1.0 - t, t);
    }
    let whole = va + vb + vc;
    let weights = DVec3::new(va, vb, vc) / whole;
    if weights.is_finite() { weights } else { DVec3::X }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::numbers::noise::{hash, unit_interval};

    fn random_point(seed: u64, number: u64) -> DVec3 {
        DVec3::from_array([0, 1, 2].map(|axis| unit_interval(hash(seed, &[number, axis]))))
    }

    #[test]
    fn nearest_tree_matches_brute_force() {
        let triangles: Vec<[DVec3; 3]> = (0..500)
            .map(|number| {
                let a = random_point(1, number);
                [a, a + random_point(2, number) * 0.1, a + random_point(3, number) * 0.1]
            })
            .collect();
        let tree = NearestTree::new(&triangles);
        for number in 0..400 {
            let asked = random_point(4, number) * 1.4 - 0.2;
            let found = tree.nearest(asked).unwrap();
            let distance =
                |corners: &[DVec3; 3]| (on(corners, nearest_weights(asked, corners)) - asked).length();
            let best = triangles.iter().map(distance).fold(f64::INFINITY, f64::min);
            let own = &triangles[found.triangle as usize];
            assert_eq!((on(own, found.weights) - asked).length(), best);
            // Compared with the corners and with points on the sides.
            for step in 0..=20 {
                let t = f64::from(step) / 20.0;
                for (a, b) in [(0, 1), (1, 2), (2, 0)] {
                    assert!((own[a].lerp(own[b], t) - asked).length() >= best - 1e-12);
                }
            }
        }
        assert_eq!(NearestTree::new(&[]).nearest(DVec3::ZERO), None);
        let broken = [[DVec3::NAN; 3], [DVec3::ZERO; 3]];
        assert_eq!(NearestTree::new(&broken).nearest(DVec3::X).unwrap().triangle, 1);
    }
}
