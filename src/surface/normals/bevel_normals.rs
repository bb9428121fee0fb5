//! [`BevelNormals`]: the normals of wide faces, without the bevels next to them.
//!
//! Modelling programs average the normals around a vertex, so that a flat next to a narrow bevel leans toward
//! it and would bulge over its whole width. The flat is the surface there, and the bevel its rounded edge:
//!
//! 1. At an edge that the file shades smoothly, a face is narrow if the other reaches six times as far, or three
//!    times at an edge above the crease angle. It is none that runs away from the edge, farther than that times
//!    its length: two bevels that meet at a corner do. The faces in its plane are narrow too.
//! 2. Around a vertex, the faces with a common normal form a fan.
//! 3. A fan with narrow faces has the normal of its other faces, if its own is a mean of all of them.
//!
//! The edges above the crease angle are those of chamfers. They are drawn, although the file shades them
//! smoothly.

use glam::DVec3;

use super::file_normals::file_normals;
use super::normal_sum::{FaceWeights, NormalSum};
use super::vertex_split::FanCorner;
use crate::geometry::lists::disjoint_sets::UnionFind;
use crate::geometry::numbers::portable_math::{acos, cos};
use crate::mesh::edges::triangle_sides::{apex, sides};
use crate::mesh::{DihedralCosines, EdgeFaces, EdgeSet, FaceId, Mesh, VertexEdges};
use crate::parallel::prelude::*;
use crate::parallel::task_size::MIN_TASK_ITEMS;
use crate::surface::tolerances::MIN_STRIP_WIDTH_RATIO;

/// Minimum ratio of the widths of a face and a bevel, at an edge above the crease angle. Facets of a curved surface
/// may differ by two to one (`facets_of_curved_surfaces_are_no_chamfers`).
const MIN_BEVEL_WIDTH_RATIO: f64 = 3.0;
/// Minimum cosine (1 degree) between the normals of two corners that have a common one.
const MIN_COMMON_COSINE: f64 = 0.999_85;
/// Minimum cosine (0.1 degrees) between a mean and the normal that it is. Covers normals in single precision.
/// Distances of averaged normals are at most 0.05 degrees in games' models; those of 76 CAD parts are rarely less
/// than 0.1.
const MIN_MEAN_COSINE: f64 = 0.999_998_5;
/// Maximum number of different planes of a fan. Bounds the search around vertices with many faces.
const MAX_PLANES_OF_FAN: usize = 64;
/// Maximum number of coplanar faces across which a face reaches. Bounds the search on large flats.
const MAX_COPLANAR_FACES: usize = 16;

/// Fans of a mesh with narrow faces: the corners of their other faces.
#[derive(Debug, Clone, Default)]
pub(crate) struct BevelNormals {
    fans: Vec<Vec<FanCorner>>,
}

impl BevelNormals {
    /// Finds the fans with narrow faces among the faces that satisfy `is_shaded`, and gives them their normals.
    /// Also returns the edges at narrow faces that turn by more than `crease_deg` degrees. `around` holds the
    /// turns and the flat edges of the mesh.
    pub(crate) fn part(
        mesh: &mut Mesh,
        around: (&DihedralCosines, &EdgeSet),
        crease_deg: f64,
        is_shaded: impl Fn(u32) -> bool + Sync,
    ) -> (Self, EdgeSet) {
        if mesh.corner_normals.is_empty() {
            return Default::default();
        }
        let narrow = narrow_faces(mesh, around, crease_deg, &is_shaded);
        let found = fans(mesh, around.1, &narrow, is_shaded);
        let sharp: Vec<usize> = narrow.iter().filter(|n| n.is_sharp).map(|n| n.edge as usize).collect();
        let mut fans = Vec::with_capacity(found.len());
        for PartedFan { narrow, others } in found {
            let id = (mesh.normals.len() + fans.len()) as u32;
            for corner in narrow.iter().chain(&others) {
                mesh.corner_normals[corner.face as usize][usize::from(corner.which)] = id;
            }
            fans.push(others);
        }
        let parted = Self { fans };
        parted.add_to(mesh);
        (parted, EdgeSet::default().with(&sharp, mesh.edges.len()))
    }

    /// Appends the normals of the fans to those of a mesh, which is the one they were found in, or a pose of it.
    pub(crate) fn add_to(&self, mesh: &mut Mesh) {
        let normals: Vec<[f32; 3]> =
            self.fans.iter().map(|fan| mean_of_faces(mesh, fan).as_vec3().to_array()).collect();
        mesh.normals.extend(normals);
    }
}

/// Unit normal of the faces of a fan; zero if they have no area.
fn mean_of_faces(mesh: &Mesh, fan: &[FanCorner]) -> DVec3 {
    let mut sum = NormalSum::default();
    for corner in fan {
        if let Some(weights) = FaceWeights::new(mesh.corners(FaceId(corner.face))) {
            sum.add(&weights, usize::from(corner.which));
        }
    }
    sum.normal().normalize_or_zero()
}

/// Fan whose normal changes.
struct PartedFan {
    narrow: Vec<FanCorner>,
    others: Vec<FanCorner>,
}

/// Face of a bevel, at its edge with a wider face.
struct NarrowFace {
    edge: u32,
    face: u32,
    /// Whether the edge turns by more than the crease angle.
    is_sharp: bool,
}

/// The narrow faces at smoothly shaded edges, ascending by edge.
fn narrow_faces(
    mesh: &Mesh,
    (turns, flat): (&DihedralCosines, &EdgeSet),
    crease_deg: f64,
    is_shaded: &(impl Fn(u32) -> bool + Sync),
) -> Vec<NarrowFace> {
    let edges = VertexEdges::of(&mesh.edges, mesh.positions.len());
    let crease_cosine = cos(crease_deg.to_radians()) as f32;
    let narrow_at = |edge: usize| {
        let EdgeFaces::Two { faces, same_way: false } = mesh.edges.faces(edge) else { return None };
        if flat.contains(edge) || !faces.iter().all(|face| is_shaded(*face)) {
            return None;
        }
        let [a, b] = faces.map(|face| reach(mesh, flat, &edges, edge, face));
        let [from, to] = mesh.ends(edge);
        let is_sharp = turns.of_two(edge) < crease_cosine;
        let least = if is_sharp { MIN_BEVEL_WIDTH_RATIO } else { MIN_STRIP_WIDTH_RATIO };
        let is_narrow = a.max(b) > least * a.min(b) && a.min(b) < least * from.distance(to);
        let face = faces[usize::from(b < a)];
        is_narrow.then_some(NarrowFace { edge: edge as u32, face, is_sharp })
    };
    let all = (0..mesh.edges.len()).into_par_iter().with_min_len(MIN_TASK_ITEMS);
    all.filter_map(narrow_at).collect()
}

/// The fans whose normals change.
fn fans(
    mesh: &Mesh,
    flat: &EdgeSet,
    narrow: &[NarrowFace],
    is_shaded: impl Fn(u32) -> bool + Sync,
) -> Vec<PartedFan> {
    if narrow.is_empty() {
        return Vec::new();
    }
    let edges = VertexEdges::of(&mesh.edges, mesh.positions.len());
    let mut is_asked = vec![false; mesh.positions.len()];
    for NarrowFace { edge, .. } in narrow {
        mesh.edges.vertices[*edge as usize].iter().for_each(|v| is_asked[*v as usize] = true);
    }
    let mut corners: Vec<FanCorner> = Vec::new();
    for (face, triangle) in mesh.triangles.iter().enumerate().filter(|(face, _)| is_shaded(*face as u32)) {
        for (which, vertex) in triangle.iter().enumerate().filter(|(_, v)| is_asked[**v as usize]) {
            corners.push(FanCorner { vertex: *vertex, face: face as u32, which: which as u8 });
        }
    }
    corners.par_sort_unstable_by_key(|corner| (corner.vertex, corner.face));
    let around: Vec<&[FanCorner]> = corners.chunk_by(|a, b| a.vertex == b.vertex).collect();
    let work = Fans { mesh, flat, edges: &edges, narrow };
    around.into_par_iter().flat_map_iter(|around| work.parted(around)).collect()
}

/// How far a face and those in its plane reach from an edge.
fn reach(mesh: &Mesh, flat: &EdgeSet, edges: &VertexEdges, edge: usize, face: u32) -> f64 {
    let ends = mesh.edges.vertices[edge];
    let [from, to] = mesh.ends(edge);
    let triangle = mesh.triangles[face as usize];
    let Some(top) = apex(triangle, ends) else { return 0.0 };
    let inward = (mesh.positions[top as usize] - from).reject_from(to - from).normalize_or_zero();
    let mut seen = vec![face];
    let mut next = 0;
    let mut most = 0.0f64;
    while let Some(face) = seen.get(next).copied() {
        next += 1;
        let triangle = mesh.triangles[face as usize];
        most = triangle.iter().map(|v| (mesh.positions[*v as usize] - from).dot(inward)).fold(most, f64::max);
        for [a, b] in sides(triangle) {
            let side = edges.between(a, b).filter(|side| flat.contains(*side));
            let other = side.and_then(|side| mesh.edges.faces(side).across(face));
            if let Some(other) = other.filter(|f| seen.len() < MAX_COPLANAR_FACES && !seen.contains(f)) {
                seen.push(other);
            }
        }
    }
    most
}

struct Fans<'a> {
    mesh: &'a Mesh,
    flat: &'a EdgeSet,
    edges: &'a VertexEdges<'a>,
    narrow: &'a [NarrowFace],
}

impl Fans<'_> {
    /// The fans around a vertex whose normals change.
    fn parted(&self, around: &[FanCorner]) -> Vec<PartedFan> {
        let Self { mesh, flat, edges, narrow } = self;
        let vertex = around[0].vertex;
        let normal = |corner: &FanCorner| file_normals(mesh, corner.face as usize)[usize::from(corner.which)];
        let [fans, planes] = [(); 2].map(|()| UnionFind::new(around.len()));
        let mut narrow_corners: Vec<usize> = Vec::new();
        for (k, corner) in around.iter().enumerate() {
            let triangle = mesh.triangles[corner.face as usize];
            for step in [1, 2] {
                let end = triangle[(usize::from(corner.which) + step) % 3];
                let Some(edge) = edges.between(vertex, end) else { continue };
                let Some(other) = mesh.edges.faces(edge).across(corner.face) else { continue };
                let Ok(l) = around.binary_search_by_key(&other, |corner| corner.face) else { continue };
                if normal(corner).dot(normal(&around[l])) < MIN_COMMON_COSINE {
                    continue;
                }
                fans.join(k as u32, l as u32);
                if flat.contains(edge) {
                    planes.join(k as u32, l as u32);
                }
                let at = narrow.binary_search_by_key(&(edge as u32), |narrow| narrow.edge);
                if at.is_ok_and(|at| narrow[at].face == corner.face) {
                    narrow_corners.push(k);
                }
            }
        }
        if narrow_corners.is_empty() {
            return Vec::new();
        }
        let mut is_narrow_plane = vec![false; around.len()];
        narrow_corners.iter().for_each(|k| is_narrow_plane[planes.root(*k as u32) as usize] = true);
        // Corners by fan.
        let mut of_fans: Vec<(u32, usize)> = (0..around.len()).map(|k| (fans.root(k as u32), k)).collect();
        of_fans.sort_unstable();
        let part = |fan: &[(u32, usize)]| {
            let own = normal(&around[fan[0].1]);
            let is_narrow = |k: usize| is_narrow_plane[planes.root(k as u32) as usize];
            let (narrow, others): (Vec<_>, Vec<_>) = fan.iter().map(|(_, k)| *k).partition(|k| is_narrow(*k));
            let corners = |of: Vec<usize>| of.into_iter().map(|k| around[k]).collect::<Vec<FanCorner>>();
            let (narrow, others) = (corners(narrow), corners(others));
            let changes = !narrow.is_empty()
                && self.is_mean(own, narrow.iter().chain(&others))
                && mean_of_faces(mesh, &others) != DVec3::ZERO;
            changes.then_some(PartedFan { narrow, others })
        };
        of_fans.chunk_by(|a, b| a.0 == b.0).filter_map(part).collect()
    }

    /// Whether a normal is a mean of the normals of the faces of a fan, each face or each plane
    /// counting once, or weighted by angle or by area.
    fn is_mean<'b>(&self, normal: DVec3, fan: impl Iterator<Item = &'b FanCorner>) -> bool {
        let mut means = [DVec3::ZERO; 4];
        let mut planes: Vec<DVec3> = Vec::new();
        for corner in fan {
            let corners = self.mesh.corners(FaceId(corner.face));
            let [at, next, last] = [0, 1, 2].map(|step| corners[(usize::from(corner.which) + step) % 3]);
            let [a, b] = [next - at, last - at];
            let cross = a.cross(b);
            let unit = cross.normalize_or_zero();
            let angle = acos(a.normalize_or_zero().dot(b.normalize_or_zero()).clamp(-1.0, 1.0));
            let is_known = planes.len() >= MAX_PLANES_OF_FAN
                || planes.iter().any(|plane| plane.dot(unit) > MIN_MEAN_COSINE);
            let of_plane = if is_known { DVec3::ZERO } else { unit };
            if !is_known {
                planes.push(unit);
            }
            for (mean, weighted) in means.iter_mut().zip([unit, of_plane, unit * angle, cross]) {
                *mean += weighted;
            }
        }
        means.iter().any(|mean| mean.normalize_or_zero().dot(normal.normalize_or_zero()) > MIN_MEAN_COSINE)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Soup;
    use crate::surface::patches::planar_regions::PlanarRegions;

    /// A square plate with a bevel of the given width around it, and the normal of each vertex by its weights
    /// of the faces around it: `weight` takes the angle of a corner.
    fn plate(bevel: f64, weight: impl Fn(f64) -> f64) -> Mesh {
        let ring = |half: f64, z: f64| {
            [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
                .map(|[x, y]| DVec3::new(x * half, y * half, z))
        };
        let positions = [ring(2.0, 0.0), ring(2.0 + bevel, -bevel)].concat();
        let mut triangles = vec![[0, 1, 2], [0, 2, 3]];
        for k in 0..4 {
            let (next, down) = ((k + 1) % 4, 4);
            triangles.extend([[k, k + down, next], [next, k + down, next + down]]);
        }
        let mut normals = vec![DVec3::ZERO; positions.len()];
        for t in &triangles {
            let at = t.map(|v: u32| positions[v as usize]);
            let face = (at[1] - at[0]).cross(at[2] - at[0]).normalize();
            for k in 0..3 {
                let [a, b] = [1, 2].map(|step| (at[(k + step) % 3] - at[k]).normalize());
                normals[t[k] as usize] += face * weight(acos(a.dot(b)));
            }
        }
        let normals = normals.iter().map(|n| n.normalize().as_vec3().to_array()).collect();
        Mesh::build(Soup {
            positions,
            normals,
            corner_normals: triangles.clone(),
            triangles,
            ..Soup::default()
        })
    }

    fn parted_with_chamfers(mut mesh: Mesh, crease_deg: f64) -> (BevelNormals, Mesh, EdgeSet) {
        let turns = DihedralCosines::of(&mesh);
        let flat = PlanarRegions::new(&mesh, &turns).flat;
        let (bevels, chamfers) = BevelNormals::part(&mut mesh, (&turns, &flat), crease_deg, |_| true);
        (bevels, mesh, chamfers)
    }

    fn parted(mesh: Mesh) -> (BevelNormals, Mesh) {
        let (bevels, mesh, _) = parted_with_chamfers(mesh, 40.0);
        (bevels, mesh)
    }

    /// Largest tilt of the normals on the plate, as the sine.
    fn tilt(mesh: &Mesh) -> f64 {
        let is_top = |face: &usize| mesh.face_normals[*face][2] > 0.99;
        let faces = (0..mesh.triangles.len()).filter(is_top);
        faces.flat_map(|face| file_normals(mesh, face)).map(|n| n.truncate().length()).fold(0.0, f64::max)
    }

    #[test]
    fn flats_next_to_narrow_bevels_do_not_lean() {
        for weight in [|_: f64| 1.0, |angle: f64| angle] {
            let before = plate(0.1, weight);
            let (bevels, mesh) = parted(before.clone());
            assert!(tilt(&before) > 0.3 && tilt(&mesh) < 1e-6, "{} {}", tilt(&before), tilt(&mesh));
            assert_eq!(bevels.fans.len(), 4);
            // Bevels as wide as the plate are no bevels.
            let wide = plate(2.0, weight);
            assert_eq!(tilt(&parted(wide.clone()).1), tilt(&wide));
        }
    }

    #[test]
    fn edges_of_chamfers_above_the_crease_angle_are_found() {
        // The plate is 4 wide, and the chamfer √2 times its leg.
        for (bevel, crease_deg, count, leans) in
            [(0.4, 40.0, 4, false), (0.9, 40.0, 4, false), (0.9, 50.0, 0, true), (1.0, 40.0, 0, true)]
        {
            let (_, mesh, chamfers) = parted_with_chamfers(plate(bevel, |_| 1.0), crease_deg);
            assert_eq!(chamfers.iter().count(), count, "{bevel} {crease_deg}");
            assert_eq!(tilt(&mesh) > 0.1, leans, "{bevel} {crease_deg}");
        }
    }

    #[test]
    fn normals_that_are_no_mean_stay() {
        // Twice the weight for the upright faces of the bevel.
        let mut exact = plate(0.1, |_| 1.0);
        for normal in &mut exact.normals {
            *normal = DVec3::new(f64::from(normal[0]) * 0.7, f64::from(normal[1]), f64::from(normal[2]))
                .normalize()
                .as_vec3()
                .to_array();
        }
        let (bevels, mesh) = parted(exact.clone());
        assert!(bevels.fans.is_empty());
        assert_eq!(tilt(&mesh), tilt(&exact));
    }

    #[test]
    fn poses_keep_the_normals_of_parted_bevels() {
        let rest = plate(0.1, |_| 1.0);
        let (bevels, parted) = parted(rest.clone());
        let turned = |p: &DVec3| DVec3::new(p.x, p.z, -p.y);
        let mut pose = parted.clone();
        pose.positions.iter_mut().for_each(|p| *p = turned(p));
        pose.face_normals.iter_mut().for_each(|[_, y, z]| (*y, *z) = (*z, -*y));
        pose.normals = rest.normals.iter().map(|[x, y, z]| [*x, *z, -*y]).collect();
        bevels.add_to(&mut pose);
        let face = (0..pose.triangles.len()).find(|face| parted.face_normals[*face][2] > 0.99).unwrap();
        for normal in file_normals(&pose, face) {
            assert!(normal.distance(DVec3::Y) < 1e-6, "{normal}");
        }
    }
}
