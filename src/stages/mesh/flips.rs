//! Flips: slivers that stand up from their surface are laid into it, by the other diagonal of the two faces.
//!
//! Programs that sew surfaces together, or decimate them, leave triangles all but without height whose normals
//! say nothing: one of them in the middle of a smooth wall would be two creases. Of two faces that meet along the
//! long side of such a sliver the other diagonal gives the same surface without the fold.
//!
//! Source: Dyn, Levin and Rippa, "Data dependent triangulations for piecewise linear interpolation", IMA Journal of
//! Numerical Analysis 10, 1990: of two triangulations the one between whose faces the angles are smaller.

use glam::DVec3;
use rayon::prelude::*;
use rustc_hash::FxHashSet;

use super::edge_flips::EdgeFlip;
use super::face_normals::face_normals;
use super::soup::Soup;
use super::{EdgeFaces, Edges, Extents};
use crate::math::tolerance;

/// A face is a sliver if its longest side is more than so many times its height.
const SLENDER: f64 = 10.0;

/// A fold turns by more than the angle of this cosine (20 degrees), to and back again.
const FOLD: f32 = 0.94;

/// Slivers beside slivers are laid one after the other; what is left after so many rounds stays.
const ROUNDS: usize = 4;

/// The smallest piece of work for a thread, in edges.
const GRAIN: usize = 1 << 14;

/// A sliver and the face beyond its long side, and what their corners are when they meet along the other diagonal.
struct Flip {
    edges: EdgeFlip,
    /// Of each new face the old one, first or second, and the corner there, that each of its corners comes from.
    corners: [[(usize, usize); 3]; 2],
    /// The faces beside both.
    around: Vec<u32>,
}

/// Lays the slivers of a soup into their surfaces; edges and normals stay those of the soup.
pub(super) fn lay_slivers(
    soup: &mut Soup,
    edges: &mut Edges,
    normals: &mut Vec<[f32; 3]>,
    extents: &Extents,
) {
    // What a file says of its edges it says of its own triangles.
    let rounds = if soup.edge_marks.is_empty() { ROUNDS } else { 0 };
    for _ in 0..rounds {
        let slivers = Slivers { soup, edges, normals, extents };
        let found: Vec<Flip> = (0..edges.len())
            .into_par_iter()
            .with_min_len(GRAIN)
            .filter_map(|edge| slivers.flip(edge))
            .collect();
        // Each was found with what is around it as it is.
        let mut touched: FxHashSet<u32> = FxHashSet::default();
        let mut made: FxHashSet<[u32; 2]> = FxHashSet::default();
        let mut done: Vec<EdgeFlip> = Vec::new();
        for flip in found {
            let own = || flip.edges.faces.iter().chain(&flip.around);
            if !own().any(|face| touched.contains(face)) && made.insert(flip.edges.made) {
                touched.extend(own().copied());
                turn(soup, &flip);
                done.push(flip.edges);
            }
        }
        if done.is_empty() {
            break;
        }
        edges.flip(&done);
        for face in done.iter().flat_map(|flip| flip.faces) {
            let part = soup.triangle_part.get(face as usize).copied().unwrap_or_default();
            let new =
                face_normals(&soup.positions, &[soup.triangles[face as usize]], |_| extents.of(part).scale);
            normals[face as usize] = new[0];
        }
    }
}

/// Gives two faces their new corners, with all that these have.
fn turn(soup: &mut Soup, flip: &Flip) {
    fn take<T: Copy>(list: &mut [[T; 3]], flip: &Flip) {
        let [Some(first), Some(second)] = flip.edges.faces.map(|face| list.get(face as usize).copied())
        else {
            return;
        };
        let old = [first, second];
        for (face, corners) in flip.edges.faces.iter().zip(&flip.corners) {
            list[*face as usize] = corners.map(|(which, corner)| old[which][corner]);
        }
    }
    take(&mut soup.triangles, flip);
    take(&mut soup.corner_normals, flip);
    take(&mut soup.corner_uvs, flip);
    take(&mut soup.corner_colours, flip);
}

struct Slivers<'a> {
    soup: &'a Soup,
    edges: &'a Edges,
    normals: &'a [[f32; 3]],
    extents: &'a Extents,
}

impl Slivers<'_> {
    /// The flip of an edge, if it is the long side of a sliver that stands up.
    #[inline]
    fn flip(&self, edge: usize) -> Option<Flip> {
        let EdgeFaces::Two { faces: [first, second], same_way: false } = self.edges.faces(edge) else {
            return None;
        };
        if self.turn(first, second) > FOLD {
            return None;
        }
        self.laid(edge, [first, second]).or_else(|| self.laid(edge, [second, first]))
    }

    /// Cosine of the turn from one face to another.
    #[inline]
    fn turn(&self, first: u32, second: u32) -> f32 {
        let [a, b] = [first, second].map(|face| self.normals[face as usize]);
        a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
    }

    /// How a face is laid into the one beyond an edge, if it is a sliver and the surface is smoother for it.
    fn laid(&self, edge: usize, faces: [u32; 2]) -> Option<Flip> {
        let [sliver, beyond] = faces;
        let [lo, hi] = self.edges.vertices[edge];
        let side = |face: u32| {
            let t = self.soup.triangles[face as usize];
            (0..3).find(|k| [t[*k].min(t[(k + 1) % 3]), t[*k].max(t[(k + 1) % 3])] == [lo, hi])
        };
        // The sliver is a, b, c; the face beyond b, a, d.
        let (s, f) = (side(sliver)?, side(beyond)?);
        let corner = |(which, k): (usize, usize)| self.soup.triangles[faces[which] as usize][k];
        let [a, b, c] = [0, 1, 2].map(|k| (0, (s + k) % 3));
        let d = (1, (f + 2) % 3);
        let place = |at: (usize, usize)| self.soup.positions[corner(at) as usize];
        let (long, height) = (place(b) - place(a), self.height(sliver, place(b) - place(a)));
        let is_sliver = long.length() > SLENDER * height
            && long.length() >= place(c).distance(place(a)).max(place(c).distance(place(b)));
        let is_one = self.alike(faces, [a.1, (f + 1) % 3]) && self.alike(faces, [b.1, f]);
        let made = [corner(c).min(corner(d)), corner(c).max(corner(d))];
        if !is_sliver || !is_one || self.edges.vertices.binary_search(&made).is_ok() {
            return None;
        }
        let across = |p, q, face| self.across(corner(p), corner(q), face);
        let sides = [(c, a, 0), (a, d, 0), (d, b, 1), (b, c, 1)];
        let beside = sides.map(|(p, q, new)| {
            let own = if [p, q].contains(&d) { beyond } else { sliver };
            (across(p, q, own), new)
        });
        if beside.iter().any(|(face, _)| face.is_some_and(|face| faces.contains(&face))) {
            return None;
        }
        // To the face beyond and back again.
        let back = [beside[0].0, beside[3].0].into_iter().flatten().map(|face| self.turn(sliver, face));
        let fold = self.turn(sliver, beyond).max(back.fold(1.0, f32::min));
        if fold > FOLD || self.normals[sliver as usize] == [0.0; 3] {
            return None;
        }
        let corners = [[a, d, c], [d, b, c]];
        let new = corners.map(|corners| {
            let [p, q, r] = corners.map(place);
            (q - p).cross(r - p).normalize_or_zero()
        });
        let normal = |face: u32| DVec3::from(self.normals[face as usize].map(f64::from));
        let turns = beside.iter().filter_map(|(face, at)| Some(normal((*face)?).dot(new[*at])));
        let smoothest = turns.fold(new[0].dot(new[1]), f64::min);
        let half = ((1.0 + f64::from(fold)) / 2.0).max(0.0).sqrt();
        let off = long.cross(place(d) - place(c)).normalize_or_zero().dot(place(c) - place(a)).abs();
        let part = self.soup.triangle_part.get(sliver as usize).copied().unwrap_or_default();
        if smoothest <= half.max(f64::from(FOLD))
            || off > tolerance::SLIVER_OF_PART * self.extents.of(part).scale
        {
            return None;
        }
        let around = beside.iter().filter_map(|(face, _)| *face).collect();
        let edge = |p, q| [corner(p).min(corner(q)), corner(p).max(corner(q))];
        let moved = [(edge(a, d), beyond, sliver), (edge(b, c), sliver, beyond)];
        Some(Flip { edges: EdgeFlip { gone: [lo, hi], made, faces, moved }, corners, around })
    }

    /// Height of a face above one of its sides.
    fn height(&self, face: u32, side: DVec3) -> f64 {
        let [p, q, r] = self.soup.triangles[face as usize].map(|v| self.soup.positions[v as usize]);
        (q - p).cross(r - p).length() / side.length().max(f64::MIN_POSITIVE)
    }

    /// Whether two faces are of one part, material and paint, and one corner of each has the same.
    fn alike(&self, faces: [u32; 2], corners: [usize; 2]) -> bool {
        fn same<T: Copy + PartialEq>(list: &[T], [first, second]: [u32; 2]) -> bool {
            list.get(first as usize) == list.get(second as usize)
        }
        fn value<T: Copy>(values: &[T], ids: &[[u32; 3]], face: u32, corner: usize) -> Option<T> {
            values.get(ids.get(face as usize)?[corner] as usize).copied()
        }
        let soup = self.soup;
        let of = |k: usize| {
            let (face, corner) = (faces[k], corners[k]);
            let colour = soup.corner_colours.get(face as usize).map(|colours| colours[corner]);
            let normal = value(&soup.normals, &soup.corner_normals, face, corner);
            (normal, value(&soup.uvs, &soup.corner_uvs, face, corner), colour)
        };
        same(&soup.triangle_part, faces)
            && same(&soup.triangle_material, faces)
            && same(&soup.triangle_paint, faces)
            && of(0) == of(1)
    }

    /// The one face that meets another along an edge.
    fn across(&self, p: u32, q: u32, face: u32) -> Option<u32> {
        let edge = self.edges.vertices.binary_search(&[p.min(q), p.max(q)]).ok()?;
        match self.edges.faces(edge) {
            EdgeFaces::Two { faces, .. } => faces.into_iter().find(|other| *other != face),
            _ => None,
        }
    }
}
