//! Needles: faces without area, across which two real faces meet.
//!
//! A triangle whose corners lie on one line has no normal and hides nothing, but meshes use it to
//! stitch a long edge to two short ones. The faces on its far side are looked up *through* it: its
//! short edges see the face beyond its long edge, and its long edge draws nothing itself.

use super::{EdgeFaces, FaceId, Mesh};

/// What lies across an edge when a needle is looked through.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Beyond {
    /// A face with area.
    Face(u32),
    /// The edge is the needle's long one: its short edges speak for it.
    LongEdge,
    /// Nothing: the edge is a border.
    Nothing,
}

/// Looks from an edge (`lo` < `hi`) through `needle`.
#[must_use]
pub fn beyond(mesh: &Mesh, needle: u32, lo: u32, hi: u32) -> Beyond {
    let (mut needle, mut edge) = (needle, [lo, hi]);
    // Needles may lie side by side; a ring of them must not hold us up for ever.
    for step in 0..16 {
        let long = long_edge(mesh, needle);
        if long == edge {
            return if step == 0 { Beyond::LongEdge } else { Beyond::Nothing };
        }
        let Ok(id) = mesh.edges.vertices.binary_search(&long) else { return Beyond::Nothing };
        let EdgeFaces::Two { faces, .. } = mesh.edges.faces(id) else { return Beyond::Nothing };
        let next = if faces[0] == needle { faces[1] } else { faces[0] };
        if !mesh.is_degenerate(FaceId(next)) {
            return Beyond::Face(next);
        }
        (needle, edge) = (next, long);
    }
    Beyond::Nothing
}

/// The longest edge of a face, smaller vertex first.
fn long_edge(mesh: &Mesh, face: u32) -> [u32; 2] {
    let [a, b, c] = mesh.triangles[face as usize];
    let length = |[u, v]: [u32; 2]| mesh.positions[u as usize].distance_squared(mesh.positions[v as usize]);
    let mut longest = [a, b];
    for side in [[b, c], [c, a]] {
        if length(side) > length(longest) {
            longest = side;
        }
    }
    [longest[0].min(longest[1]), longest[0].max(longest[1])]
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::mesh::Soup;

    #[test]
    fn faces_across_a_needle_are_neighbours() {
        // One long side below, two short ones above; the needle 0 1 2 lies between.
        let points = [[0.0, 0.0], [2.0, 0.0], [1.0, 0.0], [1.0, -1.0], [1.0, 1.0]];
        let mesh = Mesh::build(Soup {
            positions: points.map(|[x, y]| DVec3::new(x, y, 0.0)).to_vec(),
            triangles: vec![[0, 3, 1], [0, 1, 2], [0, 2, 4], [2, 1, 4]],
            ..Soup::default()
        });
        let id = |k: usize| {
            let place = DVec3::new(points[k][0], points[k][1], 0.0) - mesh.origin;
            mesh.positions.iter().position(|p| *p == place).unwrap() as u32
        };
        let needle = (0..4).find(|f| mesh.is_degenerate(FaceId(*f))).unwrap();
        let below = (0..4).find(|f| mesh.triangles[*f as usize].contains(&id(3))).unwrap();
        let look = |a: usize, b: usize| beyond(&mesh, needle, id(a).min(id(b)), id(a).max(id(b)));
        assert_eq!(look(0, 2), Beyond::Face(below));
        assert_eq!(look(1, 2), Beyond::Face(below));
        assert_eq!(look(0, 1), Beyond::LongEdge);
    }

    #[test]
    fn a_needle_at_a_border_has_nothing_beyond() {
        let points = [[0.0, 0.0], [2.0, 0.0], [1.0, 0.0], [1.0, 1.0]];
        let mesh = Mesh::build(Soup {
            positions: points.map(|[x, y]| DVec3::new(x, y, 0.0)).to_vec(),
            triangles: vec![[0, 1, 2], [0, 2, 3], [2, 1, 3]],
            ..Soup::default()
        });
        let needle = (0..3).find(|f| mesh.is_degenerate(FaceId(*f))).unwrap();
        let at = |x: f64| mesh.positions.iter().position(|p| p.x == x && p.y == 0.0).unwrap() as u32;
        assert_eq!(beyond(&mesh, needle, at(0.0), at(1.0)), Beyond::Nothing);
    }
}
