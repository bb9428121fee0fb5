//! [`RayTree`]: implicit tree of bounding boxes for ray queries.
//!
//! Triangles are sorted along a Morton curve by centre. Eight consecutive ones form a node, eight nodes one
//! of the next level, and so on, as in `BoxTree`. The eight boxes of a node are stored by coordinate,
//! so that all are tested at once.

use crate::parallel::prelude::*;
use glam::DVec3;

use crate::mesh::order::morton_curve::spread;
use crate::mesh::tolerances;
use crate::mesh::{FaceId, Mesh};

/// Children of a node.
const NODE_CHILDREN: usize = 8;
/// Maximum number of levels.
const MAX_LEVELS: usize = 12;

/// Boxes of eight children: lowest and highest x, y and z.
#[derive(Debug, Clone, Copy)]
struct RayNode {
    low: [[f32; NODE_CHILDREN]; 3],
    high: [[f32; NODE_CHILDREN]; 3],
}

impl RayNode {
    const EMPTY: Self =
        Self { low: [[f32::INFINITY; NODE_CHILDREN]; 3], high: [[f32::NEG_INFINITY; NODE_CHILDREN]; 3] };

    fn put(&mut self, child: usize, low: [f32; 3], high: [f32; 3]) {
        for axis in 0..3 {
            self.low[axis][child] = low[axis];
            self.high[axis][child] = high[axis];
        }
    }

    /// The box around all children.
    fn around(&self) -> ([f32; 3], [f32; 3]) {
        let least = |row: [f32; NODE_CHILDREN]| row.into_iter().fold(f32::INFINITY, f32::min);
        let most = |row: [f32; NODE_CHILDREN]| row.into_iter().fold(f32::NEG_INFINITY, f32::max);
        (self.low.map(least), self.high.map(most))
    }

    /// The children that a ray meets, one bit each.
    #[inline]
    fn meets(&self, ray: &RaySlabs) -> u32 {
        let (mut near, mut far) = ([0.0_f32; NODE_CHILDREN], [ray.reach; NODE_CHILDREN]);
        for axis in 0..3 {
            let (start, inverse) = (ray.start[axis], ray.inverse[axis]);
            let (first, last) = if inverse < 0.0 {
                (&self.high[axis], &self.low[axis])
            } else {
                (&self.low[axis], &self.high[axis])
            };
            // No value is NaN, and plain comparisons vectorise.
            for k in 0..NODE_CHILDREN {
                let (enter, leave) = ((first[k] - start) * inverse, (last[k] - start) * inverse);
                near[k] = if enter > near[k] { enter } else { near[k] };
                far[k] = if leave < far[k] { leave } else { far[k] };
            }
        }
        let mut bits = 0;
        for k in 0..NODE_CHILDREN {
            bits |= u32::from(near[k] <= far[k]) << k;
        }
        bits
    }
}

/// Ray in single precision. The boxes have a margin for its rounding.
struct RaySlabs {
    start: [f32; 3],
    inverse: [f32; 3],
    reach: f32,
}

/// Tree over the triangles of a mesh, for ray queries.
#[derive(Debug, Clone)]
pub(crate) struct RayTree {
    /// Corners of the triangles, in the order of the Morton curve.
    triangles: Vec<[DVec3; 3]>,
    /// Face of each triangle.
    faces: Vec<u32>,
    /// Level 0 holds the boxes of the triangles; each level above holds those of the nodes below.
    levels: Vec<Vec<RayNode>>,
}

impl RayTree {
    /// Builds the tree over all faces that have an area.
    #[must_use]
    pub(crate) fn new(mesh: &Mesh) -> Self {
        let (middle, half) = mesh.extents.ball();
        let mut order: Vec<(u64, u32)> = (0..mesh.triangles.len() as u32)
            .into_par_iter()
            .with_min_len(1 << 10)
            .filter(|face| !mesh.is_degenerate(FaceId(*face)))
            .map(|face| {
                let [a, b, c] = mesh.corners(FaceId(face));
                (morton(((a + b + c) / 3.0 - middle) / half), face)
            })
            .collect();
        order.par_sort_unstable();
        let faces: Vec<u32> = order.iter().map(|(_, face)| *face).collect();
        let triangles: Vec<[DVec3; 3]> = faces.iter().map(|face| mesh.corners(FaceId(*face))).collect();

        // Exceeds the rounding of the rays.
        let slack = tolerances::RAY_BOX_OF_MESH * (half + middle.length());
        let mut levels: Vec<Vec<RayNode>> = vec![
            triangles
                .chunks(NODE_CHILDREN)
                .map(|group| {
                    let mut node = RayNode::EMPTY;
                    for (child, [a, b, c]) in group.iter().enumerate() {
                        let (low, high) = (a.min(*b).min(*c) - slack, a.max(*b).max(*c) + slack);
                        node.put(child, low.as_vec3().to_array(), high.as_vec3().to_array());
                    }
                    node
                })
                .collect(),
        ];
        while levels.last().is_some_and(|level| level.len() > 1) && levels.len() < MAX_LEVELS {
            let below = &levels[levels.len() - 1];
            let above = below.chunks(NODE_CHILDREN).map(|group| {
                let mut node = RayNode::EMPTY;
                for (child, of) in group.iter().enumerate() {
                    let (low, high) = of.around();
                    node.put(child, low, high);
                }
                node
            });
            let above = above.collect();
            levels.push(above);
        }
        Self { triangles, faces, levels }
    }

    /// Whether a ray from a point meets a face nearer than `reach` times the length of `direction`. A face
    /// that contains the start may be met or not.
    #[must_use]
    pub(crate) fn is_blocked(&self, point: DVec3, direction: DVec3, reach: f64) -> bool {
        let mut blocked = false;
        self.each_near(point, direction, reach, |rank| {
            blocked = meets(&self.triangles[rank as usize], point, direction, reach).is_some();
            !blocked
        });
        blocked
    }

    /// The nearest face with `counts` that a ray meets, and its distance in lengths of `direction`, if less
    /// than `reach`. A face that contains the start may be met or not.
    pub(crate) fn first_met(
        &self,
        point: DVec3,
        direction: DVec3,
        reach: f64,
        counts: impl Fn(u32) -> bool,
    ) -> Option<(u32, f64)> {
        let mut first: Option<(u32, f64)> = None;
        self.each_near(point, direction, reach, |rank| {
            let face = self.faces[rank as usize];
            let at = meets(&self.triangles[rank as usize], point, direction, reach).filter(|_| counts(face));
            let is_nearer = |at: f64| first.is_none_or(|(other, best)| (at, face) < (best, other));
            if let Some(at) = at.filter(|at| is_nearer(*at)) {
                first = Some((face, at));
            }
            true
        });
        first
    }

    /// Calls `go_on` for each triangle whose box a ray meets, until it returns false.
    fn each_near(&self, point: DVec3, direction: DVec3, reach: f64, mut go_on: impl FnMut(u32) -> bool) {
        let inverse = |x: f64| if x.abs() < tolerances::MIN_RAY_COORDINATE { 1e30 } else { (1.0 / x) as f32 };
        let ray = RaySlabs {
            start: point.as_vec3().to_array(),
            inverse: direction.to_array().map(inverse),
            reach: (reach as f32).next_up(),
        };
        // The stack holds at most the children of one node per level.
        let mut stack = [(0_u8, 0_u32); NODE_CHILDREN * MAX_LEVELS];
        let mut count = 0;
        for node in 0..self.levels.last().map_or(0, Vec::len).min(NODE_CHILDREN) {
            stack[count] = (self.levels.len() as u8 - 1, node as u32);
            count += 1;
        }
        while count > 0 {
            count -= 1;
            let (level, node) = stack[count];
            let mut bits = self.levels[level as usize][node as usize].meets(&ray);
            while bits != 0 {
                let child = node * NODE_CHILDREN as u32 + bits.trailing_zeros();
                bits &= bits - 1;
                if level > 0 {
                    stack[count] = (level - 1, child);
                    count += 1;
                } else if !go_on(child) {
                    return;
                }
            }
        }
    }
}

/// Distance along a ray to a triangle, if between 0 and `reach`, in lengths of `direction`.
///
/// Source: Möller and Trumbore, "Fast, minimum storage ray/triangle intersection", 1997.
#[inline]
pub(crate) fn meets([a, b, c]: &[DVec3; 3], start: DVec3, direction: DVec3, reach: f64) -> Option<f64> {
    let (u, v) = (*b - *a, *c - *a);
    let across = direction.cross(v);
    let volume = u.dot(across);
    if volume == 0.0 {
        return None;
    }
    let from = start - *a;
    let s = from.dot(across) / volume;
    let turned = from.cross(u);
    let t = direction.dot(turned) / volume;
    let at = v.dot(turned) / volume;
    (s >= 0.0 && t >= 0.0 && s + t <= 1.0 && at > 0.0 && at < reach).then_some(at)
}

/// Position along the Morton curve, 63 bits, of a point in the cube from −1 to 1.
fn morton(p: DVec3) -> u64 {
    let axis = |x: f64| spread((((x + 1.0) / 2.0).clamp(0.0, 1.0) * f64::from((1 << 21) - 1)) as u64);
    axis(p.x) << 2 | axis(p.y) << 1 | axis(p.z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Soup;

    /// Pseudo-random number from -1 to 1.
    fn random_signed_unit(n: u32) -> f64 {
        let mut x = n.wrapping_mul(0x9e37_79b9) ^ 0x85eb_ca6b;
        x = (x ^ x >> 15).wrapping_mul(0x2c1b_3c6d);
        x = (x ^ x >> 12).wrapping_mul(0x297a_2d39);
        f64::from(x ^ x >> 15) / f64::from(u32::MAX) * 2.0 - 1.0
    }

    fn random_point(n: u32) -> DVec3 {
        DVec3::new(random_signed_unit(3 * n), random_signed_unit(3 * n + 1), random_signed_unit(3 * n + 2))
    }

    #[test]
    fn ray_tree_matches_brute_force_over_all_triangles() {
        for count in [0, 1, 7, 9, 64, 65, 700] {
            let positions: Vec<DVec3> =
                (0..3 * count).map(|k| random_point(k / 3 + 1000) + 0.2 * random_point(k + 5000)).collect();
            let triangles = (0..count).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
            let mesh = Mesh::build(Soup { positions, triangles, ..Soup::default() });
            let tree = RayTree::new(&mesh);
            let mut blocked = 0;
            for n in 0..600 {
                let (start, direction) = (random_point(n + 20_000), random_point(n + 30_000));
                let direction = if n % 50 == 0 { DVec3::X } else { direction };
                for reach in [0.3, 9.0, f64::INFINITY] {
                    let all = (0..mesh.triangles.len() as u32)
                        .any(|face| meets(&mesh.corners(FaceId(face)), start, direction, reach).is_some());
                    assert_eq!(tree.is_blocked(start, direction, reach), all, "{count} {n} {reach}");
                    blocked += u32::from(all);
                    let odd = |face: u32| face % 2 == 1;
                    let nearest = (0..mesh.triangles.len() as u32)
                        .filter(|face| odd(*face))
                        .filter_map(|face| {
                            meets(&mesh.corners(FaceId(face)), start, direction, reach).map(|at| (face, at))
                        })
                        .min_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
                    assert_eq!(tree.first_met(start, direction, reach, odd), nearest, "{count} {n} {reach}");
                }
            }
            assert!(count < 64 || blocked > 50, "{count}: {blocked}");
        }
    }
}
