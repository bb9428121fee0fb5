//! The borders between the colours of pictures, carried over to the faces that show them.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::isophotes::page_px;
use super::textures::Textured;
use super::tone_edges::segment;
use super::{FeatureLines, LineKind, Lit, NO_FACE};
use crate::mesh::FaceId;
use crate::scene::texels::side::{TexelSide, turn};

/// Adds the borders between the colours of pictures.
pub fn find(lit: &Lit, lines: &mut FeatureLines) {
    if lit.textures.is_empty() {
        return;
    }
    const CHUNK: usize = 1 << 11;
    let px = page_px(lit);
    let count = lit.mesh.triangles.len();
    let found: Vec<Vec<(u32, LineKind, [DVec3; 2])>> = (0..count.div_ceil(CHUNK))
        .into_par_iter()
        .map(|chunk| {
            let mut pieces = Vec::new();
            for face in chunk * CHUNK..((chunk + 1) * CHUNK).min(count) {
                let face = face as u32;
                let is_seen = lit.may_be_seen(face as usize) && !lit.mesh.is_degenerate(FaceId(face));
                if let Some(textured) = lit.textures.on(lit.mesh, face).filter(|_| is_seen) {
                    pieces.extend(on_face(lit, face, &textured, px));
                }
            }
            pieces
        })
        .collect();
    lines.append_in_faces(lit.mesh, found.into_iter().flatten(), |face, kind, ends| {
        segment(lit.mesh, face, [face, NO_FACE], kind, ends)
    });
}

/// What lies on a face of the borders of its picture.
fn on_face(lit: &Lit, face: u32, textured: &Textured, px: f64) -> Vec<(u32, LineKind, [DVec3; 2])> {
    let corners = textured.corners;
    let vertices = lit.mesh.triangles[face as usize];
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
    let mut met: Vec<(f64, [f64; 3])> = Vec::new();
    for (border, [a, b]) in textured.borders() {
        met.clear();
        for (side, [from, to]) in sides.iter().zip(ends) {
            if let Some((part, along)) = side.crossing(border) {
                let mut weights = [0.0; 3];
                weights[from] = 1.0 - part;
                weights[to] = part;
                met.push((along, weights));
            }
        }
        if whole != 0.0 {
            let is_in = |p: DVec2| sides.iter().all(|side| side.admits(p));
            for (along, end) in [(0.0, border[0]), (1.0, border[1])] {
                if is_in(end) {
                    met.push((along, weights(&corners, end)));
                }
            }
        }
        met.sort_by(|a, b| a.0.total_cmp(&b.0));
        let at = |weights: [f64; 3]| lit.lifted(face, weights, px);
        let found = met.chunks_exact(2).map(|pair| [at(pair[0].1), at(pair[1].1)]).filter(|[a, b]| a != b);
        let kind = lit.textures.parting(a, b);
        pieces.extend(found.map(|ends| (face, kind, ends)));
    }
    pieces
}

/// The barycentric weights of a point of the plane of the texels.
fn weights(corners: &[DVec2; 3], at: DVec2) -> [f64; 3] {
    let shares = [0, 1, 2].map(|k| turn(at, corners[(k + 1) % 3], corners[(k + 2) % 3]));
    let whole: f64 = shares.iter().sum();
    shares.map(|share| share / whole)
}
