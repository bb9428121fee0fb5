//! [`ParallelRays`]: blocked rays among many parallel rays, tested against a mesh at once.
//!
//! 1. Along their direction, rays project to points and faces to triangles. The points are sorted into a 2-D
//!    grid.
//! 2. Groups of eight faces are compared with the rays in the cells that they cover.
//! 3. An exact test decides the candidates.
//! 4. If faces cover too many points, the remaining rays use the tree.

use glam::{DVec3, Vec3};

use super::face_group::{FACES_PER_GROUP, FaceGroup};
use super::ray_grid::{RayBox, RayGrid};
use crate::geometry::space::triangles::ray_hit;
use crate::mesh::bvh::triangle_tree::TriangleTree;
use crate::mesh::tolerances;
use crate::mesh::{FaceId, Mesh};

/// Maximum number of ray and group comparisons, per ray and face of the input. After that the tree takes
/// over.
const MAX_TESTS_PER_ITEM: usize = 64;

/// Ray: its start, and its length in lengths of the direction.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RayStart {
    pub point: DVec3,
    pub reach: f64,
}

/// Mesh prepared for queries with parallel rays.
pub(crate) struct ParallelRays<'a> {
    mesh: &'a Mesh,
    /// The faces that have an area.
    faces: Vec<u32>,
    /// Centre and half extents of the box of each group.
    boxes: Vec<[Vec3; 2]>,
    /// Exceeds the rounding of projected coordinates.
    slack: f32,
}

impl<'a> ParallelRays<'a> {
    /// Prepares all faces of a mesh that have an area.
    pub(crate) fn new(mesh: &'a Mesh) -> Self {
        let (middle, half) = mesh.extents.ball();
        let slack = (tolerances::RAY_BOX_OF_MESH * (half + middle.length())) as f32;
        let has_area = |face: &u32| !mesh.is_degenerate(FaceId(*face));
        let faces: Vec<u32> = (0..mesh.triangles.len() as u32).filter(has_area).collect();
        let boxes = faces.chunks(FACES_PER_GROUP).map(|group| {
            let corners = group.iter().flat_map(|face| mesh.corners(FaceId(*face)));
            let (low, high) = corners
                .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
            [((low + high) / 2.0).as_vec3(), ((high - low) / 2.0).as_vec3()]
        });
        let boxes = boxes.collect();
        Self { mesh, faces, boxes, slack }
    }

    /// For each ray in a unit `direction`, whether a face is nearer than its reach. A face that contains the
    /// start may be met or not.
    ///
    /// Without `tree`, the result is `None` if the sweep would take too long. Callers with many parallel
    /// directions build the tree first, so that no task waits for another to build it.
    pub(crate) fn blocked(
        &self,
        rays: &[RayStart],
        direction: DVec3,
        tree: Option<&TriangleTree>,
    ) -> Option<Vec<bool>> {
        let mut blocked = vec![false; rays.len()];
        if self.sweep(rays, direction, &mut blocked).is_none() {
            let tree = tree?;
            for (blocked, ray) in blocked.iter_mut().zip(rays) {
                *blocked = *blocked || tree.is_blocked(ray.point, direction, ray.reach);
            }
        }
        Some(blocked)
    }

    /// Compares each group of faces with the rays that it covers; `None` if that takes too long.
    fn sweep(&self, rays: &[RayStart], direction: DVec3, blocked: &mut [bool]) -> Option<()> {
        let (across, up) = direction.any_orthonormal_pair();
        let project = |p: DVec3| [p.dot(across) as f32, p.dot(up) as f32, p.dot(direction) as f32];
        let (grid, mut sorted) = RayGrid::sort(rays.iter().map(|ray| (project(ray.point), ray.reach as f32)));
        let corners: Vec<[f32; 3]> = self.mesh.positions.iter().map(|p| project(*p)).collect();
        let axes = [across.as_vec3(), up.as_vec3(), direction.as_vec3()];
        let mut patience = MAX_TESTS_PER_ITEM * (rays.len() + self.faces.len());
        for (faces, [middle, half]) in self.faces.chunks(FACES_PER_GROUP).zip(&self.boxes) {
            let around = box_along(&axes, *middle, *half, self.slack);
            patience = patience.checked_sub(grid.cells(&around) / FACES_PER_GROUP)?;
            if !grid.may_meet(&around) {
                continue;
            }
            let of = |face: u32| {
                let [a, b, c] = self.mesh.triangles[face as usize];
                [corners[a as usize], corners[b as usize], corners[c as usize]]
            };
            let group = FaceGroup::new(faces, of, self.slack);
            for range in grid.rows(&group.around) {
                patience = patience.checked_sub(range.len())?;
                for ray in &mut sorted[range] {
                    let mut may_meet = if group.around.is_beside(ray) { 0 } else { group.may_meet(ray) };
                    while may_meet != 0 {
                        let face = FaceId(faces[may_meet.trailing_zeros() as usize]);
                        may_meet &= may_meet - 1;
                        let RayStart { point, reach } = rays[ray.id as usize];
                        if ray_hit(&self.mesh.corners(face), point, direction, reach).is_some() {
                            blocked[ray.id as usize] = true;
                            ray.from = f32::INFINITY;
                            break;
                        }
                    }
                }
            }
        }
        Some(())
    }
}

/// Bounding box, along other axes, of a box given by its centre and half extents.
#[inline]
fn box_along(axes: &[Vec3; 3], middle: Vec3, half: Vec3, slack: f32) -> RayBox {
    let (mut low, mut high) = ([0.0; 3], [0.0; 3]);
    for axis in 0..3 {
        let (at, reach) = (axes[axis].dot(middle), axes[axis].abs().dot(half) + slack);
        low[axis] = at - reach;
        high[axis] = at + reach;
    }
    RayBox { low, high }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::numbers::noise::hash;
    use crate::mesh::Soup;

    /// Point in the cube from -1 to 1.
    fn random_point(n: u32) -> DVec3 {
        let part = |axis: u64| hash(axis, &[u64::from(n)]) as f64 / u64::MAX as f64 * 2.0 - 1.0;
        DVec3::new(part(0), part(1), part(2))
    }

    fn tree(mesh: &Mesh) -> TriangleTree {
        TriangleTree::new((0..mesh.triangles.len() as u32).map(|face| mesh.corners(FaceId(face))).collect())
    }

    /// Triangles of a size in a cube, and one that covers all of it.
    fn mesh(count: u32, size: f64) -> Mesh {
        let corner = |k: u32| random_point(k / 3 + 1000) + size * random_point(k + 5000);
        let mut positions: Vec<DVec3> = (0..3 * count).map(corner).collect();
        positions.extend([
            DVec3::new(-9.0, -9.0, 0.9),
            DVec3::new(9.0, -9.0, 0.8),
            DVec3::new(0.0, 9.0, 0.95),
        ]);
        let triangles = (0..=count).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
        Mesh::build(Soup { positions, triangles, ..Soup::default() })
    }

    #[test]
    fn parallel_rays_match_brute_force_over_all_triangles() {
        // Many small triangles; few; needles; and large ones that force the use of the tree.
        for (count, size, rays) in
            [(600, 0.1, 800), (7, 0.5, 90), (300, 0.02, 800), (2500, 3.0, 1500), (3, 0.1, 1), (3, 0.1, 0)]
        {
            let mesh = mesh(count, size);
            let (parallel, tree) = (ParallelRays::new(&mesh), tree(&mesh));
            let starts: Vec<RayStart> = (0..rays)
                .map(|n| RayStart {
                    point: random_point(n + 20_000),
                    reach: [0.3, 9.0, f64::INFINITY][n as usize % 3],
                })
                .collect();
            let mut met = 0;
            for n in 0..12 {
                let direction = if n == 0 { DVec3::Z } else { random_point(n + 30_000).normalize() };
                let found = parallel.blocked(&starts, direction, Some(&tree)).expect("an answer");
                for (ray, found) in starts.iter().zip(found) {
                    let wanted = (0..mesh.triangles.len() as u32).any(|face| {
                        ray_hit(&mesh.corners(FaceId(face)), ray.point, direction, ray.reach).is_some()
                    });
                    assert_eq!(found, wanted, "{count} {size} {ray:?} {direction}");
                    met += u32::from(found);
                }
            }
            assert!(rays < 90 || met > 10, "{met}");
            let without = parallel.blocked(&starts, DVec3::Z, None).is_some();
            assert_eq!(without, size < 2.0, "{count} {size}");
        }
    }

    #[test]
    fn parallel_rays_with_collinear_or_equal_starts_match_the_tree() {
        let mesh = mesh(200, 0.3);
        let parallel = ParallelRays::new(&mesh);
        for step in [DVec3::ZERO, DVec3::X * 0.01, DVec3::Z * 0.01] {
            let starts: Vec<RayStart> =
                (0..50).map(|n| RayStart { point: step * f64::from(n), reach: 5.0 }).collect();
            let tree = tree(&mesh);
            let found = parallel.blocked(&starts, DVec3::Z, Some(&tree)).expect("an answer");
            let wanted: Vec<bool> =
                starts.iter().map(|ray| tree.is_blocked(ray.point, DVec3::Z, ray.reach)).collect();
            assert_eq!(found, wanted);
        }
    }
}
