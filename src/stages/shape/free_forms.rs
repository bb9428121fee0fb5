//! Of machined pieces the patches between hard edges that have curvature of their own: these are meant to be round.
//!
//! Source for curvature by angles: Meyer, Desbrun, Schröder and Barr, "Discrete differential-geometry
//! operators for triangulated 2-manifolds", 2002, section 4.

use super::planes::{Planes, area};
use super::rounded::{LEAST_EDGES, Make};
use crate::math::function::acos;
use crate::mesh::groups::Groups;
use crate::mesh::{EdgeFaces, FaceId, Mesh, Turns};

/// The least total curvature of a patch that bends both ways, radians: a twelfth of a ball's.
const FREE_FORM: f64 = 1.0;
/// Angles around a vertex of a cylinder miss a whole turn by less than this, radians, by rounding.
const ROUNDING: f64 = 2e-4;
/// With more than this share of flat edges a patch is machined all over: flat quads have a third.
const MANY_FLAT: f64 = 0.45;
/// With more than this share of edges that turn by more than this (cosine, 15 degrees) a patch of a machined part
/// is too coarse for a curve that all would agree on, and is what its faces are.
const FEW_COARSE: f64 = 0.1;
const COARSE_COSINE: f32 = 0.966;
/// Patches of which flats hold more than this part are machined all over.
const FEW_FLATS: f64 = 0.1;
/// A face is long if it is so many times as long as wide: nobody knows what lies between its ends. Patches
/// of which long faces hold more than this part stay what they are.
const LONG: f64 = 6.0;
const FEW_LONG: f64 = 0.1;

/// What is counted of one patch.
#[derive(Debug, Clone, Copy, Default)]
struct Count {
    edges: u32,
    flat: u32,
    coarse: u32,
    area: f64,
    in_flats: f64,
    in_long: f64,
    curvature: f64,
}

impl Count {
    /// Whether it is one if it bends enough.
    fn may_be_free_form(&self) -> bool {
        self.edges >= LEAST_EDGES
            && f64::from(self.flat) <= MANY_FLAT * f64::from(self.edges)
            && f64::from(self.coarse) <= FEW_COARSE * f64::from(self.edges)
            && self.in_flats <= FEW_FLATS * self.area
            && self.in_long <= FEW_LONG * self.area
    }
}

/// Marks the faces of machined pieces that lie in patches that bend both ways.
pub(super) fn add_free_forms(
    mesh: &Mesh,
    (turns, planes): (&Turns, &Planes),
    makes: &[Make],
    parts: impl Fn(usize) -> bool,
    rounded: &mut [bool],
) {
    let machined = |face: u32| makes[face as usize] == Make::Machined;
    let inner = |edge: usize| match mesh.edges.faces(edge) {
        EdgeFaces::Two { faces, same_way: false } if machined(faces[0]) && !parts(edge) => Some(faces),
        _ => None,
    };
    let groups = Groups::new(mesh.triangles.len(), |join| {
        for [a, b] in (0..mesh.edges.len()).filter_map(inner) {
            join(a, b);
        }
    });
    let patches = Patches::of(&groups, makes);
    let mut counts = vec![Count::default(); patches.count];
    // Whether a patch ends at each vertex.
    let mut ends = vec![false; mesh.positions.len()];
    for edge in 0..mesh.edges.len() {
        match inner(edge) {
            Some([face, _]) => {
                let count = &mut counts[patches.of_face(face)];
                count.edges += 1;
                count.flat += u32::from(planes.flat.contains(edge));
                count.coarse += u32::from(turns.of_two(edge) < COARSE_COSINE);
            }
            None => mesh.edges.vertices[edge].iter().for_each(|v| ends[*v as usize] = true),
        }
    }
    for face in (0..mesh.triangles.len() as u32).filter(|face| machined(*face)) {
        let count = &mut counts[patches.of_face(face)];
        let area = area(mesh, face);
        count.area += area;
        count.in_flats += if planes.of(face).is_some() { area } else { 0.0 };
        let corners = mesh.corners(FaceId(face));
        let longest = (0..3).map(|k| corners[k].distance_squared(corners[(k + 1) % 3])).fold(0.0, f64::max);
        count.in_long += if longest > LONG * 2.0 * area { area } else { 0.0 };
    }
    let may_be: Vec<bool> = counts.iter().map(Count::may_be_free_form).collect();
    let asked = |face: &u32| machined(*face) && may_be[patches.of_face(*face)];
    if may_be.contains(&true) {
        // Angles are asked for where they count: around vertices inside such patches.
        let mut counts_at = vec![false; mesh.positions.len()];
        for face in (0..mesh.triangles.len() as u32).filter(asked) {
            mesh.triangles[face as usize].iter().for_each(|v| counts_at[*v as usize] = !ends[*v as usize]);
        }
        let mut angles = vec![0.0; mesh.positions.len()];
        for face in (0..mesh.triangles.len() as u32).filter(|face| machined(*face)) {
            let triangle = mesh.triangles[face as usize];
            let corners = mesh.corners(FaceId(face));
            for (k, vertex) in triangle.iter().enumerate().filter(|(_, v)| counts_at[**v as usize]) {
                let [a, b] = [1, 2].map(|step| (corners[(k + step) % 3] - corners[k]).normalize_or_zero());
                angles[*vertex as usize] += acos(a.dot(b).clamp(-1.0, 1.0));
            }
        }
        for face in (0..mesh.triangles.len() as u32).filter(|face| machined(*face)) {
            for vertex in mesh.triangles[face as usize] {
                let vertex = vertex as usize;
                if std::mem::replace(&mut counts_at[vertex], false) {
                    let missing = (std::f64::consts::TAU - angles[vertex]).abs();
                    counts[patches.of_face(face)].curvature += (missing - ROUNDING).max(0.0);
                }
            }
        }
    }
    for face in (0..mesh.triangles.len() as u32).filter(|face| machined(*face)) {
        let patch = patches.of_face(face);
        rounded[face as usize] = may_be[patch] && counts[patch].curvature >= FREE_FORM;
    }
}

/// The patches of machined pieces, numbered densely: counting needs no more room than there are patches.
struct Patches {
    numbers: Vec<u32>,
    count: usize,
}

impl Patches {
    fn of(groups: &Groups, makes: &[Make]) -> Self {
        let mut numbers = vec![u32::MAX; makes.len()];
        let mut count = 0;
        for face in (0..makes.len()).filter(|face| makes[*face] == Make::Machined) {
            // The least face of a group comes first; it is machined as all of its group are.
            let first = groups.of(face as u32) as usize;
            if first == face {
                numbers[face] = count as u32;
                count += 1;
            }
            numbers[face] = numbers[first];
        }
        Self { numbers, count }
    }

    #[inline]
    fn of_face(&self, face: u32) -> usize {
        self.numbers[face as usize] as usize
    }
}
