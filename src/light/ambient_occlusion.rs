//! [`ambient_visibility`]: ambient visibility, the share of the sky that each vertex of a mesh sees.
//!
//! Source: Zhukov, Iones and Kronin, "An ambient light illumination model", Rendering Techniques 1998: the
//! cosine-weighted share of a hemisphere that nothing near obscures.
//!
//! All vertices use the same directions. So the result of a direction changes at few places, and the total
//! has no noise to smooth.

use crate::parallel::prelude::*;
use glam::DVec3;

use super::tolerances;
use crate::geometry::numbers::portable_math::{cos, sin};
use crate::mesh::bvh::rays::parallel_rays::{ParallelRays, RayStart};
use crate::mesh::bvh::triangle_tree::TriangleTree;
use crate::mesh::{FaceId, Mesh};

/// Number of directions over the whole sphere; nearly half of them are above a vertex.
const DIRECTION_COUNT: usize = 256;

/// Smallest cosine of a direction that counts. Lower ones contribute little, and their rays pass the most
/// faces.
const MIN_RAY_COSINE: f64 = 0.1;

/// Share of the sky that each vertex sees on the outer side of the surface, from 0 (none) to 1 (all).
///
/// Only obstacles within `reach` of a position (world units) count; with infinity all do. Vertices without a
/// normal see everything, and so do vertices of faces that are not `asked`. An empty `asked` means all faces.
#[must_use]
pub fn ambient_visibility(mesh: &Mesh, asked: &[bool], reach: impl Fn(DVec3) -> f64 + Sync) -> Vec<f64> {
    let rays = ParallelRays::new(mesh);
    let directions = directions();
    let (mut normals, lifts) = normals(mesh);
    if !asked.is_empty() {
        let mut is_asked = vec![false; normals.len()];
        let faces = mesh.triangles.iter().zip(asked).filter(|(_, asked)| **asked);
        faces.flat_map(|(face, _)| face).for_each(|v| is_asked[*v as usize] = true);
        normals.iter_mut().zip(is_asked).filter(|(_, asked)| !asked).for_each(|(n, _)| *n = DVec3::ZERO);
    }
    // Starts slightly above the surface, so that faces around a hollow block as well.
    let start = |v: usize| {
        let at = mesh.positions[v];
        RayStart { point: at + normals[v] * lifts[v], reach: reach(at) }
    };
    let starts: Vec<RayStart> = (0..mesh.positions.len()).into_par_iter().map(start).collect();
    let blocked_bits = |direction: DVec3, tree: Option<&TriangleTree>| {
        let above = |v: &usize| direction.dot(normals[*v]) > MIN_RAY_COSINE;
        let facing_vertices: Vec<usize> = (0..starts.len()).filter(above).collect();
        let of: Vec<RayStart> = facing_vertices.iter().map(|v| starts[*v]).collect();
        let mut bits = vec![0u64; starts.len().div_ceil(64)];
        for (v, blocked) in facing_vertices.iter().zip(rays.blocked(&of, direction, tree)?) {
            bits[v / 64] |= u64::from(blocked) << (v % 64);
        }
        Some(bits)
    };
    let mut blocked: Vec<Option<Vec<u64>>> =
        directions.par_iter().with_max_len(1).map(|d| blocked_bits(*d, None)).collect();
    if blocked.iter().any(Option::is_none) {
        let faces = (0..mesh.triangles.len() as u32).map(FaceId).filter(|face| !mesh.is_degenerate(*face));
        let tree = TriangleTree::new(faces.map(|face| mesh.corners(face)).collect());
        let left = blocked.par_iter_mut().zip(&directions).filter(|(blocked, _)| blocked.is_none());
        left.for_each(|(blocked, direction)| *blocked = blocked_bits(*direction, Some(&tree)));
    }
    let blocked: Vec<Vec<u64>> = blocked.into_iter().flatten().collect();
    let share = |v: usize| {
        let (mut open_weight, mut total_weight) = (0.0, 0.0);
        for (direction, blocked) in directions.iter().zip(&blocked) {
            let cosine = direction.dot(normals[v]);
            if cosine > MIN_RAY_COSINE {
                total_weight += cosine;
                if blocked[v / 64] >> (v % 64) & 1 == 0 {
                    open_weight += cosine;
                }
            }
        }
        if total_weight > 0.0 { open_weight / total_weight } else { 1.0 }
    };
    (0..starts.len()).into_par_iter().map(share).collect()
}

/// Directions spread evenly over the sphere.
///
/// Source: Vogel, "A better way to construct the sunflower head", 1979, on a sphere.
fn directions() -> Vec<DVec3> {
    let turn = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    (0..DIRECTION_COUNT)
        .map(|k| {
            let z = 1.0 - (2 * k + 1) as f64 / DIRECTION_COUNT as f64;
            let (r, angle) = ((1.0 - z * z).sqrt(), k as f64 * turn);
            DVec3::new(r * cos(angle), r * sin(angle), z)
        })
        .collect()
}

/// Unit normal of each vertex, 0 where no face has area, and the height above the surface where its rays
/// start: a share of the mean length of its edges.
fn normals(mesh: &Mesh) -> (Vec<DVec3>, Vec<f64>) {
    let mut normals = vec![DVec3::ZERO; mesh.positions.len()];
    let mut contacts = vec![0.0f64; mesh.positions.len()];
    for (id, face) in mesh.triangles.iter().enumerate() {
        let area = mesh.area_vector(FaceId::from(id));
        let contact = mesh.extent(FaceId::from(id)).contact;
        for v in face {
            normals[*v as usize] += area;
            contacts[*v as usize] = contacts[*v as usize].max(contact);
        }
    }
    let mut lengths = vec![(0.0, 0u32); mesh.positions.len()];
    for [a, b] in &mesh.edges.vertices {
        let length = mesh.positions[*a as usize].distance(mesh.positions[*b as usize]);
        for v in [a, b] {
            lengths[*v as usize].0 += length;
            lengths[*v as usize].1 += 1;
        }
    }
    let lift = |((sum, count), contact): ((f64, u32), f64)| {
        (tolerances::SKY_PROBE_OF_EDGE * sum / f64::from(count.max(1))).max(contact)
    };
    let lifts = lengths.into_iter().zip(contacts).map(lift).collect();
    (normals.into_iter().map(DVec3::normalize_or_zero).collect(), lifts)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::numbers::noise::hash;
    use crate::mesh::Soup;

    /// Grid of squares over a parallelogram.
    fn add_sheet(soup: &mut Soup, corner: DVec3, u: DVec3, v: DVec3, cells: u32) {
        let first = soup.positions.len() as u32;
        for i in 0..=cells {
            for k in 0..=cells {
                let part = |n: u32| f64::from(n) / f64::from(cells);
                soup.positions.push(corner + u * part(i) + v * part(k));
            }
        }
        for i in 0..cells {
            for k in 0..cells {
                let a = first + i * (cells + 1) + k;
                let [b, c, d] = [a + cells + 1, a + cells + 2, a + 1];
                soup.triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
    }

    fn unlimited_reach(_: DVec3) -> f64 {
        f64::INFINITY
    }

    fn visibility_at(mesh: &Mesh, openness: &[f64], p: DVec3) -> f64 {
        let local = p - mesh.origin;
        let vertex = mesh.positions.iter().position(|q| q.distance(local) < 1e-6).expect("a vertex");
        openness[vertex]
    }

    #[test]
    fn ambient_visibility_of_open_and_covered_sheets_matches_view_factors() {
        let mut soup = Soup::default();
        add_sheet(&mut soup, DVec3::new(-1.0, -1.0, 0.0), DVec3::X * 2.0, DVec3::Y * 2.0, 4);
        let alone = Mesh::build(soup.clone());
        assert!(ambient_visibility(&alone, &[], unlimited_reach).iter().all(|o| *o == 1.0));
        // A square of side 2 at height 1 covers a known part of the sky for the point below its middle. It is
        // the view factor of four rectangles with sides 1 and 1 at distance 1.
        add_sheet(&mut soup, DVec3::new(-1.0, -1.0, 1.0), DVec3::Y * 2.0, DVec3::X * 2.0, 4);
        let mesh = Mesh::build(soup);
        let r = 0.5_f64.sqrt();
        let covered =
            4.0 / std::f64::consts::TAU * 2.0 * r * crate::geometry::numbers::portable_math::atan2(r, 1.0);
        let found = visibility_at(&mesh, &ambient_visibility(&mesh, &[], unlimited_reach), DVec3::ZERO);
        assert!((found - (1.0 - covered)).abs() < 0.03, "{found} {}", 1.0 - covered);
        assert_eq!(visibility_at(&mesh, &ambient_visibility(&mesh, &[], |_| 0.9), DVec3::ZERO), 1.0);
    }

    #[test]
    fn ambient_visibility_at_the_foot_of_a_wall_matches_the_closed_form() {
        let mut soup = Soup::default();
        add_sheet(&mut soup, DVec3::new(0.0, -20.0, 0.0), DVec3::X * 20.0, DVec3::Y * 40.0, 8);
        add_sheet(&mut soup, DVec3::new(0.0, -20.0, 0.0), DVec3::Y * 40.0, DVec3::Z * 20.0, 8);
        let mesh = Mesh::build(soup);
        let found = ambient_visibility(&mesh, &[], unlimited_reach);
        // In the corner the normal is halfway, and a right-angled wedge is left: sin 45°.
        let corner = visibility_at(&mesh, &found, DVec3::ZERO);
        assert!((corner - 0.5_f64.sqrt()).abs() < 0.03, "{corner}");
        // On the floor, a long wall of height 20 leaves (1 + cos α)/2, where α is its elevation angle.
        for x in [2.5, 17.5] {
            let (found, wanted) =
                (visibility_at(&mesh, &found, DVec3::X * x), (1.0 + x / (x * x + 400.0).sqrt()) / 2.0);
            assert!((found - wanted).abs() < 0.04, "{x}: {found} {wanted}");
        }
    }

    #[test]
    fn ambient_visibility_is_one_on_a_box_and_zero_inside_a_closed_room() {
        let corner = |i: u32| DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2));
        let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let add = |soup: &mut Soup, low: DVec3, size: f64, inward: bool| {
            let first = soup.positions.len() as u32;
            soup.positions.extend((0..8).map(|i| low + size * corner(i)));
            let triangles = sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
            let wound = triangles.map(|[a, b, c]: [u32; 3]| if inward { [a, c, b] } else { [a, b, c] });
            soup.triangles.extend(wound.map(|t| t.map(|v| first + v)));
        };
        for inward in [false, true] {
            let mut alone = Soup::default();
            add(&mut alone, DVec3::ZERO, 1.0, inward);
            assert!(ambient_visibility(&Mesh::build(alone), &[], unlimited_reach).iter().all(|o| *o == 1.0));
        }
        let mut room = Soup::default();
        add(&mut room, DVec3::ZERO, 1.0, false);
        add(&mut room, DVec3::splat(-2.0), 5.0, false);
        let mesh = Mesh::build(room);
        let found = ambient_visibility(&mesh, &[], unlimited_reach);
        for (position, open) in mesh.positions.iter().zip(found) {
            let is_outside = (*position - DVec3::splat(0.5)).abs().max_element() > 1.0;
            assert_eq!(open, if is_outside { 1.0 } else { 0.0 }, "{position}");
        }
        assert!(ambient_visibility(&Mesh::default(), &[], unlimited_reach).is_empty());
    }

    #[test]
    fn ambient_visibility_does_not_depend_on_the_number_of_threads() {
        // Enough overlapping faces to make the rays use a tree.
        let part = |n: u32| hash(7, &[u64::from(n)]) as f64 / u64::MAX as f64 * 2.0 - 1.0;
        let point = |n: u32| DVec3::new(part(3 * n), part(3 * n + 1), part(3 * n + 2));
        let count = 1500;
        let positions = (0..3 * count).map(|k| point(k / 3) + 3.0 * point(k + 10_000)).collect();
        let triangles = (0..count).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
        let mesh = Mesh::build(Soup { positions, triangles, ..Soup::default() });
        let starts: Vec<RayStart> =
            mesh.positions.iter().step_by(2).map(|p| RayStart { point: *p, reach: f64::INFINITY }).collect();
        assert!(ParallelRays::new(&mesh).blocked(&starts, DVec3::Z, None).is_none());
        let on = |threads| {
            let pool = rayon_core::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
            pool.install(|| ambient_visibility(&mesh, &[], unlimited_reach))
        };
        assert_eq!(on(1), on(4));
    }
}
