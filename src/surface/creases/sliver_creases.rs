//! `wrinkles`: creases that are caused only by slivers in an otherwise smooth surface.
//!
//! Where two surfaces were tessellated along one curve at different steps, slivers close the gaps between the
//! polygons. A sliver may tilt by any angle: it turns at one edge and back at the other, and the surface
//! across it does not turn.

use std::sync::atomic::AtomicU32;
use std::sync::atomic::Ordering::Relaxed;

use crate::geometry::lists::disjoint_sets::DisjointSets;
use crate::mesh::edges::triangle_sides::sides;
use crate::parallel::prelude::*;

use crate::geometry::numbers::portable_math::cos;
use crate::mesh::{DihedralCosines, EdgeFaces, FaceId, Mesh};
use crate::parallel::task_size::MIN_TASK_ITEMS;

/// Minimum aspect ratio (length to width) of a sliver.
const SLIVER_ASPECT: f64 = 6.0;
/// Minimum cosine (one degree) between two faces of one sliver.
const MIN_SLIVER_COSINE: f32 = 0.999_85;
/// Maximum number of faces in a sliver.
const MAX_SLIVER_FACES: usize = 8;
/// The edges of `creases` (ascending) that are caused only by slivers, ascending.
///
/// The surface around such a sliver turns by less than `crease_deg` degrees. Lines that connect to other
/// creases are kept.
pub(crate) fn wrinkles(
    mesh: &Mesh,
    turns: &DihedralCosines,
    crease_deg: f64,
    creases: &[usize],
) -> Vec<usize> {
    let least = cos(crease_deg.to_radians()) as f32;
    let beside = |edge: usize| match mesh.edges.faces(edge) {
        EdgeFaces::Two { faces, .. } => faces.map(|face| wrinkle(mesh, turns, least, face)),
        _ => [None; 2],
    };
    if creases.is_empty() {
        return Vec::new();
    }
    let lines = lines(mesh, creases);
    let all = (0..creases.len() as u32).into_par_iter().with_min_len(MIN_TASK_ITEMS);
    // The first edge of a line already rules out most lines.
    let may = |k: u32| lines.representative(k) == k && beside(creases[k as usize]) != [None; 2];
    let may: Vec<bool> = all.clone().map(may).collect();
    let mut by_line: Vec<(u32, u32)> =
        all.map(|k| (lines.representative(k), k)).filter(|(line, _)| may[*line as usize]).collect();
    by_line.par_sort_unstable();
    // All edges of a line must touch the same sliver, which has at most three edges per face.
    let is_wrinkle = |line: &&[(u32, u32)]| {
        let mut edges = line.iter().map(|(_, k)| creases[*k as usize]);
        let Some(first) = edges.next().filter(|_| line.len() <= 3 * MAX_SLIVER_FACES) else { return false };
        let mut shared = beside(first);
        for edge in edges {
            if shared == [None; 2] {
                break;
            }
            let at = beside(edge);
            shared = shared.map(|own| own.filter(|own| at.contains(&Some(*own))));
        }
        shared != [None; 2]
    };
    let mut found: Vec<usize> = by_line
        .par_chunk_by(|a, b| a.0 == b.0)
        .filter(is_wrinkle)
        .flat_map_iter(|line| line.iter().map(|(_, k)| creases[*k as usize]))
        .collect();
    found.par_sort_unstable();
    found
}

/// Groups creases that are connected at their ends.
fn lines(mesh: &Mesh, creases: &[usize]) -> DisjointSets {
    let ends = |k: u32| mesh.edges.vertices[creases[k as usize]].map(|vertex| vertex as usize);
    let all = (0..creases.len() as u32).into_par_iter().with_min_len(MIN_TASK_ITEMS);
    // Any crease at a vertex can represent it, because all of them are joined to it.
    let one_at: Vec<AtomicU32> = (0..mesh.positions.len()).map(|_| AtomicU32::new(0)).collect();
    all.clone().for_each(|k| ends(k).iter().for_each(|vertex| one_at[*vertex].store(k, Relaxed)));
    DisjointSets::new(creases.len(), |join| {
        all.for_each(|k| ends(k).iter().for_each(|vertex| join(k, one_at[*vertex].load(Relaxed))));
    })
}

/// The smallest face id of the sliver that contains `face`. `None` unless all faces around the sliver turn
/// into each other by less than the angle of cosine `least`.
fn wrinkle(mesh: &Mesh, turns: &DihedralCosines, least: f32, face: u32) -> Option<u32> {
    let mut own = vec![face];
    // Normals of the faces around, as seen from the front of the sliver.
    let mut around: Vec<[f32; 3]> = Vec::new();
    let mut area = 0.0;
    let mut at = 0;
    while at < own.len() {
        let face = own[at];
        at += 1;
        if mesh.is_degenerate(FaceId(face)) {
            return None;
        }
        area += mesh.area(FaceId(face));
        for [a, b] in sides(mesh.triangles[face as usize]) {
            let edge = mesh.edges.between(a, b)?;
            let EdgeFaces::Two { faces, same_way } = mesh.edges.faces(edge) else { return None };
            let other = faces[usize::from(faces[0] == face)];
            if own.contains(&other) {
                continue;
            }
            if turns.of_two(edge) > MIN_SLIVER_COSINE && !same_way {
                if own.len() == MAX_SLIVER_FACES {
                    return None;
                }
                own.push(other);
                continue;
            }
            if mesh.is_degenerate(FaceId(other)) {
                return None;
            }
            let normal = mesh.face_normals[other as usize];
            let normal = if same_way { normal.map(|x| -x) } else { normal };
            let dot = |m: &[f32; 3]| m[0] * normal[0] + m[1] * normal[1] + m[2] * normal[2];
            if around.iter().any(|m| dot(m) < least) {
                return None;
            }
            around.push(normal);
        }
    }
    let corners =
        || own.iter().flat_map(|face| mesh.triangles[*face as usize]).map(|v| mesh.positions[v as usize]);
    let longest = corners().flat_map(|p| corners().map(move |q| p.distance_squared(q))).fold(0.0, f64::max);
    (longest > SLIVER_ASPECT * 2.0 * area).then(|| own.iter().copied().min()).flatten()
}
