//! [`assign_kinds`]: numbers the cut parts of a section so that neighbours differ (greedy graph colouring).
//!
//! The number selects the hatching of the cut faces. Parts are neighbours if the bounding boxes of their
//! cut faces nearly touch in the plane of the section.

use super::CutFaces;

/// Maximum gap between the bounding boxes of neighbouring parts, as a share of the larger box's diagonal.
const MAX_NEIGHBOUR_GAP_RATIO: f64 = 0.02;

/// Sets [`CutFaces::kind`] of all parts. In order of decreasing area, each part gets the lowest number that
/// none of its neighbours has yet.
pub(crate) fn assign_kinds(faces: &mut [CutFaces]) {
    let mut order: Vec<usize> = (0..faces.len()).collect();
    order.sort_by(|a, b| faces[*b].area.total_cmp(&faces[*a].area).then(a.cmp(b)));
    let mut done: Vec<usize> = Vec::new();
    for face in order {
        let used_kinds: Vec<usize> = done
            .iter()
            .filter(|neighbour| are_neighbours(&faces[face], &faces[**neighbour]))
            .map(|k| faces[*k].kind)
            .collect();
        faces[face].kind = (0..).find(|kind| !used_kinds.contains(kind)).unwrap_or_default();
        done.push(face);
    }
}

/// Whether the bounding boxes of two parts' cut faces overlap or nearly touch.
pub(crate) fn are_neighbours(a: &CutFaces, b: &CutFaces) -> bool {
    let size = |faces: &CutFaces| faces.bounds[0].distance(faces.bounds[1]);
    let near = MAX_NEIGHBOUR_GAP_RATIO * size(a).max(size(b));
    let apart = (a.bounds[0] - b.bounds[1]).max(b.bounds[0] - a.bounds[1]);
    apart.max_element() <= near
}
