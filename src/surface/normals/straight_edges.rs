//! `straight`: edges along which the surface is straight, although the normals at their ends turn. Such
//! normals belong to a bevel or fillet that begins there.

use glam::DVec3;

use crate::mesh::EdgeSet;
use crate::mesh::{EdgeFaces, FaceId, Mesh};
use crate::surface::SmoothNormals;

/// Minimum ratio between the length of a straight edge and the lengths next to it and after its end.
const MIN_LENGTH_RATIO: f64 = 4.0;

/// Maximum turn of the normals along a level edge, times its length and divided by the width of the face. An arc
/// that turns as much rises by a tenth of the width.
const MAX_LEVEL_TURN_OF_WIDTH: f64 = 0.8;

/// Minimum cosine between the end normals of a gentle edge: 15 degrees.
pub(crate) const MIN_GENTLE_COSINE: f64 = 0.966;

/// Edges whose end normals differ little, away from separating edges.
pub(crate) fn gentle(mesh: &Mesh, smooth: &SmoothNormals) -> EdgeSet {
    let parted = smooth.parted_vertices(mesh);
    EdgeSet::collect(mesh.edges.len(), |edge| {
        let [a, b] = mesh.edges.vertices[edge].map(|vertex| vertex as usize);
        let is_parted = |vertex: usize| parted.get(vertex) == Some(&true);
        smooth.normals[a].dot(smooth.normals[b]) > MIN_GENTLE_COSINE && !is_parted(a) && !is_parted(b)
    })
}

/// Long edges next to short ones, where the surface continues only a short way after the end whose normal
/// tilts more.
///
/// The surface between the ends is straight there; the normals belong to the short part. Where the surface
/// continues for a similar length, it bends along all of it. Requires `smooth.gentle`.
pub(crate) fn straight(mesh: &Mesh, smooth: &SmoothNormals) -> EdgeSet {
    EdgeSet::collect(mesh.edges.len(), |edge| {
        if smooth.gentle.contains(edge) {
            return false;
        }
        let Some([a, b]) = smooth.across(mesh, edge) else { return false };
        let normals = [a, b].map(|v| smooth.normals[v as usize]);
        if normals[0].dot(normals[1]) > MIN_GENTLE_COSINE {
            return false;
        }
        let [from, to] = [a, b].map(|v| mesh.positions[smooth.vertices[v as usize] as usize]);
        let least = from.distance(to) / MIN_LENGTH_RATIO;
        if !mesh.edges.faces(edge).list().iter().any(|face| shortest_side(mesh, *face) < least) {
            return false;
        }
        let along = to - from;
        let leans_at_first = normals[0].dot(along).abs() > normals[1].dot(along).abs();
        let (end, onward) = if leans_at_first { (a, -along) } else { (b, along) };
        beyond(mesh, smooth, edge, (end, onward)).is_none_or(|way| way < least)
    })
}

/// Edges along which the normals hardly turn, in faces with a straight side, among the edges that satisfy
/// `is_asked`. Requires `smooth.straight`.
///
/// A face between such an edge and a straight one is a piece of a strip that bends across, and new edges in it
/// are as straight as its sides.
pub(crate) fn level(mesh: &Mesh, smooth: &SmoothNormals, is_asked: impl Fn(usize) -> bool + Sync) -> EdgeSet {
    EdgeSet::collect(mesh.edges.len(), |edge| {
        if smooth.straight.is_empty() || !is_asked(edge) {
            return false;
        }
        let Some(normals) = smooth.across(mesh, edge).map(|ends| ends.map(|v| smooth.normals[v as usize]))
        else {
            return false;
        };
        let [from, to] = mesh.ends(edge);
        let turn_by_length = from.distance_squared(to) * normals[0].distance(normals[1]);
        let ends = mesh.edges.vertices[edge];
        mesh.edges.faces(edge).each().any(|face| {
            let is_straight = |end: u32| {
                let side = mesh.apex(face, ends).and_then(|apex| mesh.edges.between(apex, end));
                side.is_some_and(|side| smooth.straight.contains(side))
            };
            ends.into_iter().any(is_straight)
                && turn_by_length < MAX_LEVEL_TURN_OF_WIDTH * 2.0 * mesh.area(FaceId(face))
        })
    })
}

fn shortest_side(mesh: &Mesh, face: u32) -> f64 {
    let [a, b, c] = mesh.triangles[face as usize].map(|v| mesh.positions[v as usize]);
    a.distance_squared(b).min(b.distance_squared(c)).min(c.distance_squared(a)).sqrt()
}

/// How far the surface continues from an end of an edge (a smooth vertex) in a direction, to the far side of
/// the next face. `None` where the surface ends.
fn beyond(mesh: &Mesh, smooth: &SmoothNormals, edge: usize, (end, direction): (u32, DVec3)) -> Option<f64> {
    let (vertex, normal) = (smooth.vertices[end as usize], smooth.normals[end as usize]);
    let onward = direction - normal * normal.dot(direction);
    let aside = normal.cross(onward);
    let way = |face: u32| {
        let corners = mesh.triangles[face as usize];
        let at = corners.iter().position(|v| *v == vertex)?;
        let [a, b] =
            [1, 2].map(|k| mesh.positions[corners[(at + k) % 3] as usize] - mesh.positions[vertex as usize]);
        let (right, left) = (a.dot(aside), b.dot(aside));
        // The face contains the direction.
        if right > 0.0 || left < 0.0 || left <= right {
            return None;
        }
        let met = a.lerp(b, right / (right - left));
        (met.dot(onward) > 0.0).then(|| met.length())
    };
    fan(mesh, smooth, vertex, edge).filter_map(way).min_by(f64::total_cmp)
}

/// The faces of a surface around one end of an edge, in both directions from the edge. Each occurs twice if
/// they close.
fn fan(mesh: &Mesh, smooth: &SmoothNormals, vertex: u32, edge: usize) -> impl Iterator<Item = u32> {
    let beside = match mesh.edges.faces(edge) {
        EdgeFaces::One(face) => [Some(face), None],
        EdgeFaces::Two { faces: [a, b], .. } => [Some(a), Some(b)],
        EdgeFaces::Many(_) => [None; 2],
    };
    beside.into_iter().flatten().flat_map(move |first| {
        let (mut next, mut crossed) = (Some(first), edge);
        std::iter::from_fn(move || {
            let face = next.take()?;
            let side = other_side(mesh, face, vertex, crossed)?;
            crossed = side;
            if let EdgeFaces::Two { faces, .. } = mesh.edges.faces(side)
                && side != edge
                && !smooth.separating_edges.contains(side)
            {
                next = Some(faces[usize::from(faces[0] == face)]);
            }
            Some(face)
        })
    })
}

/// The other side of a face at a vertex.
fn other_side(mesh: &Mesh, face: u32, vertex: u32, side: usize) -> Option<usize> {
    let ends = mesh.edges.vertices[side];
    mesh.edges.between(vertex, mesh.apex(face, ends)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::numbers::portable_math::{cos, sin};
    use crate::mesh::Soup;

    /// Prism along x with six vertices per ring and a tip at each end. Normals tilt outward at rings near the
    /// ends.
    fn hexagonal_prism(rings: &[f64], tips: [f64; 2]) -> Mesh {
        const AROUND: u32 = 6;
        let mut soup = Soup::default();
        let mut put = |position: DVec3, normal: DVec3| {
            soup.positions.push(position);
            soup.normals.push(normal.normalize().as_vec3().to_array());
        };
        tips.into_iter().for_each(|x| put(DVec3::X * x, DVec3::X * x));
        for x in rings {
            for k in 0..AROUND {
                let turn = std::f64::consts::TAU * f64::from(k) / f64::from(AROUND);
                let out = DVec3::new(0.0, cos(turn), sin(turn));
                put(out + DVec3::X * *x, out + DVec3::X * x.clamp(-1.0, 1.0));
            }
        }
        let at = |ring: usize, k: u32| 2 + ring as u32 * AROUND + k % AROUND;
        for k in 0..AROUND {
            let last = rings.len() - 1;
            soup.triangles.extend([[0, at(0, k + 1), at(0, k)], [1, at(last, k), at(last, k + 1)]]);
            for ring in 0..last {
                let [a, b] = [at(ring, k), at(ring, k + 1)];
                let [c, d] = [at(ring + 1, k), at(ring + 1, k + 1)];
                soup.triangles.extend([[a, b, c], [b, d, c]]);
            }
        }
        soup.corner_normals = soup.triangles.clone();
        Mesh::build(soup)
    }

    fn straight_edge_count(mesh: &Mesh) -> usize {
        let smooth = SmoothNormals::new(mesh, |_| true, |_| false);
        (0..mesh.edges.len()).filter(|edge| smooth.straight.contains(*edge)).count()
    }

    #[test]
    fn straight_edges_are_found_on_a_bar_and_not_on_a_spindle() {
        assert_eq!(
            straight_edge_count(&hexagonal_prism(&[-3.0, 3.0], [-3.0, 3.0])),
            12,
            "long edges and diagonals of a bar"
        );
        // As slim, but the surface after each tip is as long.
        assert_eq!(straight_edge_count(&hexagonal_prism(&[0.0], [-6.0, 6.0])), 0);
    }
}
