//! [`BackFaces`]: groups of faces that form the back of a body.
//!
//! 1. Where the surface folds in the image, one of the two groups at the fold is behind the other.
//! 2. A group is a back if the folds where it is behind are longer than those where it is in front.
//!
//! The front of a body hides everything that its back hides, so this choice affects time only.

use std::sync::atomic::AtomicI32;
use std::sync::atomic::Ordering::Relaxed;

use crate::parallel::prelude::*;

use crate::mesh::DisjointSets;
use crate::mesh::EdgeSet;
use crate::mesh::{EdgeFaces, Mesh};
use crate::parallel::task_size::MIN_TASK_ITEMS;
use crate::view::View;

/// Fixed-point steps per user unit. Unlike floating-point sums, integer sums do not depend on their order.
const FIXED_POINT_STEPS_PER_UNIT: f64 = 16.0;
/// Groups of faces between folds of the image, and which of them are backs of bodies.
pub(crate) struct BackFaces {
    groups: DisjointSets,
    /// By the first face of a group: the length of the folds where it is behind its neighbour, minus that of
    /// the folds where it is in front.
    behind: Vec<AtomicI32>,
}

impl BackFaces {
    /// Classifies `groups` of faces that are connected across the `inner` edges, where the image does not
    /// fold.
    pub(crate) fn new(mesh: &Mesh, view: &View, inner: &EdgeSet, groups: DisjointSets) -> Self {
        let behind: Vec<AtomicI32> = mesh.triangles.par_iter().map(|_| AtomicI32::new(0)).collect();
        let outer = (0..mesh.edges.len()).into_par_iter().with_min_len(MIN_TASK_ITEMS);
        outer.filter(|edge| !inner.contains(*edge)).for_each(|edge| {
            let EdgeFaces::Two { faces, same_way: false } = mesh.edges.faces(edge) else { return };
            let [first, second] = faces.map(|face| groups.representative(face));
            if let Some((second_is_nearer, length)) = fold(mesh, view, edge, faces)
                && first != second
            {
                let (near, far) = if second_is_nearer { (second, first) } else { (first, second) };
                let length = (length * FIXED_POINT_STEPS_PER_UNIT) as i32;
                behind[far as usize].fetch_add(length, Relaxed);
                behind[near as usize].fetch_sub(length, Relaxed);
            }
        });
        Self { groups, behind }
    }

    /// First face of the group of a face.
    #[inline]
    pub(crate) fn group(&self, face: u32) -> u32 {
        self.groups.representative(face)
    }

    /// Whether a face is part of a back: along most of its folds, the neighbouring group is nearer to the
    /// eye.
    #[inline]
    pub(crate) fn contains(&self, face: u32) -> bool {
        self.behind[self.groups.representative(face) as usize].load(Relaxed) > 0
    }
}

/// Whether the second of two faces at an edge is in front of the first, and the length of the edge in the
/// image. There is none if the faces lie on different sides of the edge.
fn fold(mesh: &Mesh, view: &View, edge: usize, faces: [u32; 2]) -> Option<(bool, f64)> {
    let ends = mesh.edges.vertices[edge];
    let [from, to] = ends.map(|v| view.points[v as usize]);
    let along = (to - from).truncate();
    // Side of the edge on which a face lies, and how steeply it rises towards the eye from there.
    let rise = |face: u32| {
        let apex = mesh.triangles[face as usize].into_iter().find(|v| !ends.contains(v))?;
        let way = view.points[apex as usize] - from;
        let (side, t) = (along.perp_dot(way.truncate()), along.dot(way.truncate()));
        Some((side, (way.z - t / along.length_squared() * (to.z - from.z)) / side.abs()))
    };
    let [Some(first), Some(second)] = faces.map(rise) else { return None };
    (first.0 * second.0 > 0.0).then(|| (second.1 > first.1, along.length()))
}

#[cfg(test)]
mod tests {
    use glam::{DVec2, DVec3};

    use super::super::occluder_fusion::FusedOccluders;
    use crate::mesh::{FaceId, Mesh, Soup};
    use crate::scene::Camera;
    use crate::view::View;
    use crate::visibility::occlusion::tiled_triangles::TiledTriangles;
    use crate::visibility::tiles::tile_grid::TileGrid;
    use crate::visibility::view_tolerances::ViewTolerances;

    type Triangle = [DVec3; 3];

    /// Corners of each face in the world and in the image, and whether it is part of a back.
    fn far_sides(faces: &[Triangle]) -> Vec<(Triangle, Triangle, bool)> {
        let positions = faces.concat();
        let triangles = (0..faces.len() as u32).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
        let mesh = Mesh::build(Soup { positions, triangles, ..Soup::default() });
        let camera = Camera::three_quarter().with_frame(200.0, 200.0).fit_points(&faces.concat(), 0.05);
        let view = View::new(&mesh, &camera);
        let limits = ViewTolerances::new(&view.frame);
        let grid = TileGrid::new(DVec2::ZERO, DVec2::splat(200.0), 32);
        let triangles = TiledTriangles { mesh: &mesh, view: &view, grid: &grid, limits: &limits };
        let expanses = FusedOccluders::new(&triangles, grid.cell);
        let of_face = |face: u32| {
            let world = mesh.corners(FaceId(face)).map(|p| p + mesh.origin);
            let image = mesh.triangles[face as usize].map(|v| view.points[v as usize]);
            (world, image, expanses.is_far_side(face))
        };
        (0..mesh.triangles.len() as u32).map(of_face).collect()
    }

    /// Faces of a box, wound outward.
    fn cuboid() -> Vec<Triangle> {
        let corner = |k: u32| DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2));
        let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        quads.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).map(|t| t.map(corner)).collect()
    }

    #[test]
    fn far_side_of_a_box_is_its_back_faces_in_either_winding() {
        for is_outward in [true, false] {
            let wound = |[a, b, c]: Triangle| if is_outward { [a, b, c] } else { [a, c, b] };
            let found = far_sides(&cuboid().into_iter().map(wound).collect::<Vec<_>>());
            assert_eq!(found.iter().filter(|(.., is_far)| *is_far).count(), 6);
            // The three front sides meet at the nearest corner.
            let all = || found.iter().flat_map(|(world, image, _)| world.iter().zip(image));
            let nearest =
                all().max_by(|a, b| a.1.z.total_cmp(&b.1.z)).map_or(DVec3::NAN, |(world, _)| *world);
            for (world, _, is_far) in &found {
                let is_near = (0..3).any(|axis| world.iter().all(|p| p[axis] == nearest[axis]));
                assert_eq!(*is_far, !is_near, "{world:?}");
            }
        }
    }

    #[test]
    fn faces_with_nothing_in_front_are_not_far_sides() {
        let found = far_sides(&cuboid());
        let far: Vec<Triangle> =
            found.into_iter().filter(|(.., is_far)| *is_far).map(|(world, ..)| world).collect();
        assert_eq!(far.len(), 6);
        assert!(far_sides(&far).iter().all(|(.., is_far)| !is_far));
    }
}
