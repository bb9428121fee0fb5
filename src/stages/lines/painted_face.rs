//! Where the colours of pictures and of vertices change on a face, and along its sides.

use glam::DVec2;

use super::Lit;
use super::drawn::OnPicture;
use super::isophotes::page_px;
use super::textured::Textured;
use super::tint_borders::TintedFace;
use crate::mesh::PaintId;
use crate::scene::texels::side::{TexelSide, turn};

/// A piece of a border on a face.
pub(super) struct Piece {
    /// In barycentric weights.
    pub ends: [[f64; 3]; 2],
    /// What it parts: twice the same where a picture only changes its scale.
    pub paints: [PaintId; 2],
}

/// What lies on a face of the borders between its colours.
pub(super) fn borders(lit: &Lit, face: u32, textured: &Textured) -> Vec<Piece> {
    let mut pieces = Vec::new();
    let middle = |[a, b]: [[f64; 3]; 2]| [0, 1, 2].map(|k| f64::midpoint(a[k], b[k]));
    if let Some(on) = textured.picture {
        of_picture(lit, face, &on, |ends, colours| {
            let paints = textured.parted(colours, middle(ends));
            pieces.extend(paints.map(|paints| Piece { ends, paints }));
        });
        let own = lit.mesh.paint(crate::mesh::FaceId(face));
        pieces.extend(level_lines(lit, face, &on).into_iter().map(|ends| Piece { ends, paints: [own; 2] }));
    }
    if let Some((tints, light)) = textured.tints {
        for (ends, parted) in TintedFace::new(lit, face, tints, light, page_px(lit)).borders() {
            let paints = textured.parted_tints(parted, middle(ends)).filter(|[a, b]| a != b);
            pieces.extend(paints.map(|paints| Piece { ends, paints }));
        }
    }
    pieces
}

/// The places on a side of a face where its colours change, from one end to the other: in barycentric weights.
pub(super) fn changes_along(lit: &Lit, face: u32, textured: &Textured, ends: [u32; 2]) -> Vec<[f64; 3]> {
    let vertices = lit.mesh.triangles[face as usize];
    let Some([from, to]) = corners_of(vertices, ends) else { return Vec::new() };
    let mut found = Vec::new();
    if let Some(on) = textured.picture {
        for (level, [begins, stops]) in on.levels() {
            let Some(corners) = on.corners(level) else { continue };
            let side = side(corners, [from, to]);
            for (border, _) in on.borders(level) {
                if let Some((part, _)) = side.crossing(border) {
                    let at = on_side([from, to], part);
                    let density = on.density(at);
                    if density >= begins && density < stops {
                        found.push(at);
                    }
                }
            }
            found.extend(level_crossing(&on, [from, to], stops).map(|part| on_side([from, to], part)));
        }
    }
    if let Some((tints, light)) = textured.tints {
        let borders = TintedFace::new(lit, face, tints, light, page_px(lit)).borders();
        let all = borders.into_iter().flat_map(|(ends, _)| ends);
        found.extend(all.filter(|at| at[3 - from - to] == 0.0));
    }
    found.retain(|at| at[from] > 0.0 && at[to] > 0.0);
    found.sort_by(|a, b| a[to].total_cmp(&b[to]));
    found.dedup();
    found
}

/// The corners of a face that are these vertices.
fn corners_of(vertices: [u32; 3], ends: [u32; 2]) -> Option<[usize; 2]> {
    let [from, to] = ends.map(|v| vertices.iter().position(|own| *own == v));
    Some([from?, to?]).filter(|[from, to]| from != to)
}

/// A point of a side, so far on the way from one corner to the other.
fn on_side([from, to]: [usize; 2], part: f64) -> [f64; 3] {
    let mut weights = [0.0; 3];
    weights[from] = 1.0 - part;
    weights[to] = part;
    weights
}

/// A side of a face in the plane of the texels.
fn side(corners: [DVec2; 3], [from, to]: [usize; 2]) -> TexelSide {
    let inside = turn(corners[from], corners[to], corners[3 - from - to]) >= 0.0;
    TexelSide { from: corners[from], to: corners[to], inside }
}

/// The sides of a face, each from the vertex of the lesser number, so that both its faces cut it from the same end on.
fn side_ends(lit: &Lit, face: u32) -> [[usize; 2]; 3] {
    let vertices = lit.mesh.triangles[face as usize];
    [0, 1, 2].map(|k| {
        let next = (k + 1) % 3;
        if vertices[k] < vertices[next] { [k, next] } else { [next, k] }
    })
}

/// How far along a side texels reach a density.
fn level_crossing(on: &OnPicture, [from, to]: [usize; 2], density: f64) -> Option<f64> {
    let [a, b] = [from, to].map(|k| on.densities()[k]);
    ((a >= density) != (b >= density)).then(|| (density - a) / (b - a))
}

/// The lines on a face along which the scale of its picture changes.
fn level_lines(lit: &Lit, face: u32, on: &OnPicture) -> Vec<[[f64; 3]; 2]> {
    let sides = side_ends(lit, face);
    let line = |(_, [_, stops]): (usize, [f64; 2])| {
        let mut met = sides.iter().filter_map(|ends| Some(on_side(*ends, level_crossing(on, *ends, stops)?)));
        Some([met.next()?, met.next()?])
    };
    on.levels().filter_map(line).collect()
}

/// What lies on a face of the borders of its picture.
fn of_picture(lit: &Lit, face: u32, on: &OnPicture, mut put: impl FnMut([[f64; 3]; 2], [u8; 2])) {
    let ends = side_ends(lit, face);
    for (level, range) in on.levels() {
        let Some(corners) = on.corners(level) else { continue };
        let whole = turn(corners[0], corners[1], corners[2]);
        let sides = ends.map(|ends| side(corners, ends));
        let mut met: Vec<(f64, [f64; 3])> = Vec::new();
        for (border, parted) in on.borders(level) {
            met.clear();
            for (side, ends) in sides.iter().zip(ends) {
                if let Some((part, along)) = side.crossing(border) {
                    met.push((along, on_side(ends, part)));
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
            let pieces = met.chunks_exact(2).filter_map(|pair| within(on, [pair[0].1, pair[1].1], range));
            pieces.for_each(|ends| put(ends, parted));
        }
    }
}

/// The part of a piece of border where texels are as dense as this.
fn within(on: &OnPicture, ends: [[f64; 3]; 2], [begins, stops]: [f64; 2]) -> Option<[[f64; 3]; 2]> {
    let [a, b] = ends.map(|end| on.density(end));
    let is_in = |density: f64| density >= begins && density < stops;
    if is_in(a) && is_in(b) {
        return Some(ends);
    }
    if a.max(b) < begins || a.min(b) >= stops {
        return None;
    }
    let at = |density: f64| {
        let part = (density - a) / (b - a);
        [0, 1, 2].map(|k| ends[0][k] + (ends[1][k] - ends[0][k]) * part)
    };
    let end = |own: [f64; 3], density: f64| {
        if density < begins {
            at(begins)
        } else if density >= stops {
            at(stops)
        } else {
            own
        }
    };
    Some([end(ends[0], a), end(ends[1], b)])
}

/// The barycentric weights of a point of the plane of the texels.
fn weights(corners: &[DVec2; 3], at: DVec2) -> [f64; 3] {
    let shares = [0, 1, 2].map(|k| turn(at, corners[(k + 1) % 3], corners[(k + 2) % 3]));
    let whole: f64 = shares.iter().sum();
    shares.map(|share| share / whole)
}
