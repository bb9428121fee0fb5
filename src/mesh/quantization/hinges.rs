//! [`Hinge`]: bending energy at an edge with two faces.
//!
//! The energy is the square of a linear function of four vertex positions. The function is the gap between
//! the edge and the line between the opposite corners, at their crossing when both faces are unfolded into
//! one plane. It is zero for coplanar faces.
//!
//! Source: Bergou, Wardetzky, Harmon, Zorin and Grinspun, "A quadratic bending model for inextensible
//! surfaces", SGP 2006.

use std::f64::consts::FRAC_PI_2;

use crate::geometry::space::triangles::{area_vector, longest_side_squared};
use crate::mesh::edges::triangle_sides::apex;
use crate::parallel::prelude::*;
use glam::{DVec3, Vec3};

use crate::mesh::{EdgeFaces, Edges};
use crate::parallel::task_size::MIN_TASK_ITEMS;

/// Maximum tilt of a face by rounding, as a tangent (4 degrees), for its vertices to stay fixed.
const MAX_FIXED_TILT_TANGENT: f64 = 0.07;
/// Turn of an edge that halves its influence (a quarter of the energy), as a share of the largest turn that
/// rounding can cause. It is three standard deviations of the rounding. Larger turns are features and count
/// less.
const FEATURE_TURN_OF_ROUNDING: f64 = 0.7;
/// Minimum cosine (10 degrees) between normals of a continuous surface.
const MIN_SHARED_NORMAL_COSINE: f32 = 0.985;

/// Maximum tilt of each face by rounding.
pub(crate) struct FaceTilts {
    /// Tangents of the tilt angles; infinite where the corners are collinear.
    tangents: Vec<f64>,
    half_step: f64,
}

impl FaceTilts {
    /// Bounds the tilt: one corner may be off by half a step in one direction along each axis, and the
    /// opposite side by half a step in the other.
    pub(crate) fn of(places: &[DVec3], faces: &[[u32; 3]], half_step: f64) -> Self {
        let tangent = |face: &[u32; 3]| {
            let corners = face.map(|corner| places[corner as usize]);
            let (normal, longest) = (area_vector(corners), longest_side_squared(corners));
            // The height is twice the area over the longest side. The coordinates of a unit normal add up to
            // the reach of a unit box along it.
            let reach = normal.abs().element_sum() * longest.sqrt();
            2.0 * half_step * reach / normal.length_squared()
        };
        let tangents = faces.par_iter().with_min_len(MIN_TASK_ITEMS).map(tangent);
        let tangents = tangents.map(|t| if t.is_nan() { f64::INFINITY } else { t }).collect();
        Self { tangents, half_step }
    }

    /// Whether each position is free to move: all its faces may tilt by more than the limit.
    pub(crate) fn movable_positions(&self, faces: &[[u32; 3]], places: usize) -> Vec<bool> {
        let mut doubted = vec![false; places];
        for is_doubted in [true, false] {
            let such = faces
                .iter()
                .zip(&self.tangents)
                .filter(|(_, tangent)| (**tangent > MAX_FIXED_TILT_TANGENT) == is_doubted);
            such.for_each(|(face, _)| face.iter().for_each(|v| doubted[*v as usize] = is_doubted));
        }
        doubted
    }

    /// Bound for the turn between two faces by rounding, radians. Small angles equal their tangents.
    fn turn(&self, [a, b]: [u32; 2]) -> f64 {
        let of = |face: u32| self.tangents[face as usize].min(FRAC_PI_2);
        (of(a) * of(a) + of(b) * of(b)).sqrt()
    }
}

/// Edge with the opposite corners of its two faces. The gap between them is a linear function of the
/// displacements of all four.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Hinge {
    /// Both ends of the edge, then both opposite corners.
    pub corners: [u32; 4],
    /// Coefficients of the second end and of the first opposite corner; see [`Self::corner_coefficients`].
    pub halves: [f32; 2],
    /// Gap without displacements, in half steps.
    pub gap: Vec3,
    /// Weight of the squared gap: turn² · edge² / area of the two faces, for a unit gap.
    pub weight: f32,
}

impl Hinge {
    /// Coefficients of the four corners in the gap. Both ends count negatively, both opposite corners
    /// positively.
    #[inline]
    pub(crate) fn corner_coefficients(&self) -> [f32; 4] {
        let [end, far] = self.halves;
        [end - 1.0, -end, far, 1.0 - far]
    }

    /// Gap after displacements, in half steps.
    #[inline]
    pub(crate) fn gap_at(&self, moved: &[Vec3]) -> Vec3 {
        let ([a, b, c, d], [of_a, of_b, of_c, of_d]) = (self.corners, self.corner_coefficients());
        let at = |v: u32| moved[v as usize];
        self.gap + at(a) * of_a + at(b) * of_b + at(c) * of_c + at(d) * of_d
    }

    /// Bound for the slope of the energy along the displacement of a corner with coefficient `share`, for any
    /// displacements of the others.
    #[inline]
    pub(crate) fn steepest(&self, share: f32) -> f32 {
        let [a, b, c, d] = self.corner_coefficients();
        self.weight * share.abs() * (a.abs() + b.abs() + c.abs() + d.abs())
    }
}

/// Hinges with at least one free position.
///
/// `corners` are the vertices of the faces; `normals` are those of the vertices, or empty.
pub(crate) fn hinges(
    places: &[DVec3],
    (faces, edges): (&[[u32; 3]], &Edges),
    doubts: &FaceTilts,
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
        // Crossing of the edge with the line between the opposite corners, unfolded.
        let of_c = high_d / (high_c + high_d);
        let crossing = ((of_c * along_c + (1.0 - of_c) * along_d) / length).clamp(-1.0, 2.0);
        let shares = [crossing - 1.0, -crossing, of_c, 1.0 - of_c];
        let gap = a * shares[0] + b * shares[1] + c * shares[2] + d * shares[3];
        let half = doubts.half_step;
        let per_gap = half * (high_c + high_d) / (high_c * high_d);
        let meant = gap.length() / half * per_gap / (FEATURE_TURN_OF_ROUNDING * doubts.turn(sides));
        let counts = 1.0 / (1.0 + meant * meant);
        let weight = per_gap * per_gap * length / (high_c + high_d) * counts * counts;
        let halves = [crossing as f32, of_c as f32];
        let (gap, weight) = ((gap / half).as_vec3(), weight as f32);
        (gap.is_finite() && weight.is_finite()).then_some(Hinge { corners: all, halves, gap, weight })
    };
    (0..edges.len()).into_par_iter().with_min_len(MIN_TASK_ITEMS).filter_map(hinge).collect()
}

/// The corner of a face that is not one of two vertices.
fn far_corner(face: [u32; 3], ends: [u32; 2]) -> u32 {
    apex(face, ends).unwrap_or(face[0])
}

/// Whether the normals of two vertices separate the surface.
fn is_parted(normals: &[[f32; 3]], a: u32, b: u32) -> bool {
    if a == b {
        return false;
    }
    let (Some(m), Some(n)) = (normals.get(a as usize), normals.get(b as usize)) else { return false };
    let length = |n: &[f32; 3]| (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
    m[0] * n[0] + m[1] * n[1] + m[2] * n[2] < MIN_SHARED_NORMAL_COSINE * length(m) * length(n)
}
