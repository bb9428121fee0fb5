//! [`split_at_seams`]: splits the clipped triangles of a solid where its caps have vertices.

use glam::DVec3;
use rustc_hash::FxHashMap;

use crate::mesh::EdgeMark;
use crate::scene::Geometry;

/// Pieces of an open edge, from its first end to the second.
#[derive(Debug, Clone)]
pub(crate) struct SeamPieces {
    /// Points between the ends.
    pub through: Vec<DVec3>,
    /// Marks of the pieces, one more than there are points.
    pub marks: Vec<EdgeMark>,
}

/// Seams by the bits of their end positions.
pub(crate) type Seams = FxHashMap<[[u64; 3]; 2], SeamPieces>;

/// Bits of a position, as a hash key. Negative zeros become positive.
pub(crate) fn bits(p: DVec3) -> [u64; 3] {
    (p + DVec3::ZERO).to_array().map(f64::to_bits)
}

/// Splits the first `count` triangles of a shape at the seams, and marks their sides.
pub(crate) fn split_at_seams(shape: &mut Geometry, count: usize, seams: &Seams) {
    if seams.is_empty() {
        return;
    }
    shape.edge_marks.resize(shape.triangles.len(), [EdgeMark::Unmarked; 3]);
    for triangle in 0..count.min(shape.triangles.len()) {
        let corners = shape.triangles[triangle];
        let seam = |side: usize| {
            let [a, b] = [corners[side], corners[(side + 1) % 3]].map(|v| bits(shape.positions[v as usize]));
            let turned = |seam: &SeamPieces| SeamPieces {
                through: seam.through.iter().rev().copied().collect(),
                marks: seam.marks.iter().rev().copied().collect(),
            };
            seams.get(&[a, b]).cloned().or_else(|| seams.get(&[b, a]).map(turned))
        };
        // A triangle with several seams lies in the plane and stays unchanged.
        let found: Vec<(usize, SeamPieces)> = (0..3).filter_map(|side| Some((side, seam(side)?))).collect();
        if let [(side, seam)] = found.as_slice() {
            divide(shape, triangle, *side, seam);
        }
    }
}

/// Splits a triangle into a fan along one of its sides.
fn divide(shape: &mut Geometry, triangle: usize, side: usize, seam: &SeamPieces) {
    let [a, b, c] = [0, 1, 2].map(|k| (side + k) % 3);
    let corners = shape.triangles[triangle];
    let marks = shape.edge_marks.get(triangle).copied().unwrap_or_default();
    let [from, to] = [corners[a], corners[b]].map(|v| shape.positions[v as usize]);
    let fraction_along = |p: DVec3| ((p - from).dot(to - from) / (to - from).length_squared()) as f32;
    let mut chain = vec![corners[a]];
    let mut normals = vec![shape.corner_normals.get(triangle).map(|triangle_normals| triangle_normals[a])];
    let mut uvs = vec![shape.corner_uvs.get(triangle).map(|triangle_uvs| triangle_uvs[a])];
    for p in &seam.through {
        chain.push(shape.positions.len() as u32);
        shape.positions.push(*p);
        let t = fraction_along(*p);
        if !shape.colours.is_empty() {
            shape.colours.resize(shape.positions.len() - 1, [1.0; 4]);
            let [start_colour, end_colour] = [corners[a], corners[b]].map(|v| shape.colours[v as usize]);
            shape
                .colours
                .push(std::array::from_fn(|k| start_colour[k] + (end_colour[k] - start_colour[k]) * t));
        }
        normals.push(shape.corner_normals.get(triangle).map(|triangle_normals| {
            push_interpolated(&mut shape.normals, triangle_normals[a], triangle_normals[b], t)
        }));
        uvs.push(
            shape
                .corner_uvs
                .get(triangle)
                .map(|triangle_uvs| push_interpolated(&mut shape.uvs, triangle_uvs[a], triangle_uvs[b], t)),
        );
    }
    chain.push(corners[b]);
    normals.push(shape.corner_normals.get(triangle).map(|triangle_normals| triangle_normals[b]));
    uvs.push(shape.corner_uvs.get(triangle).map(|triangle_uvs| triangle_uvs[b]));
    let last = seam.marks.len() - 1;
    let apex = [&shape.corner_normals, &shape.corner_uvs]
        .map(|corner_lists| corner_lists.get(triangle).map(|own| own[c]));
    for (k, mark) in seam.marks.iter().enumerate() {
        let new = if k == 0 { triangle } else { shape.triangles.len() };
        put(&mut shape.triangles, new, [chain[k], chain[k + 1], corners[c]]);
        let mark = if *mark == EdgeMark::Unmarked { marks[a] } else { *mark };
        let after = if k == last { marks[b] } else { EdgeMark::Hidden };
        let before = if k == 0 { marks[c] } else { EdgeMark::Hidden };
        put(&mut shape.edge_marks, new, [mark, after, before]);
        if let (Some(one), Some(next), Some(third)) = (normals[k], normals[k + 1], apex[0]) {
            put(&mut shape.corner_normals, new, [one, next, third]);
        }
        if let (Some(one), Some(next), Some(third)) = (uvs[k], uvs[k + 1], apex[1]) {
            put(&mut shape.corner_uvs, new, [one, next, third]);
        }
        if let Some(material) = shape.triangle_material.get(triangle).copied() {
            put(&mut shape.triangle_material, new, material);
        }
    }
}

/// Replaces an entry, or appends it.
fn put<T>(to: &mut Vec<T>, at: usize, value: T) {
    match to.get_mut(at) {
        Some(place) => *place = value,
        None => to.push(value),
    }
}

/// Adds the interpolation of two entries. Returns its index, or `u32::MAX` if an entry is missing.
pub(crate) fn push_interpolated<const N: usize>(to: &mut Vec<[f32; N]>, from: u32, next: u32, t: f32) -> u32 {
    let entry = |k: u32| to.get(k as usize).copied();
    let (Some(a), Some(b)) = (entry(from), entry(next)) else { return u32::MAX };
    to.push(std::array::from_fn(|k| a[k] + (b[k] - a[k]) * t));
    to.len() as u32 - 1
}
