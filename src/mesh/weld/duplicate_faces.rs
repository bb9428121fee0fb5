//! Removal of duplicate faces: faces of one part with the same three vertices. Also [`RepairCounts`], the
//! counts of repaired defects.
//!
//! 1. Each face is looked up at the edge between its two smallest vertices, so only faces that share this
//!    edge are compared.
//! 2. Of duplicates with the same winding, the first is kept.
//! 3. Duplicates with opposite windings are back to back; `doubled_sheets` chooses one side for the whole
//!    sheet.

use crate::mesh::edges::triangle_sides::apex;
use crate::parallel::prelude::*;

use super::doubled_sheets;
use crate::mesh::Edges;
use crate::mesh::soup::Soup;

/// Counts of defects that were repaired or found while a mesh was built.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct RepairCounts {
    /// Vertices joined to another at the same position.
    pub welded: u64,
    /// Faces dropped because two of their corners coincide.
    pub collapsed: u64,
    /// Wires dropped because both of their ends coincide.
    pub short_wires: u64,
    /// Faces dropped because another face of the part has the same corners.
    pub doubled: u64,
    /// Faces kept without area: they connect their neighbours but hide nothing.
    pub degenerate: u64,
    /// Edges with one face.
    pub borders: u64,
    /// Edges with three faces or more.
    pub non_manifold: u64,
}

/// Drops the faces for which `keep` is false, with all their attributes.
pub(crate) fn retain_faces(soup: &mut Soup, keep: &[bool]) {
    fn filter<T>(list: &mut Vec<T>, keep: &[bool]) {
        let mut flags = keep.iter();
        list.retain(|_| flags.next().copied().unwrap_or(true));
    }
    let Soup { triangles, triangle_part, triangle_material, triangle_paint, .. } = soup;
    let Soup { corner_normals, corner_uvs, corner_colours, edge_marks, .. } = soup;
    rayon_core::scope(|all| {
        all.spawn(|_| filter(triangles, keep));
        all.spawn(|_| filter(triangle_part, keep));
        all.spawn(|_| filter(triangle_material, keep));
        all.spawn(|_| filter(triangle_paint, keep));
        all.spawn(|_| filter(corner_normals, keep));
        all.spawn(|_| filter(corner_uvs, keep));
        all.spawn(|_| filter(corner_colours, keep));
        all.spawn(|_| filter(edge_marks, keep));
    });
}

/// For each face, whether it is kept: false for all but one of the faces of a part with the same three
/// corners. `None` if there are no duplicates.
///
/// Of duplicates with the same winding the first is kept. For opposite windings see [`doubled_sheets`].
pub(crate) fn unique_faces(soup: &Soup, edges: &Edges) -> Option<Vec<bool>> {
    let found: Vec<DuplicateFaces> =
        edges.suspects.par_chunks(EDGES_PER_TASK).map(|some| DuplicateFaces::at(soup, edges, some)).collect();
    if found.iter().all(|doubles| doubles.dropped.is_empty()) {
        return None;
    }
    let mut keep = vec![true; soup.triangles.len()];
    found.iter().flat_map(|doubles| &doubles.dropped).for_each(|face| keep[*face as usize] = false);
    let mut pairs: Vec<[u32; 2]> = found.iter().flat_map(|doubles| &doubles.pairs).copied().collect();
    // Sorted by part. Within a part they are already in corner order.
    pairs.par_sort_by_key(|[face, _]| part(soup, *face));
    for face in doubled_sheets::choose_sheet_sides(soup, edges, &pairs) {
        keep[face as usize] = true;
    }
    Some(keep)
}

/// Number of edges per task.
const EDGES_PER_TASK: usize = 1 << 12;

/// Duplicate faces found at a range of edges.
#[derive(Default)]
struct DuplicateFaces {
    /// Faces to drop, including both faces of each pair. One face of each pair is restored later.
    dropped: Vec<u32>,
    /// For each set of duplicates with both windings, the first face and the first with the other winding.
    pairs: Vec<[u32; 2]>,
}

impl DuplicateFaces {
    /// Finds the duplicates at some edges. Each face is considered only at the edge between its two smallest
    /// corners.
    fn at(soup: &Soup, edges: &Edges, some: &[u32]) -> Self {
        let mut doubles = Self::default();
        let mut own: Vec<(u32, u32, u32)> = Vec::new();
        for edge in some {
            let ends = edges.vertices[*edge as usize];
            let faces = edges.faces(*edge as usize);
            if faces.list().len() < 2 {
                continue;
            }
            own.clear();
            own.extend(faces.list().iter().filter_map(|&face| {
                let third = apex(soup.triangles[face as usize], ends)?;
                (third > ends[1]).then(|| (part(soup, face), third, face))
            }));
            own.sort_unstable();
            let same = own.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1));
            same.filter(|same| same.len() > 1).for_each(|same| doubles.add(soup, same));
        }
        doubles
    }

    /// Adds a set of duplicate faces. `same` lists them in face order.
    fn add(&mut self, soup: &Soup, same: &[(u32, u32, u32)]) {
        let faces = || same.iter().map(|(_, _, face)| *face);
        let Some(first) = faces().next() else { return };
        match faces().find(|face| has_ascending_winding(soup, *face) != has_ascending_winding(soup, first)) {
            Some(other) => {
                self.pairs.push([first, other]);
                self.dropped.extend(faces());
            }
            None => self.dropped.extend(faces().skip(1)),
        }
    }
}

/// Part number of a face.
fn part(soup: &Soup, face: u32) -> u32 {
    soup.triangle_part.get(face as usize).copied().unwrap_or_default().0
}

/// Whether the corners of a face are a cyclic permutation of ascending ids.
fn has_ascending_winding(soup: &Soup, face: u32) -> bool {
    let [a, b, c] = soup.triangles[face as usize];
    [a < b, b < c, c < a].into_iter().filter(|up| *up).count() == 2
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::geometry::dice::Dice;
    use crate::mesh::PartId;

    /// Reference: compares all faces by part and corners.
    fn unique_faces_by_search(soup: &Soup, edges: &Edges) -> Vec<bool> {
        let mut alike: BTreeMap<(u32, [u32; 3]), Vec<u32>> = BTreeMap::new();
        for (face, corners) in (0..).zip(&soup.triangles) {
            let mut corners = *corners;
            corners.sort_unstable();
            alike.entry((part(soup, face), corners)).or_default().push(face);
        }
        let mut keep = vec![false; soup.triangles.len()];
        let mut pairs = Vec::new();
        for faces in alike.values() {
            match faces
                .iter()
                .find(|face| has_ascending_winding(soup, **face) != has_ascending_winding(soup, faces[0]))
            {
                Some(other) => pairs.push([faces[0], *other]),
                None => keep[faces[0] as usize] = true,
            }
        }
        doubled_sheets::choose_sheet_sides(soup, edges, &pairs)
            .into_iter()
            .for_each(|face| keep[face as usize] = true);
        keep
    }

    #[test]
    fn unique_faces_match_a_search_of_all_faces() {
        let mut dice = Dice::new(7);
        for round in 0..400 {
            // Few vertices give many duplicates, also of three faces and more; many vertices give hardly any.
            let vertices = 4 + round % 30;
            let mut below = |n: u32| dice.below(n as usize) as u32;
            let mut soup = Soup::default();
            while soup.triangles.len() < 60 {
                let corners = [0; 3].map(|_| below(vertices));
                if corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0] {
                    soup.triangles.push(corners);
                    soup.triangle_part.push(PartId(below(1 + round % 3)));
                }
            }
            soup.positions = (0..vertices).map(|_| dice.point(1.0)).collect();
            let edges = Edges::build(soup.positions.len(), &soup.triangles);
            let expected = unique_faces_by_search(&soup, &edges);
            let found = unique_faces(&soup, &edges);
            assert_eq!(found.is_none(), expected.iter().all(|keep| *keep), "{round}");
            assert_eq!(found.unwrap_or_else(|| vec![true; 60]), expected, "{round}");
        }
    }
}
