//! [`TriangleTree`]: tree over triangles, for queries by ray and by nearest point.

use glam::DVec3;

use crate::geometry::space::bounds::{Bounds, SearchLine};
use crate::geometry::space::bounds_tree::BoundsTree;
use crate::geometry::space::triangles::{nearest_weights, ray_hit, squared_distance};
use crate::mesh::tolerances;

/// Triangles with a tree over their boxes.
#[derive(Debug, Clone, Default)]
pub(crate) struct TriangleTree {
    triangles: Vec<[DVec3; 3]>,
    tree: BoundsTree,
    /// Exceeds the rounding of rays.
    slack: f64,
}

/// Point on a triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct NearestPoint {
    /// Number of the triangle.
    pub(crate) triangle: u32,
    /// Barycentric weights; the sum is 1.
    pub(crate) weights: DVec3,
}

impl TriangleTree {
    /// Builds the tree. Triangles with corners that are not finite are ignored.
    pub(crate) fn new(triangles: Vec<[DVec3; 3]>) -> Self {
        let around = |corners: &[DVec3; 3]| {
            let is_finite = corners.iter().all(|corner| corner.is_finite());
            if is_finite { Bounds::of(*corners) } else { Bounds::EMPTY }
        };
        let boxes: Vec<Bounds> = triangles.iter().map(around).collect();
        let all = boxes.iter().copied().fold(Bounds::EMPTY, Bounds::union);
        let slack = if all.is_empty() { 0.0 } else { tolerances::RAY_BOX_OF_MESH * all.largest_coordinate() };
        Self { tree: BoundsTree::new(&boxes), triangles, slack }
    }

    /// The nearest point on any triangle; at equal distance, on the triangle of lowest number. `None` without
    /// triangles.
    pub(crate) fn nearest(&self, point: DVec3) -> Option<NearestPoint> {
        let corners = |number: u32| &self.triangles[number as usize];
        let triangle = self.tree.nearest(point, |number| squared_distance(point, corners(number)))?;
        Some(NearestPoint { triangle, weights: nearest_weights(point, corners(triangle)) })
    }

    /// Whether a ray from a point meets a triangle nearer than `reach` times the length of `direction`. A
    /// triangle that contains the start may be met or not.
    pub(crate) fn is_blocked(&self, point: DVec3, direction: DVec3, reach: f64) -> bool {
        let line = SearchLine::new(point, direction, reach, self.slack);
        let is_met = |number| ray_hit(&self.triangles[number as usize], point, direction, reach).is_some();
        self.tree.near(|around| line.meets(around)).any(is_met)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{FaceId, Mesh, Soup};

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

    fn all_corners(mesh: &Mesh) -> Vec<[DVec3; 3]> {
        (0..mesh.triangles.len() as u32).map(|face| mesh.corners(FaceId(face))).collect()
    }

    #[test]
    fn triangle_tree_matches_brute_force_over_all_triangles() {
        for count in [0, 1, 7, 9, 64, 65, 700] {
            let positions: Vec<DVec3> =
                (0..3 * count).map(|k| random_point(k / 3 + 1000) + 0.2 * random_point(k + 5000)).collect();
            let triangles = (0..count).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
            let mesh = Mesh::build(Soup { positions, triangles, ..Soup::default() });
            let tree = TriangleTree::new(all_corners(&mesh));
            let mut blocked = 0;
            for n in 0..600 {
                let (start, direction) = (random_point(n + 20_000), random_point(n + 30_000));
                let direction = if n % 50 == 0 { DVec3::X } else { direction };
                for reach in [0.3, 9.0, f64::INFINITY] {
                    let all = (0..mesh.triangles.len() as u32)
                        .any(|face| ray_hit(&mesh.corners(FaceId(face)), start, direction, reach).is_some());
                    assert_eq!(tree.is_blocked(start, direction, reach), all, "{count} {n} {reach}");
                    blocked += u32::from(all);
                }
            }
            assert!(count < 64 || blocked > 50, "{count}: {blocked}");
        }
    }
}
