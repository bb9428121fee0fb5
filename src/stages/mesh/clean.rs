//! Cleaning: faces that no surface has, and the count of what was mended.

use rayon::prelude::*;

use super::soup::Soup;
use super::{Edges, sheets};

/// What was mended or noticed while a mesh was built.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Cleaning {
    /// Vertices joined to another at the same place.
    pub welded: u64,
    /// Faces dropped because two of their corners were one place.
    pub collapsed: u64,
    /// Faces dropped because another face of the part had the same corners.
    pub doubled: u64,
    /// Faces kept that have no area: they join their neighbours but hide nothing.
    pub degenerate: u64,
    /// Edges with one face.
    pub borders: u64,
    /// Edges with three faces or more.
    pub non_manifold: u64,
}

/// Drops the faces (and all that is stored beside them) for which `keep` is false.
pub(super) fn retain_faces(soup: &mut Soup, keep: &[bool]) {
    fn filter<T>(list: &mut Vec<T>, keep: &[bool]) {
        let mut flags = keep.iter();
        list.retain(|_| flags.next().copied().unwrap_or(true));
    }
    filter(&mut soup.triangles, keep);
    filter(&mut soup.triangle_part, keep);
    filter(&mut soup.triangle_material, keep);
    filter(&mut soup.triangle_paint, keep);
    filter(&mut soup.corner_normals, keep);
    filter(&mut soup.corner_uvs, keep);
    filter(&mut soup.corner_colours, keep);
    filter(&mut soup.edge_marks, keep);
}

/// For each face whether it is the only one of its part with its three corners (in any order), or
/// the one of several that stays; `None` if all are alone.
///
/// Of faces that run the same way the first stays; where they run both ways, see [`sheets`].
pub(super) fn one_of_doubles(soup: &Soup, edges: &Edges) -> Option<Vec<bool>> {
    if edges.suspects.is_empty() {
        return None;
    }
    let mut is_suspect = vec![false; soup.triangles.len()];
    for &edge in &edges.suspects {
        match edges.faces(edge as usize) {
            super::EdgeFaces::One(_) => {}
            faces => faces.list().iter().for_each(|face| is_suspect[*face as usize] = true),
        }
    }
    let part = |face: u32| soup.triangle_part.get(face as usize).copied().unwrap_or_default();
    let key = |face: u32| {
        let mut corners = soup.triangles[face as usize];
        corners.sort_unstable();
        // Part and corners, one after the other.
        corners.iter().fold(u128::from(part(face).0), |key, corner| key << 32 | u128::from(*corner))
    };
    // Whether the corners run from the least id to the greatest by way of the third.
    let is_upward = |face: u32| {
        let [a, b, c] = soup.triangles[face as usize];
        [a < b, b < c, c < a].into_iter().filter(|up| *up).count() == 2
    };
    let suspects = (0..soup.triangles.len() as u32).filter(|face| is_suspect[*face as usize]);
    let mut keyed: Vec<(u128, u32)> = suspects.map(|face| (key(face), face)).collect();
    drop(is_suspect);
    keyed.par_sort_unstable();
    let mut keep = vec![true; soup.triangles.len()];
    let mut pairs: Vec<[u32; 2]> = Vec::new();
    let mut dropped = false;
    for doubles in keyed.chunk_by(|a, b| a.0 == b.0).filter(|doubles| doubles.len() > 1) {
        dropped = true;
        doubles.iter().for_each(|(_, face)| keep[*face as usize] = false);
        let first = doubles[0].1;
        match doubles.iter().find(|(_, face)| is_upward(*face) != is_upward(first)) {
            Some((_, other)) => pairs.push([first, *other]),
            None => keep[first as usize] = true,
        }
    }
    for face in sheets::one_side(soup, edges, &pairs) {
        keep[face as usize] = true;
    }
    dropped.then_some(keep)
}
