//! [`Hinge`]: two faces and the edge between them, and by how much the surface bends there.
//!
//! Source: Bergou, Wardetzky, Harmon, Zorin and Grinspun, "A quadratic bending model for inextensible surfaces", SGP 2006: bending
//! is a sum of squares of linear functions of the places of four vertices. Here the function is the gap between the edge and the
//! line between the far corners, where they cross when both faces are laid flat: nothing where the faces are in one plane.

use std::f64::consts::FRAC_PI_2;

use crate::parallel::prelude::*;
use glam::{DVec3, Vec3};

use crate::mesh::{EdgeFaces, Edges};
use crate::parallel::task_size::GRAIN;

/// The tangent (4 degrees) of what a face may lean by rounding without doubt about it.
const SURE: f64 = 0.07;
/// An edge that turns by so much of what rounding can make it turn at worst counts a quarter, and less the more it turns: it is meant
/// to. That is three times the standard deviation of what rounding makes.
const MEANT: f64 = 0.7;
/// The cosine (10 degrees) below which normals part the surface.
const PARTED: f32 = 0.985;

/// By how much each face may lean from the surface that was rounded.
pub(crate) struct Doubts {
    /// Tangents of angles, world units over world units; infinite where the corners lie in a line.
    tangents: Vec<f64>,
    half_step: f64,
}

impl Doubts {
    /// One corner may be half a step off to one side along each axis, and the side beyond it as far to the other.
    pub fn of(places: &[DVec3], faces: &[[u32; 3]], half_step: f64) -> Self {
        let tangent = |face: &[u32; 3]| {
            let at = |corner: usize| places[face[corner] as usize];
            let (a, b, c) = (at(0), at(1), at(2));
            let normal = (b - a).cross(c - a);
            let longest = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a));
            // The height is twice the area over the longest side; the sum of coordinates of a unit normal is how
            // far a box reaches along it.
            let reach = normal.abs().element_sum() * longest.sqrt();
            2.0 * half_step * reach / normal.length_squared()
        };
        let tangents = faces.par_iter().with_min_len(GRAIN).map(tangent);
        let tangents = tangents.map(|t| if t.is_nan() { f64::INFINITY } else { t }).collect();
        Self { tangents, half_step }
    }

    /// Whether each place is at no face but such as may lean by more than rounding should: what is sure is not to be moved.
    pub fn doubted(&self, faces: &[[u32; 3]], places: usize) -> Vec<bool> {
        let mut doubted = vec![false; places];
        for is_doubted in [true, false] {
            let such =
                faces.iter().zip(&self.tangents).filter(|(_, tangent)| (**tangent > SURE) == is_doubted);
            such.for_each(|(face, _)| face.iter().for_each(|v| doubted[*v as usize] = is_doubted));
        }
        doubted
    }

    /// By how much two faces may turn to each other by rounding, radians; small angles are their tangents.
    fn turn(&self, [a, b]: [u32; 2]) -> f64 {
        let of = |face: u32| self.tangents[face as usize].min(FRAC_PI_2);
        (of(a) * of(a) + of(b) * of(b)).sqrt()
    }
}

/// An edge, the far corners of its two faces, and the gap between them as a linear function of how far all four are moved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Hinge {
    /// Both ends of the edge, then both far corners.
    pub corners: [u32; 4],
    /// What the second end and the first far corner count in the gap; see [`Self::shares`].
    pub halves: [f32; 2],
    /// The gap where nothing is moved, in half steps.
    pub gap: Vec3,
    /// What the square of the gap counts: that of the turn over the area that turns, by the square of the edge.
    pub weight: f32,
}

impl Hinge {
    /// What each corner counts in the gap: both ends lessen it, both far corners add to it.
    #[inline]
    pub fn shares(&self) -> [f32; 4] {
        let [end, far] = self.halves;
        [end - 1.0, -end, far, 1.0 - far]
    }

    /// The gap where the corners are moved by so much, all in half steps.
    #[inline]
    pub fn gap_at(&self, moved: &[Vec3]) -> Vec3 {
        let ([a, b, c, d], [of_a, of_b, of_c, of_d]) = (self.corners, self.shares());
        let at = |v: u32| moved[v as usize];
        self.gap + at(a) * of_a + at(b) * of_b + at(c) * of_c + at(d) * of_d
    }

    /// How steep the slope of its bending can be along the way of a corner that counts so much, wherever the others go.
    #[inline]
    pub fn steepest(&self, share: f32) -> f32 {
        let [a, b, c, d] = self.shares();
        self.weight * share.abs() * (a.abs() + b.abs() + c.abs() + d.abs())
    }
}

/// The hinges at which a free place takes part.
///
/// `corners` are the vertices of the faces, and `normals` those of vertices or empty.
pub(crate) fn hinges(
    places: &[DVec3],
    (faces, edges): (&[[u32; 3]], &Edges),
    doubts: &Doubts,
    (corners, normals): (&[[u32; 3]], &[[f32; 3]]),
    free: &[bool],
) -> Vec<Hinge> {
    let hinge = |edge: usize| {
        let EdgeFaces::Two { faces: sides, .. } = edges.faces(edge) else { return None };
        let ends = edges.vertices[edge];
        let far = |side: u32| far_corner(faces[side as usize], ends);
        let all = [ends[0], ends[1], far(sides[0]), far(sides[1])];
        if !all.iter().any(|v| free[*v as usize]) {
            return None;
        }
        let vertex = |side: u32, end: u32| {
            let [a, b, c] = faces[side as usize];
            corners[side as usize][if a == end { 0 } else { 1 + usize::from(b != end && c == end) }]
        };
        let is_split = |end: u32| is_parted(normals, vertex(sides[0], end), vertex(sides[1], end));
        if is_split(ends[0]) || is_split(ends[1]) {
            return None;
        }
        let at = |corner: usize| places[all[corner] as usize];
        let (a, b, c, d) = (at(0), at(1), at(2), at(3));
        let length = a.distance(b);
        let along = (b - a) / length;
        let (along_c, along_d) = ((c - a).dot(along), (d - a).dot(along));
        let height = |p: DVec3, at: f64| p.distance(a + along * at).max(doubts.half_step);
        let (high_c, high_d) = (height(c, along_c), height(d, along_d));
        // Where the line between the far corners, laid flat, crosses the edge.
        let of_c = high_d / (high_c + high_d);
        let crossing = ((of_c * along_c + (1.0 - of_c) * along_d) / length).clamp(-1.0, 2.0);
        let shares = [crossing - 1.0, -crossing, of_c, 1.0 - of_c];
        let gap = a * shares[0] + b * shares[1] + c * shares[2] + d * shares[3];
        let half = doubts.half_step;
        let per_gap = half * (high_c + high_d) / (high_c * high_d);
        let meant = gap.length() / half * per_gap / (MEANT * doubts.turn(sides));
        let counts = 1.0 / (1.0 + meant * meant);
        let weight = per_gap * per_gap * length / (high_c + high_d) * counts * counts;
        let halves = [crossing as f32, of_c as f32];
        let (gap, weight) = ((gap / half).as_vec3(), weight as f32);
        (gap.is_finite() && weight.is_finite()).then_some(Hinge { corners: all, halves, gap, weight })
    };
    (0..edges.len()).into_par_iter().with_min_len(GRAIN).filter_map(hinge).collect()
}

/// The corner of a face that is none of two.
fn far_corner(face: [u32; 3], ends: [u32; 2]) -> u32 {
    face.into_iter().find(|v| !ends.contains(v)).unwrap_or(face[0])
}

/// Whether two vertices have normals that lean apart.
fn is_parted(normals: &[[f32; 3]], a: u32, b: u32) -> bool {
    if a == b {
        return false;
    }
    let (Some(m), Some(n)) = (normals.get(a as usize), normals.get(b as usize)) else { return false };
    let length = |n: &[f32; 3]| (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
    m[0] * n[0] + m[1] * n[1] + m[2] * n[2] < PARTED * length(m) * length(n)
}
