//! [`number`]: numbers of cut parts, by which neighbours differ.

use super::CutFaces;

/// Parts are neighbours where the boxes around their faces come nearer than this share of the larger one's diagonal.
const NEAR: f64 = 0.02;

/// Gives the faces of each part the least number that none of its neighbours with larger faces has.
pub(crate) fn number(faces: &mut [CutFaces]) {
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

/// Whether the faces of two parts touch or nearly do.
pub(crate) fn are_neighbours(a: &CutFaces, b: &CutFaces) -> bool {
    let size = |faces: &CutFaces| faces.bounds[0].distance(faces.bounds[1]);
    let near = NEAR * size(a).max(size(b));
    let apart = (a.bounds[0] - b.bounds[1]).max(b.bounds[0] - a.bounds[1]);
    apart.max_element() <= near
}
