//! Smoothing of a field where it is near zero, by as much as the page can show.
//!
//! Scans are rough at the size of their triangles, and so are their contours. What is smaller than
//! a few px cannot be drawn, so the field is averaged over as much. To average n·v is to average
//! the normals: the one is linear in the other.

use crate::mesh::{Mesh, SmoothNormals};
use crate::view::Frame;

/// Radius (standard deviation) over which a field is averaged, px.
const RADIUS_PX: f64 = 2.5;
/// The square of the radius of one round of averaging over neighbours, in lengths of an edge.
const ROUND: f64 = 0.8;
/// No more rounds than this, however fine the mesh.
const MOST_ROUNDS: usize = 12;
/// Only where a corner of a face has less than this is the field averaged: about 20 degrees of turn.
const NEAR_ZERO: f64 = 0.35;

/// Averages `values`, one a smooth vertex, around where they vanish.
pub fn smooth_near_zero(mesh: &Mesh, smooth: &SmoothNormals, frame: &Frame, values: &mut [f64]) {
    let rounds = rounds(mesh, smooth, frame);
    if rounds == 0 {
        return;
    }
    let near = |corners: &[u32; 3]| corners.iter().any(|v| values[*v as usize].abs() < NEAR_ZERO);
    let faces: Vec<[u32; 3]> =
        (0..mesh.triangles.len() as u32).filter_map(|face| smooth.corners_of(face)).filter(near).collect();
    let mut ids: Vec<u32> = faces.iter().flatten().copied().collect();
    ids.sort_unstable();
    ids.dedup();
    let mut slots = vec![u32::MAX; values.len()];
    for (slot, id) in ids.iter().enumerate() {
        slots[*id as usize] = slot as u32;
    }
    let faces: Vec<[u32; 3]> = faces.into_iter().map(|f| f.map(|v| slots[v as usize])).collect();
    let mut now: Vec<f64> = ids.iter().map(|id| values[*id as usize]).collect();
    // Each vertex counts as much as one of its neighbours, who are met once from each side.
    let mut weights = vec![2.0; ids.len()];
    for v in faces.iter().flatten() {
        weights[*v as usize] += 2.0;
    }
    let mut sums = vec![0.0; ids.len()];
    for _ in 0..rounds {
        for (sum, value) in sums.iter_mut().zip(&now) {
            *sum = 2.0 * value;
        }
        for [a, b, c] in faces.iter().map(|f| f.map(|v| v as usize)) {
            let (at_a, at_b, at_c) = (now[a], now[b], now[c]);
            sums[a] += at_b + at_c;
            sums[b] += at_c + at_a;
            sums[c] += at_a + at_b;
        }
        for ((value, sum), weight) in now.iter_mut().zip(&sums).zip(&weights) {
            *value = sum / weight;
        }
    }
    for (id, value) in ids.iter().zip(now) {
        values[*id as usize] = value;
    }
}

/// How often to average: as many rounds as make up the radius, by the usual length of an edge.
fn rounds(mesh: &Mesh, smooth: &SmoothNormals, frame: &Frame) -> usize {
    let page = frame.scale / (frame.width.max(frame.height) / 1000.0);
    let page =
        if frame.perspective { page / frame.depth(glam::DVec3::ZERO).max(mesh.size * 1e-3) } else { page };
    // Some thousand faces tell how long edges are.
    let stride = (mesh.triangles.len() / 4096).max(1);
    let faces = (0..mesh.triangles.len()).step_by(stride).filter(|f| smooth.corners_of(*f as u32).is_some());
    let mut squares: Vec<f64> = faces
        .map(|f| {
            let [a, b, c] = mesh.corners(crate::mesh::FaceId(f as u32));
            (a.distance_squared(b) + b.distance_squared(c) + c.distance_squared(a)) / 3.0
        })
        .collect();
    if squares.is_empty() {
        return 0;
    }
    let middle = squares.len() / 2;
    let (_, median, _) = squares.select_nth_unstable_by(middle, f64::total_cmp);
    let edge = median.sqrt() * page;
    let rounds = RADIUS_PX * RADIUS_PX / (ROUND * edge * edge).max(f64::MIN_POSITIVE);
    rounds.round().min(MOST_ROUNDS as f64) as usize
}
