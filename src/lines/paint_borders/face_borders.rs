//! Colour borders on a face, and the points on its sides where colours change.

use glam::DVec2;

use super::vertex_colour_borders::TintedFace;
use crate::lines::Lit;
use crate::lines::isophotes::isophote_lines::page_px;
use crate::lines::textures::picture_levels::PictureFace;
use crate::lines::textures::textured_face::TexturedFace;
use crate::mesh::PaintId;
use crate::scene::textures::texel_plane::side_crossings::{TexelSide, doubled_area};

/// Piece of a border on a face.
pub(crate) struct PaintBorder {
    /// Ends in barycentric weights.
    pub ends: [[f64; 3]; 2],
    /// Paints on both sides; equal where only the level of a picture changes.
    pub paints: [PaintId; 2],
}

/// Colour borders on a face.
pub(crate) fn borders(lit: &Lit, face: u32, textured: &TexturedFace) -> Vec<PaintBorder> {
    let mut pieces = Vec::new();
    let middle = |[a, b]: [[f64; 3]; 2]| [0, 1, 2].map(|k| f64::midpoint(a[k], b[k]));
    if let Some(on) = textured.picture {
        picture_borders(lit, face, &on, |ends, colours| {
            let paints = textured.border_paints(colours, middle(ends));
            pieces.extend(paints.map(|paints| PaintBorder { ends, paints }));
        });
        let face_paint = lit.mesh.paint(crate::mesh::FaceId(face));
        let sides = side_ends(lit, face);
        let lines = on.level_lines(&sides).into_iter();
        let lines = lines.map(|line| line.map(|(side, part)| on_side(sides[side], part)));
        pieces.extend(lines.map(|ends| PaintBorder { ends, paints: [face_paint; 2] }));
    }
    if let Some((tints, light)) = textured.tints {
        for (ends, parted) in TintedFace::new(lit, face, tints, light, page_px(lit)).borders() {
            let paints = textured.tint_border_paints(parted, middle(ends)).filter(|[a, b]| a != b);
            pieces.extend(paints.map(|paints| PaintBorder { ends, paints }));
        }
    }
    pieces
}

/// Points on a side of a face where colours change, from one end to the other, in barycentric weights.
pub(crate) fn changes_along(lit: &Lit, face: u32, textured: &TexturedFace, ends: [u32; 2]) -> Vec<[f64; 3]> {
    let vertices = lit.mesh.triangles[face as usize];
    let Some([from, to]) = corners_of(vertices, ends) else { return Vec::new() };
    let mut found = Vec::new();
    if let Some(on) = textured.picture {
        for level in on.levels() {
            let Some(corners) = on.corners(level) else { continue };
            let side = side(corners, [from, to]);
            let parts = on.borders(level).into_iter().filter_map(|(border, _)| side.crossing(border));
            let crossings = parts.map(|(part, _)| on_side([from, to], part));
            found.extend(crossings.filter(|at| on.level(*at) == level));
        }
        let full_side = [on_side([from, to], 0.0), on_side([from, to], 1.0)];
        found.extend(on.level_ends(full_side).into_iter().map(|part| on_side([from, to], part)));
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

/// Corners of a face with the given vertices.
fn corners_of(vertices: [u32; 3], ends: [u32; 2]) -> Option<[usize; 2]> {
    let [from, to] = ends.map(|v| vertices.iter().position(|vertex| *vertex == v));
    Some([from?, to?]).filter(|[from, to]| from != to)
}

/// Point of a side at the given parameter between two corners.
fn on_side([from, to]: [usize; 2], part: f64) -> [f64; 3] {
    let mut weights = [0.0; 3];
    weights[from] = 1.0 - part;
    weights[to] = part;
    weights
}

/// Side of a face in texel coordinates.
fn side(corners: [DVec2; 3], [from, to]: [usize; 2]) -> TexelSide {
    let inside = doubled_area(corners[from], corners[to], corners[3 - from - to]) >= 0.0;
    TexelSide { from: corners[from], to: corners[to], inside }
}

/// Sides of a face, each starting at the smaller vertex, so that both its faces cut it from the same end.
fn side_ends(lit: &Lit, face: u32) -> [[usize; 2]; 3] {
    let vertices = lit.mesh.triangles[face as usize];
    [0, 1, 2].map(|k| {
        let next = (k + 1) % 3;
        if vertices[k] < vertices[next] { [k, next] } else { [next, k] }
    })
}

/// Borders of the picture, clipped to the face.
fn picture_borders(lit: &Lit, face: u32, on: &PictureFace, mut put: impl FnMut([[f64; 3]; 2], [u8; 2])) {
    let ends = side_ends(lit, face);
    for level in on.levels() {
        let Some(corners) = on.corners(level) else { continue };
        let twice_area = doubled_area(corners[0], corners[1], corners[2]);
        let sides = ends.map(|ends| side(corners, ends));
        let mut crossed_points: Vec<(f64, [f64; 3])> = Vec::new();
        for (border, parted) in on.borders(level) {
            crossed_points.clear();
            for (side, ends) in sides.iter().zip(ends) {
                if let Some((part, along)) = side.crossing(border) {
                    crossed_points.push((along, on_side(ends, part)));
                }
            }
            if twice_area != 0.0 {
                let is_in = |p: DVec2| sides.iter().all(|side| side.admits(p));
                for (along, end) in [(0.0, border[0]), (1.0, border[1])] {
                    if is_in(end) {
                        crossed_points.push((along, weights(&corners, end)));
                    }
                }
            }
            crossed_points.sort_by(|a, b| a.0.total_cmp(&b.0));
            for pair in crossed_points.chunks_exact(2) {
                parts_on_level(on, [pair[0].1, pair[1].1], level)
                    .into_iter()
                    .for_each(|ends| put(ends, parted));
            }
        }
    }
}

/// Parts of a border piece where the given level applies.
fn parts_on_level(on: &PictureFace, ends: [[f64; 3]; 2], level: usize) -> Vec<[[f64; 3]; 2]> {
    let cuts = on.level_ends(ends);
    let at = |part: f64| [0, 1, 2].map(|k| ends[0][k] + (ends[1][k] - ends[0][k]) * part);
    let mut cut_points: Vec<(f64, [f64; 3])> = vec![(0.0, ends[0])];
    cut_points
        .extend(cuts.into_iter().filter(|part| *part > 0.0 && *part < 1.0).map(|part| (part, at(part))));
    cut_points.push((1.0, ends[1]));
    let parts =
        cut_points.windows(2).map(|pair| (f64::midpoint(pair[0].0, pair[1].0), [pair[0].1, pair[1].1]));
    parts.filter(|(middle, _)| on.level(at(*middle)) == level).map(|(_, ends)| ends).collect()
}

/// Barycentric weights of a point in texel coordinates.
fn weights(corners: &[DVec2; 3], at: DVec2) -> [f64; 3] {
    let shares = [0, 1, 2].map(|k| doubled_area(at, corners[(k + 1) % 3], corners[(k + 2) % 3]));
    let area_sum: f64 = shares.iter().sum();
    shares.map(|share| share / area_sum)
}
