//! `thin`: edges of thin walls, whose arcs would rise by more than half of the wall thickness.
//!
//! Blades, fins and plates have long edges whose normals turn at their ends. Arcs over these edges would make
//! both sides swell. A shell is as thin, but both its walls bend in the same direction and keep their
//! distance.

use crate::parallel::prelude::*;
use glam::{DVec3, Vec3};

use crate::geometry::space::bounds::Bounds;
use crate::geometry::space::triangles::{ray_hit, unit_normal};
use crate::mesh::bvh::box_tree::BoxTree;
use crate::mesh::tolerances::RAY_BOX_OF_MESH;
use crate::mesh::{FaceId, Mesh};
use crate::parallel::task_size::MIN_TASK_ITEMS;
use crate::surface::tolerances;
use crate::surface::{EdgeArc, SmoothNormals};

/// Maximum rise of an arc, and maximum change of the thickness, as a share of the wall thickness.
const MAX_RISE_OF_THICKNESS: f64 = 0.5;

/// Ray from below the middle of an edge to the opposite wall.
struct WallRay {
    edge: usize,
    start: DVec3,
    /// Normal in the middle of the arc.
    normal: DVec3,
    reach: f64,
    rise: f64,
}

impl WallRay {
    fn of(mesh: &Mesh, smooth: &SmoothNormals, edge: usize, ends: [u32; 2]) -> Self {
        let arc = EdgeArc::over(mesh, smooth, ends);
        let (height, normal) = (arc.height(), arc.middle_normal());
        let rise = height.dot(normal);
        let [a, b] = mesh.ends(edge);
        let start = (a + b) / 2.0 - normal * (tolerances::RAY_OFFSET_OF_RISE * rise.abs());
        Self { edge, start, normal, reach: rise.abs() / MAX_RISE_OF_THICKNESS, rise }
    }
}

/// The edges of thin walls, in order. `edges` are given with the smooth vertices at their ends.
pub(crate) fn thin(mesh: &Mesh, smooth: &SmoothNormals, edges: &[(usize, [u32; 2])]) -> Vec<usize> {
    if edges.is_empty() {
        return Vec::new();
    }
    let questions: Vec<WallRay> =
        edges.par_iter().map(|(edge, ends)| WallRay::of(mesh, smooth, *edge, *ends)).collect();
    let ends: Vec<DVec3> = questions.iter().flat_map(|q| [q.start, q.start - q.normal * q.reach]).collect();
    let rays: Vec<[u32; 3]> = (0..questions.len() as u32).map(|k| [2 * k, 2 * k + 1, 2 * k + 1]).collect();
    let around_rays = Bounds::of(ends.iter().copied());
    let tree = BoxTree::new(&ends, &rays, &[], around_rays.low, around_rays.high);
    let (middle, radius) = mesh.extents.ball();
    // Exceeds all rounding errors.
    let slack = RAY_BOX_OF_MESH * (radius + middle.length());
    // The opposite wall is where the ray leaves the body; faces that touch the edge are excluded.
    let is_wall = |q: &WallRay, face: u32| {
        let outward = Vec3::from_array(mesh.face_normals[face as usize]).as_dvec3();
        let corners = mesh.triangles[face as usize];
        mesh.body(face) == mesh.body(mesh.edges.faces(q.edge).list()[0])
            && outward.dot(q.normal) < 0.0
            && !mesh.edges.vertices[q.edge].iter().any(|v| corners.contains(v))
    };
    let hits_of = |(run, triangles): (usize, &[[u32; 3]])| {
        let (mut stack, mut hits) = (Vec::new(), Vec::new());
        for (face, triangle) in (run * MIN_TASK_ITEMS..).zip(triangles) {
            let corners = triangle.map(|v| mesh.positions[v as usize]);
            let Bounds { low, high } = Bounds::of(corners).grown(slack);
            tree.near(&tree.box_of([low, high, high]), &mut stack, |number| {
                let (q, face) = (&questions[number as usize], face as u32);
                let hit = ray_hit(&corners, q.start, -q.normal, q.reach).filter(|_| is_wall(q, face));
                hits.extend(hit.map(|thickness| (number, thickness, face)));
            });
        }
        hits
    };
    let runs = mesh.triangles.par_chunks(MIN_TASK_ITEMS).enumerate();
    let hits: Vec<Vec<(u32, f64, u32)>> = runs.map(hits_of).collect();
    let mut walls: Vec<Option<(f64, u32)>> = vec![None; questions.len()];
    for (number, thickness, face) in hits.into_iter().flatten() {
        let wall = &mut walls[number as usize];
        if wall.is_none_or(|known| (thickness, face) < known) {
            *wall = Some((thickness, face));
        }
    }
    let is_thin = |(q, wall): &(&WallRay, Option<(f64, u32)>)| {
        wall.is_some_and(|(thickness, face)| {
            (q.rise + swelling(mesh, smooth, face)).abs() > MAX_RISE_OF_THICKNESS * thickness
        })
    };
    questions.iter().zip(walls).filter(is_thin).map(|(question, _)| question.edge).collect()
}

/// Mean rise of the arcs over the sides of a face; negative where it is concave.
fn swelling(mesh: &Mesh, smooth: &SmoothNormals, face: u32) -> f64 {
    let Some(corners) = smooth.corners_of(face) else { return 0.0 };
    let normal = unit_normal(mesh.corners(FaceId(face)));
    let rise = |k: usize| {
        let (a, b) = (corners[k], corners[(k + 1) % 3]);
        EdgeArc::over(mesh, smooth, [a.min(b), a.max(b)]).height().dot(normal)
    };
    (0..3).map(rise).sum::<f64>() / 3.0
}

#[cfg(test)]
mod tests {
    use super::super::subdivision::refined;
    use super::*;
    use crate::mesh::Soup;

    /// Two square sheets back to back at a distance. The normals make each bend outward, or inward if `bend`
    /// is negative.
    fn double_sheet(bend: [f64; 2], apart: f64) -> (Mesh, SmoothNormals) {
        let mut soup = Soup::default();
        for (sheet, bend) in bend.into_iter().enumerate() {
            let (up, first) = (1.0 - 2.0 * sheet as f64, soup.positions.len() as u32);
            for (x, y) in [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)] {
                soup.positions.push(DVec3::new(x, y, up * apart / 2.0));
                let normal = DVec3::new(bend * (x - 2.0), 0.0, up).normalize();
                soup.normals.push(normal.as_vec3().to_array());
            }
            let quad = [[0, 1, 2], [0, 2, 3]].map(|t: [u32; 3]| t.map(|v| v + first));
            soup.triangles.extend(if sheet == 0 { quad } else { quad.map(|[a, b, c]| [a, c, b]) });
        }
        soup.corner_normals = soup.triangles.clone();
        let mesh = Mesh::build(soup);
        let smooth = SmoothNormals::rounded(&mesh);
        (mesh, smooth)
    }

    fn thin_edge_count(bend: [f64; 2], apart: f64) -> usize {
        let (mesh, smooth) = double_sheet(bend, apart);
        let edges: Vec<(usize, [u32; 2])> = (0..mesh.edges.len())
            .filter_map(|edge| Some((edge, smooth.across(&mesh, edge)?)))
            .filter(|(_, ends)| EdgeArc::over(&mesh, &smooth, *ends).height().length() > 1e-6)
            .collect();
        assert_eq!(edges.len(), 6, "two long sides and a diagonal of each sheet bend");
        thin(&mesh, &smooth, &edges).len()
    }

    #[test]
    fn thin_edges_are_found_on_blades_and_not_on_shells() {
        // Both sheets rise by 0.25 over their sides.
        assert_eq!(thin_edge_count([0.13, 0.13], 0.4), 6, "a blade");
        assert_eq!(thin_edge_count([0.13, 0.13], 0.6), 0, "a cushion");
        assert_eq!(thin_edge_count([0.13, -0.13], 0.4), 0, "a shell");
    }

    #[test]
    fn refinement_keeps_the_thickness_of_blades() {
        let thickness = |bend: [f64; 2], apart: f64| {
            let (mesh, smooth) = double_sheet(bend, apart);
            let want =
                |ends: [DVec3; 2], normals: [DVec3; 2]| EdgeArc::new(ends, normals).height().length() * 100.0;
            let finer = refined(&mesh, &smooth, |_, _| true, want).expect("normals turn");
            let (low, high) = finer
                .mesh
                .positions
                .iter()
                .fold((f64::MAX, f64::MIN), |(low, high), p| (low.min(p.z), high.max(p.z)));
            high - low
        };
        // Each sheet rises by 0.25.
        assert!((thickness([0.13, 0.13], 0.4) - 0.4).abs() < 1e-12, "a blade");
        assert!((thickness([0.13, 0.13], 0.6) - 1.1).abs() < 0.05, "a cushion");
        assert!((thickness([0.13, -0.13], 0.4) - 0.65).abs() < 0.05, "a shell");
    }
}
