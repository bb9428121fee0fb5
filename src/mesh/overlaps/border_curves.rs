//! [`arcs`]: curved borders of flat surfaces, and the area between their chords and the curves that they
//! approximate.
//!
//! A pin flush with a plate and its hole have separate facetted borders. Where these differ, corners of the
//! pin lie over the plate. Such slivers are no larger than the areas that both sets of chords cut off.
//!
//! 1. A border edge has exactly one face of the surface.
//! 2. At a vertex with two border edges, a turn below [`MAX_FACET_DEG`] belongs to a curve.
//! 3. A chord of length c whose curve turns by t is at most c/2 · tan(t/4) away from the curve.

use glam::DVec3;
use rustc_hash::FxHashMap;

use crate::geometry::numbers::portable_math::{acos, tan};
use crate::mesh::edges::triangle_sides::sorted_sides;
use crate::mesh::tolerances::MAX_FACET_DEG;
use crate::mesh::{EdgeFaces, Mesh};

/// Edge of a curved border.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BorderArc {
    pub ends: [DVec3; 2],
    /// Area of the rectangle over the edge that contains the curve.
    pub area: f64,
}

/// Curved borders of a surface, given by its faces. `is_own` returns whether a face belongs to it.
pub(crate) fn arcs(mesh: &Mesh, faces: &[u32], is_own: impl Fn(u32) -> bool) -> Vec<BorderArc> {
    let mut border: Vec<[u32; 2]> = Vec::new();
    for face in faces {
        for ends @ [v, w] in sorted_sides(mesh.triangles[*face as usize]) {
            let Some(edge) = mesh.edges.between(v, w) else { continue };
            let own = match mesh.edges.faces(edge) {
                EdgeFaces::One(_) => 1,
                EdgeFaces::Two { faces, .. } => faces.iter().filter(|face| is_own(**face)).count(),
                EdgeFaces::Many(faces) => faces.iter().filter(|face| is_own(**face)).count(),
            };
            border.extend((own == 1).then_some(ends));
        }
    }
    let mut at_vertex: FxHashMap<u32, Vec<u32>> = FxHashMap::default();
    for [v, w] in &border {
        at_vertex.entry(*v).or_default().push(*w);
        at_vertex.entry(*w).or_default().push(*v);
    }
    let place = |v: u32| mesh.positions[v as usize];
    let turn = |v: u32| match at_vertex.get(&v).map(Vec::as_slice) {
        Some([p, q]) => {
            let (before, after) = (place(v) - place(*p), place(*q) - place(v));
            let cosine = before.normalize_or_zero().dot(after.normalize_or_zero());
            let turn = acos(cosine.clamp(-1.0, 1.0));
            if turn.to_degrees() < MAX_FACET_DEG { turn } else { 0.0 }
        }
        _ => 0.0,
    };
    let arc = |[v, w]: &[u32; 2]| {
        let (ends, turn) = ([place(*v), place(*w)], turn(*v).max(turn(*w)));
        let chord = ends[0].distance(ends[1]);
        (turn > 0.0).then(|| BorderArc { ends, area: chord * chord / 2.0 * tan(turn / 4.0) })
    };
    border.iter().filter_map(arc).collect()
}
