//! The borders between the colours of pictures, carried over to the faces that show them.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::textures::Textured;
use super::tone_edges::segment;
use super::{FeatureLines, Lit, NO_FACE};
use crate::mesh::{FaceId, Mesh};
use crate::scene::texels::side::{TexelSide, turn};

/// Adds the borders between the colours of pictures.
pub fn find(lit: &Lit, lines: &mut FeatureLines) {
    if lit.textures.is_empty() {
        return;
    }
    const CHUNK: usize = 1 << 11;
    let count = lit.mesh.triangles.len();
    let found: Vec<Vec<(u32, [DVec3; 2])>> = (0..count.div_ceil(CHUNK))
        .into_par_iter()
        .map(|chunk| {
            let mut pieces = Vec::new();
            for face in chunk * CHUNK..((chunk + 1) * CHUNK).min(count) {
                let face = face as u32;
                if lit.may_be_seen(face as usize) && !lit.mesh.is_degenerate(FaceId(face)) {
                    if let Some(textured) = lit.textures.on(lit.mesh, face) {
                        pieces
                            .extend(on_face(lit.mesh, face, &textured).into_iter().map(|ends| (face, ends)));
                    }
                }
            }
            pieces
        })
        .collect();
    lines.append_in_faces(lit.mesh, found.into_iter().flatten(), |face, ends| {
        segment(lit.mesh, face, [face, NO_FACE], ends)
    });
}

/// What lies on a face of the borders of its picture.
fn on_face(mesh: &Mesh, face: u32, textured: &Textured) -> Vec<[DVec3; 2]> {
    let corners = textured.corners;
    let vertices = mesh.triangles[face as usize];
    let places = mesh.corners(FaceId(face));
    // Both faces of a side cut it from the same end on.
    let ends = [0, 1, 2].map(|k| {
        let next = (k + 1) % 3;
        if vertices[k] < vertices[next] { [k, next] } else { [next, k] }
    });
    let whole = turn(corners[0], corners[1], corners[2]);
    let sides = ends.map(|[from, to]| TexelSide {
        from: corners[from],
        to: corners[to],
        inside: turn(corners[from], corners[to], corners[3 - from - to]) >= 0.0,
    });
    let mut pieces = Vec::new();
    let mut met: Vec<(f64, DVec3)> = Vec::new();
    for border in textured.borders() {
        met.clear();
        for (side, [from, to]) in sides.iter().zip(ends) {
            if let Some((part, along)) = side.crossing(border) {
                let at = match part {
                    0.0 => places[from],
                    1.0 => places[to],
                    _ => places[from] + (places[to] - places[from]) * part,
                };
                met.push((along, at));
            }
        }
        if whole != 0.0 {
            let is_in = |p: DVec2| sides.iter().all(|side| side.admits(p));
            for (along, end) in [(0.0, border[0]), (1.0, border[1])] {
                if is_in(end) {
                    met.push((along, inside(&corners, &places, end)));
                }
            }
        }
        met.sort_by(|a, b| a.0.total_cmp(&b.0));
        pieces.extend(met.chunks_exact(2).map(|pair| [pair[0].1, pair[1].1]).filter(|[a, b]| a != b));
    }
    pieces
}

/// The point of a face at a point of the plane of its texels.
fn inside(corners: &[DVec2; 3], places: &[DVec3; 3], at: DVec2) -> DVec3 {
    let shares = [0, 1, 2].map(|k| turn(at, corners[(k + 1) % 3], corners[(k + 2) % 3]));
    let whole: f64 = shares.iter().sum();
    (0..3).map(|k| places[k] * (shares[k] / whole)).sum()
}
