//! Cleaning: faces that no surface has, and the count of what was mended.

use super::Edges;
use super::soup::Soup;

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
    filter(&mut soup.edge_marks, keep);
}

/// For each face whether it is the first of its part with its three corners (in any order);
/// `None` if all are.
pub(super) fn first_of_doubles(soup: &Soup, edges: &Edges) -> Option<Vec<bool>> {
    let mut suspects: Vec<u32> = Vec::new();
    for &edge in &edges.suspects {
        match edges.faces(edge as usize) {
            super::EdgeFaces::One(_) => {}
            super::EdgeFaces::Two { faces, .. } => suspects.extend(faces),
            super::EdgeFaces::Many(faces) => suspects.extend(faces),
        }
    }
    suspects.sort_unstable();
    suspects.dedup();
    let key = |face: u32| {
        let mut corners = soup.triangles[face as usize];
        corners.sort_unstable();
        (soup.triangle_part.get(face as usize).copied().unwrap_or_default(), corners)
    };
    suspects.sort_by_key(|&face| (key(face), face));
    let mut keep = vec![true; soup.triangles.len()];
    let mut dropped = false;
    for pair in suspects.windows(2) {
        if key(pair[0]) == key(pair[1]) {
            keep[pair[1] as usize] = false;
            dropped = true;
        }
    }
    dropped.then_some(keep)
}
