//! Canonical order of vertices and faces, which depends on positions and not on the file.
//!
//! 1. Vertices are sorted along a Morton curve, so that neighbours in space are neighbours in memory. Equal
//!    positions become one vertex.
//! 2. Faces are sorted by part and material, in the order of the file, and then by their vertices. Each face
//!    begins with its smallest vertex. Wires follow the same rule.
//!
//! The numbering of a model must not affect its drawing. Without a canonical order it would decide which of
//! two coincident lines remains, the last bit of sums over faces, and where a closed line begins.
//!
//! The curve covers all of space, not the box of the model. The order of two positions therefore depends on
//! nothing else, and other parts can be added or removed without changing it.

use std::sync::atomic::AtomicU32;
use std::sync::atomic::Ordering::Relaxed;

use crate::parallel::prelude::*;
use glam::DVec3;

use super::counting_sort::counting_sort;
use crate::geometry::numbers::powers_of_two::power_of_two_above;
use crate::geometry::space::morton_curve::{CELLS_PER_HALF_AXIS, along_curve, along_exact_curve};
use crate::mesh::{MaterialId, PartId, Soup};
use crate::parallel::task_size::MIN_TASK_ITEMS;

/// Minimum number of vertices or faces per task. A task ends at the end of a run.
const MIN_ITEMS_PER_TASK: usize = 1 << 11;

/// Index of a missing normal or texture coordinate.
const NO_ATTRIBUTE: u32 = u32::MAX;

/// Face rotated to begin with its smallest vertex.
#[derive(Clone, Copy, Default)]
struct OrderedFace {
    corners: [u32; 3],
    /// Original face index, shifted left by two. The lowest two bits are the corner that now comes first.
    face_turn: u32,
}

impl OrderedFace {
    fn new(face: usize, [a, b, c]: [u32; 3]) -> Self {
        let turn = if a <= b && a <= c {
            0
        } else if b <= c {
            1
        } else {
            2
        };
        Self { corners: turned([a, b, c], turn), face_turn: (face as u32) << 2 | turn }
    }

    fn face(&self) -> usize {
        (self.face_turn >> 2) as usize
    }

    /// The second and third corner, as one number.
    fn others(&self) -> u64 {
        u64::from(self.corners[1]) << 32 | u64::from(self.corners[2])
    }

    fn turn(&self) -> u32 {
        self.face_turn & 3
    }
}

/// Sorts a soup with coordinates up to `largest`, and joins vertices at equal positions. Returns the number
/// of vertices that were removed.
pub(crate) fn sort_by_position(soup: &mut Soup, largest: f64) -> u64 {
    let before = soup.positions.len();
    let new_id = order_vertices(&mut soup.positions, largest);
    order_faces(soup, &new_id);
    for wire in &mut soup.wires {
        wire.vertices = wire.vertices.map(|v| new_id[v as usize]);
        wire.vertices.sort_unstable();
    }
    soup.wires.sort_unstable_by_key(|wire| (wire.part, wire.material, wire.vertices));
    (before - soup.positions.len()) as u64
}

/// Sorts the faces of a soup again, after some of them were turned.
pub(crate) fn sort_faces_by_position(soup: &mut Soup) {
    let same: Vec<u32> = (0..soup.positions.len() as u32).collect();
    order_faces(soup, &same);
}

/// Sorts positions and removes duplicates. Returns the new id of each old vertex.
fn order_vertices(positions: &mut Vec<DVec3>, largest: f64) -> Vec<u32> {
    // A power of two, so that the cells of a larger model consist of cells of a smaller one.
    let cell = power_of_two_above(largest) / CELLS_PER_HALF_AXIS;
    let keyed: Vec<(u64, u32)> = positions
        .par_iter()
        .enumerate()
        .with_min_len(MIN_TASK_ITEMS)
        .map(|(id, p)| (along_curve(*p, cell), id as u32))
        .collect();
    // The first sort is by large cells; a surface meets one for every few vertices. Bits that are equal in
    // all keys are skipped.
    let first = keyed.first().map_or(0, |(key, _)| *key);
    let different =
        keyed.par_iter().with_min_len(MIN_TASK_ITEMS).map(|(key, _)| key ^ first).reduce(|| 0, |a, b| a | b);
    let used = 64 - different.leading_zeros();
    let depth = (positions.len() / 8).max(1).ilog2().div_ceil(2).min(7);
    let bits = (3 * depth).min(used);
    let large = |key: u64| (key >> (used - bits)) as u32 & ((1 << bits) - 1);
    let mut keyed = counting_sort(keyed, 1 << bits, |(key, _)| large(*key));
    let place = |id: u32| positions[id as usize];
    let at_one_cell = |a: &(u64, u32), b: &(u64, u32)| large(a.0) == large(b.0);
    for_each_run(&mut keyed, at_one_cell, |cell| {
        cell.sort_unstable_by(|a, b| a.0.cmp(&b.0).then_with(|| along_exact_curve(place(a.1), place(b.1))));
    });

    numbered(positions, &keyed)
}

/// Keeps each position once, in the order of `keyed`. Returns the new id of each old vertex.
fn numbered(positions: &mut Vec<DVec3>, keyed: &[(u64, u32)]) -> Vec<u32> {
    let place = |k: usize| positions[keyed[k].1 as usize];
    let is_new = |k: usize| k == 0 || place(k - 1) != place(k);
    let chunks = keyed.len().div_ceil(MIN_TASK_ITEMS);
    let chunk = |c: usize| c * MIN_TASK_ITEMS..((c + 1) * MIN_TASK_ITEMS).min(keyed.len());
    let counts: Vec<usize> =
        (0..chunks).into_par_iter().map(|c| chunk(c).filter(|k| is_new(*k)).count()).collect();
    let mut places = vec![DVec3::ZERO; counts.iter().sum()];
    let mut free = places.as_mut_slice();
    let mut before = 0;
    let mut each = Vec::with_capacity(chunks);
    for (c, count) in counts.into_iter().enumerate() {
        let own;
        (own, free) = free.split_at_mut(count);
        each.push((c, before, own));
        before += count as u32;
    }
    let new_id: Vec<AtomicU32> = (0..positions.len())
        .into_par_iter()
        .with_min_len(MIN_TASK_ITEMS)
        .map(|_| AtomicU32::new(0))
        .collect();
    each.into_par_iter().for_each(|(c, before, own)| {
        let mut count = 0;
        for k in chunk(c) {
            if is_new(k) {
                own[count] = place(k);
                count += 1;
            }
            // A chunk may begin with the last position of the previous chunk.
            new_id[keyed[k].1 as usize].store(before + count as u32 - 1, Relaxed);
        }
    });
    *positions = places;
    new_id.into_iter().map(AtomicU32::into_inner).collect()
}

/// Renumbers the vertices of the faces, and sorts the faces.
fn order_faces(soup: &mut Soup, new_id: &[u32]) {
    let renamed = |t: &[u32; 3]| t.map(|v| new_id[v as usize]);
    let entry = |(face, t): (usize, &[u32; 3])| OrderedFace::new(face, renamed(t));
    let of_file: Vec<OrderedFace> =
        soup.triangles.par_iter().enumerate().with_min_len(MIN_TASK_ITEMS).map(entry).collect();
    let mut entries = counting_sort(of_file, soup.positions.len(), |e| e.corners[0]);
    let groups = groups(soup);
    let group = |e: &OrderedFace| groups.as_ref().map_or(0, |groups| groups.of_face[e.face()]);
    if let Some(groups) = &groups {
        entries = counting_sort(entries, groups.count, group);
    }
    let at_one_corner =
        |a: &OrderedFace, b: &OrderedFace| a.corners[0] == b.corners[0] && group(a) == group(b);
    for_each_run(&mut entries, at_one_corner, |faces| {
        faces.sort_unstable_by(|a, b| {
            a.others().cmp(&b.others()).then_with(|| attributes(soup, a).cmp(&attributes(soup, b)))
        });
    });

    soup.triangles = entries.par_iter().with_min_len(MIN_TASK_ITEMS).map(|e| e.corners).collect();
    if groups.is_some() {
        reorder(&mut soup.triangle_part, &entries, |part, _| part);
        reorder(&mut soup.triangle_material, &entries, |material, _| material);
    }
    reorder(&mut soup.triangle_paint, &entries, |paint, _| paint);
    reorder(&mut soup.corner_normals, &entries, turned);
    reorder(&mut soup.corner_uvs, &entries, turned);
    reorder(&mut soup.corner_colours, &entries, turned);
    reorder(&mut soup.edge_marks, &entries, turned);
}

/// Rotates the values of corners, or of sides, to begin at another corner.
fn turned<T: Copy>([a, b, c]: [T; 3], turn: u32) -> [T; 3] {
    match turn {
        0 => [a, b, c],
        1 => [b, c, a],
        _ => [c, a, b],
    }
}

/// Applies `change` to each run of equivalent neighbours.
fn for_each_run<T: Send>(
    items: &mut [T],
    together: impl Fn(&T, &T) -> bool + Sync,
    change: impl Fn(&mut [T]) + Sync,
) {
    // Tasks are split at the ends of runs and have similar sizes. An automatic split leaves some threads
    // waiting.
    let mut pieces = Vec::new();
    let mut rest = items;
    while rest.len() > MIN_ITEMS_PER_TASK {
        let end = (MIN_ITEMS_PER_TASK..rest.len())
            .find(|k| !together(&rest[k - 1], &rest[*k]))
            .unwrap_or(rest.len());
        let piece;
        (piece, rest) = rest.split_at_mut(end);
        pieces.push(piece);
    }
    pieces.push(rest);
    let change_all = |piece: &mut [T]| piece.chunk_by_mut(&together).for_each(&change);
    pieces.into_par_iter().with_max_len(1).for_each(change_all);
}

/// Numbers of combinations of part and material, in the order of parts, then of materials.
struct MaterialGroups {
    of_face: Vec<u32>,
    count: usize,
}

/// Groups of the faces by part and material; `None` if there is only one.
fn groups(soup: &Soup) -> Option<MaterialGroups> {
    let key = |face: usize| {
        let part = soup.triangle_part.get(face).copied().unwrap_or_default();
        (part, soup.triangle_material.get(face).copied().unwrap_or_default())
    };
    let faces = soup.triangles.len();
    let first = key(0);
    if (1..faces).into_par_iter().with_min_len(MIN_TASK_ITEMS).all(|face| key(face) == first) {
        return None;
    }
    let mut keys: Vec<(PartId, MaterialId)> = (0..faces).map(key).collect();
    keys.dedup();
    keys.sort_unstable();
    keys.dedup();
    let of = |face: usize| keys.binary_search(&key(face)).unwrap_or_default() as u32;
    let of_face = (0..faces).into_par_iter().with_min_len(MIN_TASK_ITEMS).map(of).collect();
    Some(MaterialGroups { of_face, count: keys.len() })
}

/// Remaining attributes of a face, which order faces with equal corners: paint, marks, and the bits of its
/// corner values. Faces with equal attributes are interchangeable.
fn attributes(soup: &Soup, entry: &OrderedFace) -> impl Ord + use<> {
    let (face, turn) = (entry.face(), entry.turn());
    let at_corners =
        |corners: &[[u32; 3]]| turned(corners.get(face).copied().unwrap_or([NO_ATTRIBUTE; 3]), turn);
    let normal = |id: u32| soup.normals.get(id as usize).map(|n| n.map(f32::to_bits));
    let uv = |id: u32| soup.uvs.get(id as usize).map(|uv| uv.map(f32::to_bits));
    (
        soup.triangle_paint.get(face).copied(),
        soup.edge_marks.get(face).map(|marks| turned(*marks, turn).map(|mark| mark as u8)),
        at_corners(&soup.corner_normals).map(normal),
        at_corners(&soup.corner_uvs).map(uv),
        soup.corner_colours.get(face).map(|colours| turned(*colours, turn).map(|c| c.map(f32::to_bits))),
    )
}

/// Sorts a list with one entry per face into the new face order. `change` adapts an entry to the rotation of
/// its face.
fn reorder<T: Copy + Default + Send + Sync>(
    list: &mut Vec<T>,
    entries: &[OrderedFace],
    change: impl Fn(T, u32) -> T + Sync,
) {
    if !list.is_empty() {
        let of = |e: &OrderedFace| change(list.get(e.face()).copied().unwrap_or_default(), e.turn());
        *list = entries.par_iter().with_min_len(MIN_TASK_ITEMS).map(of).collect();
    }
}

#[cfg(test)]
mod tests;
