//! [`orient_surfaces`]: orients the surfaces of a shape so that winding numbers separate material from voids.
//!
//! Each surface is turned outward (see `mesh::orientation`). A closed surface inside others bounds a void if
//! the file winds it the opposite way, since nothing else distinguishes a void from an enclosed solid. It
//! counts as inside if the points just behind all its vertices are. Overlapping surfaces are solids,
//! independent of their winding, and merge with their neighbours.

use std::borrow::Cow;
use std::cmp::Ordering;

use glam::{DAffine3, DVec2, DVec3};
use robust::{Coord, Coord3D, orient2d, orient3d};

use super::cut_tolerances::CutTolerances;
use crate::geometry::numbers::portable_math::acos;
use crate::geometry::space::bounds::Bounds;
use crate::geometry::space::triangles::area_vector;
use crate::mesh::Edges;
use crate::mesh::components::orientation::{ConnectedTriangles, OrientedSurfaces};
use crate::scene::Geometry;

/// Maximum number of box and face tests per face. If it is exceeded, the shape keeps the winding of the file.
const MAX_TESTS_PER_FACE: usize = 64;

/// Orients the surfaces of a shape. `one` maps each vertex to a representative of its position.
pub(crate) fn orient_surfaces<'a>(shape: &'a Geometry, one: &[u32]) -> Cow<'a, Geometry> {
    let corners = |t: &[u32; 3]| t.map(|v| one.get(v as usize).copied().unwrap_or(v));
    let is_sound = |[a, b, c]: &[u32; 3]| a != b && b != c && c != a;
    let (faces, triangles): (Vec<usize>, Vec<[u32; 3]>) =
        shape.triangles.iter().map(corners).enumerate().filter(|(_, t)| is_sound(t)).unzip();
    let edges = Edges::build(shape.positions.len(), &triangles);
    let mesh =
        ConnectedTriangles { positions: &shape.positions, triangles: &triangles, parts: &[], edges: &edges };
    let mut surfaces = OrientedSurfaces::new(&mesh);
    let inset = CutTolerances::of(shape, &DAffine3::IDENTITY).plane;
    if turn_voids(&mesh, &mut surfaces, inset).is_none() || surfaces.is_turned.is_empty() {
        return Cow::Borrowed(shape);
    }
    let mut shape = shape.clone();
    for (face, _) in faces.into_iter().zip(&surfaces.is_turned).filter(|(_, turned)| **turned) {
        shape.turn(face);
    }
    Cow::Owned(shape)
}

impl Geometry {
    /// Reverses a triangle with the attributes of its corners and sides.
    fn turn(&mut self, triangle: usize) {
        for list in [&mut self.triangles, &mut self.corner_normals, &mut self.corner_uvs] {
            if let Some(own) = list.get_mut(triangle) {
                own.swap(1, 2);
            }
        }
        // The sides 0-1, 1-2, 2-0 become 0-2, 2-1, 1-0.
        if let Some(marks) = self.edge_marks.get_mut(triangle) {
            marks.swap(0, 2);
        }
    }
}

/// Reverses closed surfaces that bound voids; none if the limit of tests is exceeded. Points are tested at a
/// distance of `inset` behind their vertices.
fn turn_voids(mesh: &ConnectedTriangles, surfaces: &mut OrientedSurfaces, inset: f64) -> Option<()> {
    let mut budget = MAX_TESTS_PER_FACE * mesh.triangles.len();
    let mut is_void = closed_in_boxes(mesh, surfaces, &mut budget)?;
    if !is_void.contains(&true) {
        return Some(());
    }
    let ways = file_winding_signs(mesh, surfaces);
    let mut rays = VertexRays::new(mesh, surfaces, (&is_void, inset));
    rays.cross(mesh, surfaces, &ways, budget)?;
    for ray in &rays.starts {
        let surface = ray.surface as usize;
        is_void[surface] &= ray.winding * ways[surface] < 0;
    }
    surfaces.is_turned.resize(mesh.triangles.len(), false);
    for (turned, surface) in surfaces.is_turned.iter_mut().zip(&surfaces.surface_of_face.set_of_face) {
        *turned ^= is_void[*surface as usize];
    }
    if !surfaces.is_turned.contains(&true) {
        surfaces.is_turned.clear();
    }
    Some(())
}

/// Winding of each surface in the file: 1 if most of its area faces outward, -1 if inward.
fn file_winding_signs(mesh: &ConnectedTriangles, surfaces: &OrientedSurfaces) -> Vec<i32> {
    let mut outward = vec![0.0; surfaces.is_closed.len()];
    for (face, (corners, surface)) in
        mesh.triangles.iter().zip(&surfaces.surface_of_face.set_of_face).enumerate()
    {
        let area = area_vector(corners.map(|v| mesh.positions[v as usize])).length();
        outward[*surface as usize] += if is_turned(surfaces, face) { -area } else { area };
    }
    outward.into_iter().map(|area| if area < 0.0 { -1 } else { 1 }).collect()
}

fn is_turned(surfaces: &OrientedSurfaces, face: usize) -> bool {
    surfaces.is_turned.get(face).copied().unwrap_or_default()
}

/// Whether the box of each closed surface lies in the box of another one, boundaries included.
fn closed_in_boxes(
    mesh: &ConnectedTriangles,
    surfaces: &OrientedSurfaces,
    budget: &mut usize,
) -> Option<Vec<bool>> {
    let count = surfaces.is_closed.len();
    let mut boxes = vec![Bounds::EMPTY; count];
    for (corners, surface) in mesh.triangles.iter().zip(&surfaces.surface_of_face.set_of_face) {
        let around = &mut boxes[*surface as usize];
        *around = around.union(Bounds::of(corners.map(|v| mesh.positions[v as usize])));
    }
    let mut closed: Vec<usize> = (0..count).filter(|surface| surfaces.is_closed[*surface]).collect();
    // Of two boxes with the same minimum x, the larger comes first.
    let key = |surface: usize| {
        let Bounds { low, high } = boxes[surface];
        [low.x, low.y, low.z, -high.x, -high.y, -high.z]
    };
    closed.sort_by(|a, b| {
        let pairs = key(*a).into_iter().zip(key(*b));
        pairs.fold(Ordering::Equal, |order, (p, q)| order.then(p.total_cmp(&q))).then(a.cmp(b))
    });
    let mut inside = vec![false; count];
    for (k, inner) in closed.iter().enumerate() {
        // The box of an outer surface has a lower minimum, so it comes earlier.
        for outer in closed[..k].iter().rev() {
            *budget = budget.checked_sub(1)?;
            if boxes[*outer].contains(&boxes[*inner]) && boxes[*outer] != boxes[*inner] {
                inside[*inner] = true;
                break;
            }
        }
    }
    Some(inside)
}

/// Ray along x, with the winding number of other surfaces around its start, by the winding of the file.
struct VertexRay {
    from: DVec3,
    surface: u32,
    winding: i32,
}

/// Rays in rows of equal height along y. Each row is sorted by the z of the starts.
struct VertexRays {
    starts: Vec<VertexRay>,
    /// Start of each row, and the end of the last.
    rows: Vec<usize>,
    low: f64,
    height: f64,
}

impl VertexRays {
    /// Rays that start just behind the vertices of some surfaces.
    ///
    /// Source: Baerentzen and Aanaes, "Signed distance computation using the angle weighted pseudonormal",
    /// 2005: the inward direction at a vertex is against its angle-weighted normal.
    fn new(mesh: &ConnectedTriangles, surfaces: &OrientedSurfaces, (wanted, inset): (&[bool], f64)) -> Self {
        let mut corners: Vec<((u32, u32), DVec3)> = Vec::new();
        for (face, (t, surface)) in
            mesh.triangles.iter().zip(&surfaces.surface_of_face.set_of_face).enumerate()
        {
            if !wanted[*surface as usize] {
                continue;
            }
            let corner_position = |k: usize| mesh.positions[t[k % 3] as usize];
            let normal = (corner_position(1) - corner_position(0))
                .cross(corner_position(2) - corner_position(0))
                .normalize_or_zero();
            let outward = if is_turned(surfaces, face) { -normal } else { normal };
            for (k, v) in t.iter().enumerate() {
                let sides = [1, 2].map(|n| (corner_position(k + n) - corner_position(k)).normalize_or_zero());
                let angle = acos(sides[0].dot(sides[1]).clamp(-1.0, 1.0));
                corners.push(((*v, *surface), outward * angle));
            }
        }
        // Stable, so that sums are taken in the order of faces.
        corners.sort_by_key(|corner| corner.0);
        let ray = |vertex_corners: &[((u32, u32), DVec3)]| {
            let ((v, surface), _) = vertex_corners[0];
            let outward = vertex_corners.iter().map(|corner| corner.1).sum::<DVec3>().normalize_or_zero();
            VertexRay { from: mesh.positions[v as usize] - outward * inset, surface, winding: 0 }
        };
        let mut starts: Vec<VertexRay> = corners.chunk_by(|a, b| a.0 == b.0).map(ray).collect();
        let y = |ray: &VertexRay| ray.from.y;
        let low = starts.iter().map(y).fold(f64::INFINITY, f64::min);
        let high = starts.iter().map(y).fold(f64::NEG_INFINITY, f64::max);
        let count = starts.len().isqrt().max(1);
        let mut rays =
            Self { starts: Vec::new(), rows: vec![0; count + 1], low, height: (high - low) / count as f64 };
        starts.sort_by(|a, b| {
            let rows = rays.row(a.from.y).cmp(&rays.row(b.from.y));
            rows.then(a.from.z.total_cmp(&b.from.z))
        });
        rays.rows = (0..=count).map(|row| starts.partition_point(|ray| rays.row(ray.from.y) < row)).collect();
        rays.starts = starts;
        rays
    }

    /// Row of a height, clamped to the first and last row.
    fn row(&self, y: f64) -> usize {
        (((y - self.low) / self.height).max(0.0) as usize).min(self.rows.len() - 2)
    }

    /// Counts crossings of rays with closed surfaces except their own; none if the limit of tests is
    /// exceeded.
    fn cross(
        &mut self,
        mesh: &ConnectedTriangles,
        surfaces: &OrientedSurfaces,
        surface_signs: &[i32],
        mut budget: usize,
    ) -> Option<()> {
        for (face, (corners, surface)) in
            mesh.triangles.iter().zip(&surfaces.surface_of_face.set_of_face).enumerate()
        {
            if !surfaces.is_closed[*surface as usize] {
                continue;
            }
            let corners = corners.map(|v| mesh.positions[v as usize]);
            let sign = surface_signs[*surface as usize] * if is_turned(surfaces, face) { -1 } else { 1 };
            let [a, b, c] = corners;
            let (low, high) = (a.min(b).min(c), a.max(b).max(c));
            for row in self.row(low.y)..=self.row(high.y) {
                budget = budget.checked_sub(1)?;
                let row_rays = &mut self.starts[self.rows[row]..self.rows[row + 1]];
                let first = row_rays.partition_point(|ray| ray.from.z < low.z);
                for ray in row_rays[first..].iter_mut().take_while(|ray| ray.from.z <= high.z) {
                    budget = budget.checked_sub(1)?;
                    if ray.surface != *surface && ray.from.x < high.x {
                        ray.winding += sign * ray_crossing(corners, ray.from);
                    }
                }
            }
        }
        Some(())
    }
}

/// Crossing of a triangle and a ray from a point along x: 1 from behind, -1 from the front, 0 for none. A ray
/// through an edge crosses exactly one of its two triangles.
///
/// Source: crossing numbers of polygons, Haines, "Point in polygon strategies", Graphics Gems IV, 1994, with
/// exact signs.
fn ray_crossing([a, b, c]: [DVec3; 3], p: DVec3) -> i32 {
    let flat = |p: DVec3| DVec2::new(p.y, p.z);
    let is_left = |q: DVec3, r: DVec3| {
        let (q, r) = if q.z < r.z { (flat(q), flat(r)) } else { (flat(r), flat(q)) };
        let coord = |p: DVec2| Coord { x: p.x, y: p.y };
        (q.y > p.z) != (r.y > p.z) && orient2d(coord(q), coord(r), coord(flat(p))) > 0.0
    };
    let is_within = is_left(a, b) ^ is_left(b, c) ^ is_left(c, a);
    let [ay, by, cy] = [a, b, c].map(|p| Coord { x: p.y, y: p.z });
    let coord = |p: DVec3| Coord3D { x: p.x, y: p.y, z: p.z };
    if !is_within {
        return 0;
    }
    // The first is positive if the normal points along x, the second if the point is behind the triangle.
    let (along, behind) = (orient2d(ay, by, cy), orient3d(coord(a), coord(b), coord(c), coord(p)));
    if along > 0.0 && behind > 0.0 {
        1
    } else if along < 0.0 && behind < 0.0 {
        -1
    } else {
        0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cubes by centre and half side; the flag winds a cube inward.
    fn cubes(of: &[(DVec3, f64, bool)]) -> Geometry {
        let mut shape = Geometry::default();
        for (middle, half, inward) in of {
            let first = shape.positions.len() as u32;
            let corner =
                |k: u32| DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2)) * 2.0 - 1.0;
            shape.positions.extend((0..8).map(|k| *middle + corner(k) * *half));
            let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
            for [a, b, c, d] in quads.map(|quad| quad.map(|v: u32| v + first)) {
                let two = [[a, b, c], [a, c, d]];
                shape.triangles.extend(two.map(|[a, b, c]| if *inward { [a, c, b] } else { [a, b, c] }));
            }
        }
        shape
    }

    /// Whether each cube is wound inward after orientation.
    fn cubes_wound_inward(of: &[(DVec3, f64, bool)]) -> Vec<bool> {
        let shape = cubes(of);
        let one: Vec<u32> = (0..shape.positions.len() as u32).collect();
        let right = orient_surfaces(&shape, &one);
        let outward = cubes(&of.iter().map(|(at, half, _)| (*at, *half, false)).collect::<Vec<_>>());
        right
            .triangles
            .chunks(12)
            .zip(outward.triangles.chunks(12))
            .map(|(own, other)| own != other)
            .collect()
    }

    #[test]
    fn inner_surface_wound_against_its_enclosing_one_bounds_a_void() {
        let o = DVec3::ZERO;
        for flags in 0..8_u32 {
            let is = |k: u32| flags >> k & 1 == 1;
            assert_eq!(cubes_wound_inward(&[(o, 3.0, is(0)), (o, 2.0, is(1))]), [false, is(0) != is(1)]);
            // A core in a void is a solid, and a void in that core is a void again.
            let core = [(o, 4.0, is(0)), (o, 3.0, !is(0)), (o, 2.0, is(1)), (o, 1.0, !is(0))];
            assert_eq!(cubes_wound_inward(&core), [false, true, false, is(0) == is(1)]);
            // Inside, and touching one side.
            let at_side = [(o, 3.0, is(0)), (DVec3::X * 2.0, 1.0, is(1))];
            assert_eq!(cubes_wound_inward(&at_side), [false, is(0) != is(1)]);
            // Apart, overlapping, protruding, and touching cubes.
            assert_eq!(cubes_wound_inward(&[(o, 1.0, is(0)), (DVec3::X * 5.0, 1.0, is(1))]), [false; 2]);
            assert_eq!(cubes_wound_inward(&[(o, 1.0, is(0)), (DVec3::ONE, 1.0, is(1))]), [false; 2]);
            assert_eq!(cubes_wound_inward(&[(o, 2.0, is(0)), (DVec3::X * 2.0, 1.0, is(1))]), [false; 2]);
            assert_eq!(cubes_wound_inward(&[(o, 2.0, is(0)), (DVec3::X * 3.0, 1.0, is(1))]), [false; 2]);
        }
    }

    #[test]
    fn ray_crossing_counts_a_shared_edge_once() {
        let [a, b, c, d] =
            [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[y, z]| DVec3::new(2.0, y, z));
        for (p, wanted) in [(DVec3::new(0.0, 0.5, 0.5), 1), (DVec3::new(3.0, 0.5, 0.5), 0)] {
            assert_eq!(ray_crossing([a, b, c], p) + ray_crossing([a, c, d], p), wanted);
        }
    }
}
