//! Smoothing of a field near its zero set, limited to details that the page cannot show.
//!
//! Scans are rough at the size of their triangles, and so are their contours. Details smaller than a few px
//! cannot be drawn, so the field is averaged over that radius. Averaging n·v equals averaging the normals,
//! because it is linear in them.

use crate::parallel::prelude::*;

use crate::light::tolerances;
use crate::mesh::{FaceId, Mesh, PartId};
use crate::parallel::task_size::MIN_TASK_ITEMS;
use crate::surface::SmoothNormals;
use crate::view::Frame;

/// Radius of the averaging (standard deviation), px.
const SMOOTHING_RADIUS_PX: f64 = 2.5;
/// Square of the radius of one round of averaging over neighbours, in squared edge lengths.
const VARIANCE_PER_ROUND: f64 = 0.8;
/// Largest number of rounds, however fine the mesh.
const MAX_ROUNDS: u32 = 12;
/// Faces are averaged only if a corner has a value below this: about 20 degrees of turn.
const MAX_SMOOTHED_VALUE: f64 = 0.35;

/// Averages `values`, one per smooth vertex, near their zero set.
pub(crate) fn smooth_near_zero(mesh: &Mesh, smooth: &SmoothNormals, frame: &Frame, values: &mut [f64]) {
    let rounds_of = rounds(mesh, smooth, frame);
    let most = rounds_of.iter().copied().max().unwrap_or(0);
    if most == 0 {
        return;
    }
    let near = |corners: &[u32; 3]| corners.iter().any(|v| values[*v as usize].abs() < MAX_SMOOTHED_VALUE);
    let rounds = |face: u32| rounds_of[mesh.body(face).index()];
    let mut faces: Vec<(u32, [u32; 3])> = (0..mesh.triangles.len() as u32)
        .into_par_iter()
        .with_min_len(MIN_TASK_ITEMS)
        .filter_map(|face| Some((rounds(face), smooth.corners_of(face).filter(near)?)))
        .filter(|(rounds, _)| *rounds > 0)
        .collect();
    // Parts that need few rounds drop out early. The order within a part is kept.
    let order = |(rounds, _): &(u32, _)| std::cmp::Reverse(*rounds);
    if !faces.is_sorted_by_key(order) {
        faces.sort_by_key(order);
    }
    let mut slots = vec![u32::MAX; values.len()];
    for v in faces.iter().flat_map(|(_, corners)| corners) {
        slots[*v as usize] = 0;
    }
    let ids: Vec<u32> = (0..values.len() as u32).filter(|id| slots[*id as usize] == 0).collect();
    for (slot, id) in ids.iter().enumerate() {
        slots[*id as usize] = slot as u32;
    }
    for (_, corners) in &mut faces {
        *corners = corners.map(|v| slots[v as usize]);
    }
    let mut rounds_at = vec![0; ids.len()];
    for (rounds, corners) in &faces {
        corners.iter().for_each(|v| rounds_at[*v as usize] = rounds_at[*v as usize].max(*rounds));
    }
    let mut now: Vec<f64> = ids.iter().map(|id| values[*id as usize]).collect();
    // A vertex has the weight of one of its neighbours, which are each visited from two faces.
    let mut weights = vec![2.0; ids.len()];
    for v in faces.iter().flat_map(|(_, corners)| corners) {
        weights[*v as usize] += 2.0;
    }
    let mut sums = vec![0.0; ids.len()];
    let mut active = faces.len();
    for round in 0..most {
        while let Some((_, corners)) = faces[..active].last().filter(|(rounds, _)| *rounds <= round) {
            corners.iter().for_each(|v| weights[*v as usize] -= 2.0);
            active -= 1;
        }
        for (sum, value) in sums.iter_mut().zip(&now) {
            *sum = 2.0 * value;
        }
        for [a, b, c] in faces[..active].iter().map(|(_, f)| f.map(|v| v as usize)) {
            let (at_a, at_b, at_c) = (now[a], now[b], now[c]);
            sums[a] += at_b + at_c;
            sums[b] += at_c + at_a;
            sums[c] += at_a + at_b;
        }
        for (((value, sum), weight), rounds) in now.iter_mut().zip(&sums).zip(&weights).zip(&rounds_at) {
            if *rounds > round {
                *value = sum / weight;
            }
        }
    }
    for (id, value) in ids.iter().zip(now) {
        values[*id as usize] = value;
    }
}

/// Number of averaging rounds for each body, by its first part: as required for the radius, given the median
/// edge length of the part and the depth of its centre.
fn rounds(mesh: &Mesh, smooth: &SmoothNormals, frame: &Frame) -> Vec<u32> {
    let mut count_of: Vec<usize> = Vec::new();
    let faces = 0..mesh.triangles.len() as u32;
    for part in faces.clone().map(|face| mesh.body(face)) {
        if count_of.len() <= part.index() {
            count_of.resize(part.index() + 1, 0);
        }
        count_of[part.index()] += 1;
    }
    // Some thousand faces of each part are enough to measure its edge length.
    let mut faces_of: Vec<Vec<u32>> = vec![Vec::new(); count_of.len()];
    let mut passed = vec![0usize; count_of.len()];
    for face in faces {
        let part = mesh.body(face).index();
        if passed[part] == 0 {
            faces_of[part].push(face);
            passed[part] = (count_of[part] / 4096).max(1);
        }
        passed[part] -= 1;
    }
    let of_part = |(part, faces): (usize, Vec<u32>)| {
        let faces = faces.into_iter().filter(|f| smooth.corners_of(*f).is_some());
        let mut squares: Vec<f64> = faces
            .map(|f| {
                let [a, b, c] = mesh.corners(FaceId(f));
                (a.distance_squared(b) + b.distance_squared(c) + c.distance_squared(a)) / 3.0
            })
            .collect();
        if squares.is_empty() {
            return 0;
        }
        let middle = squares.len() / 2;
        let (_, median, _) = squares.select_nth_unstable_by(middle, f64::total_cmp);
        let extent = mesh.extents.part(PartId::from(part));
        let depth = frame.depth(extent.middle()).max(extent.scale * tolerances::MIN_SMOOTHING_DEPTH_OF_PART);
        let edge = median.sqrt() / frame.px_at(depth);
        let rounds = SMOOTHING_RADIUS_PX * SMOOTHING_RADIUS_PX
            / (VARIANCE_PER_ROUND * edge * edge).max(f64::MIN_POSITIVE);
        rounds.round().min(f64::from(MAX_ROUNDS)) as u32
    };
    faces_of.into_iter().enumerate().map(of_part).collect()
}
