//! [`assign_kinds`]: numbers of cut parts that differ between neighbours (greedy graph colouring).

use super::CutFaces;

/// Maximum gap between the boxes of neighbouring parts, as a share of the larger diagonal.
const MAX_NEIGHBOUR_GAP_RATIO: f64 = 0.02;

/// Assigns numbers by decreasing area: the lowest number that no numbered neighbour has.
pub(crate) fn assign_kinds(faces: &mut [CutFaces]) {
    let mut order: Vec<usize> = (0..faces.len()).collect();
    order.sort_by(|a, b| faces[*b].area.total_cmp(&faces[*a].area).then(a.cmp(b)));
    let mut done: Vec<usize> = Vec::new();
    for own in order {
        let taken: Vec<usize> = done
            .iter()
            .filter(|other| are_neighbours(&faces[own], &faces[**other]))
            .map(|k| faces[*k].kind)
            .collect();
        faces[own].kind = (0..).find(|kind| !taken.contains(kind)).unwrap_or_default();
        done.push(own);
    }
}

/// Whether the faces of two parts touch or nearly touch, by their boxes.
pub(crate) fn are_neighbours(a: &CutFaces, b: &CutFaces) -> bool {
    let size = |faces: &CutFaces| faces.bounds[0].distance(faces.bounds[1]);
    let near = MAX_NEIGHBOUR_GAP_RATIO * size(a).max(size(b));
    let apart = (a.bounds[0] - b.bounds[1]).max(b.bounds[0] - a.bounds[1]);
    apart.max_element() <= near
}
