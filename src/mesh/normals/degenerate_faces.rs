//! Needles: faces without area between two real faces.
//!
//! A triangle with collinear corners has no normal and hides nothing, but meshes use it to connect a long
//! edge to two short ones. Lookups go *through* it: across a short edge they find the face behind the long
//! edge, and the long edge itself draws nothing. Needles may be adjacent. Over any point of their line, at
//! least one edge is not the long edge of a needle, and this edge represents the line there.

use glam::DVec3;

use crate::mesh::{EdgeFaces, FaceId, Mesh};

/// Result of a lookup across an edge, through needles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum OppositeFace {
    /// A face with area.
    Face(u32),
    /// The edge is the long one of a needle, or collinear with others: shorter edges represent it.
    LongEdge,
    /// No face: the edge is a border.
    Nothing,
}

/// The face at an edge (`lo` < `hi`) on the side of `face`, looking through needles.
#[must_use]
pub(crate) fn opposite_face(mesh: &Mesh, face: u32, [lo, hi]: [u32; 2]) -> OppositeFace {
    if mesh.is_degenerate(FaceId(face)) {
        across_needle(mesh, face, lo, hi)
    } else {
        OppositeFace::Face(face)
    }
}

/// The face across `needle` from an edge (`lo` < `hi`).
#[must_use]
fn across_needle(mesh: &Mesh, needle: u32, lo: u32, hi: u32) -> OppositeFace {
    let (mut needle, mut edge) = (needle, [lo, hi]);
    let mut long = long_edge(mesh, needle);
    if long == edge {
        return OppositeFace::LongEdge;
    }
    let middle = (mesh.positions[lo as usize] + mesh.positions[hi as usize]) / 2.0;
    let mut rises = true;
    // Needles may be adjacent. The limit stops at a ring of them.
    for _ in 0..16 {
        let side = if long == edge { short_edge(mesh, needle, edge, middle) } else { long };
        let Ok(id) = mesh.edges.vertices.binary_search(&side) else { return OppositeFace::Nothing };
        let EdgeFaces::Two { faces, .. } = mesh.edges.faces(id) else { return OppositeFace::Nothing };
        let next = if faces[0] == needle { faces[1] } else { faces[0] };
        if !mesh.is_degenerate(FaceId(next)) {
            return OppositeFace::Face(next);
        }
        long = long_edge(mesh, next);
        if rises && long == side {
            // Short edges are on both sides of this one; those on one side represent it.
            rises = false;
            if third_corner(mesh, needle, side) > third_corner(mesh, next, side) {
                return OppositeFace::LongEdge;
            }
        }
        (needle, edge) = (next, side);
    }
    OppositeFace::Nothing
}

/// The short edge of a needle next to a point of its long edge.
fn short_edge(mesh: &Mesh, needle: u32, long: [u32; 2], point: DVec3) -> [u32; 2] {
    let at = |v: u32| mesh.positions[v as usize];
    let third = third_corner(mesh, needle, long);
    let is_before = (point - at(third)).dot(at(long[0]) - at(third)) > 0.0;
    let end = long[usize::from(!is_before)];
    [end.min(third), end.max(third)]
}

/// The corner of a face that is not on an edge.
fn third_corner(mesh: &Mesh, face: u32, edge: [u32; 2]) -> u32 {
    mesh.apex(face, edge).unwrap_or(edge[0])
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
    use super::*;
    use crate::mesh::{Dihedral, Soup};

    #[test]
    fn across_needle_finds_the_face_behind_a_degenerate_face() {
        // One long side below, two short ones above, and the needle 0 1 2 between them.
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
        let look = |a: usize, b: usize| across_needle(&mesh, needle, id(a).min(id(b)), id(a).max(id(b)));
        assert_eq!(look(0, 2), OppositeFace::Face(below));
        assert_eq!(look(1, 2), OppositeFace::Face(below));
        assert_eq!(look(0, 1), OppositeFace::LongEdge);
    }

    #[test]
    fn across_needle_finds_nothing_at_a_border() {
        let points = [[0.0, 0.0], [2.0, 0.0], [1.0, 0.0], [1.0, 1.0]];
        let mesh = Mesh::build(Soup {
            positions: points.map(|[x, y]| DVec3::new(x, y, 0.0)).to_vec(),
            triangles: vec![[0, 1, 2], [0, 2, 3], [2, 1, 3]],
            ..Soup::default()
        });
        let needle = (0..3).find(|f| mesh.is_degenerate(FaceId(*f))).unwrap();
        let at = |x: f64| mesh.positions.iter().position(|p| p.x == x && p.y == 0.0).unwrap() as u32;
        assert_eq!(across_needle(&mesh, needle, at(0.0), at(1.0)), OppositeFace::Nothing);
    }

    /// Two walls that meet in one line, as in a roof, with needles between them. Each wall has separate
    /// vertices on the line, at the given positions: the ends of its faces.
    fn roof(places: &[f64], left: &[[u32; 2]], right: &[[u32; 2]], needles: &[[u32; 3]]) -> Mesh {
        let mut positions: Vec<DVec3> = places.iter().map(|x| DVec3::X * *x).collect();
        let far = positions.len() as u32;
        positions.extend([DVec3::new(1.0, 5.0, -5.0), DVec3::new(1.0, -5.0, -5.0)]);
        let mut triangles = needles.to_vec();
        triangles.extend(left.iter().map(|[a, b]| [*b, *a, far]));
        triangles.extend(right.iter().map(|[a, b]| [*a, *b, far + 1]));
        Mesh::build(Soup { positions, triangles, ..Soup::default() })
    }

    /// Intervals on the line of a roof where two walls meet, in order.
    fn meeting_intervals(mesh: &Mesh) -> Vec<[f64; 2]> {
        let on_line =
            |edge: &usize| mesh.edges.vertices[*edge].iter().all(|v| world_position(mesh, *v).z == 0.0);
        let turns = |edge: &usize| Dihedral::at(mesh, *edge).is_some_and(|d| (d.turn() - 90.0).abs() < 1e-3);
        let edges = (0..mesh.edges.len()).filter(on_line).filter(turns);
        let mut found: Vec<[f64; 2]> = edges
            .map(|edge| mesh.edges.vertices[edge].map(|v| world_position(mesh, v).x))
            .map(|[a, b]| [a.min(b), a.max(b)])
            .collect();
        found.sort_by(|a, b| a[0].total_cmp(&b[0]));
        found
    }

    fn world_position(mesh: &Mesh, vertex: u32) -> DVec3 {
        mesh.positions[vertex as usize] + mesh.origin
    }

    #[test]
    fn walls_meet_across_needles_with_long_edges_on_one_wall_each() {
        let mesh = roof(&[0.0, 1.0, 2.0, 3.0], &[[0, 2], [2, 3]], &[[0, 1], [1, 3]], &[[0, 2, 1], [1, 2, 3]]);
        assert_eq!(meeting_intervals(&mesh), [[0.0, 1.0], [1.0, 2.0], [2.0, 3.0]]);
    }

    #[test]
    fn walls_meet_across_needles_that_share_their_long_edge() {
        let mesh = roof(&[0.0, 1.0, 1.8, 3.0], &[[0, 2], [2, 3]], &[[0, 1], [1, 3]], &[[0, 3, 1], [0, 2, 3]]);
        // Divided like one of the walls, and covered once.
        let found = meeting_intervals(&mesh);
        assert!(found == [[0.0, 1.0], [1.0, 3.0]] || found == [[0.0, 1.8], [1.8, 3.0]], "{found:?}");
    }

    #[test]
    fn walls_meet_across_needles_with_nearly_coincident_corners() {
        let (at, beside) = (2.0, 2.0 + 1e-15);
        let mesh = roof(
            &[0.0, 1.0, at, beside, 3.0],
            &[[0, 2], [2, 3], [3, 4]],
            &[[0, 1], [1, 4]],
            &[[0, 2, 1], [1, 2, 3], [1, 3, 4]],
        );
        let found = meeting_intervals(&mesh);
        let covered = |x: f64| found.iter().any(|[a, b]| (*a..=*b).contains(&x));
        assert!([0.5, 1.5, 2.5].into_iter().all(covered), "{found:?}");
    }
}
