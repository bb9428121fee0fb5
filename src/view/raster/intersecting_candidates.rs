//! Candidates for visible intersections, proposed by the face buffer.
//!
//! Along a visible intersection curve, two faces without a common vertex are neighbours in the image. Where
//! one of them shows as a strip thinner than a pixel, the face across its next edge does. So the candidates
//! are the faces of neighbouring pixels without a common vertex, and all faces that share an edge with one of
//! them.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::parallel::prelude::*;

use super::FaceBuffer;
use crate::mesh::{EdgeFaces, FaceId, Mesh};

/// Rows per task.
const ROWS_PER_TASK: usize = 16;
/// Largest number of candidates that is widened by the faces around them. This costs little and finds curves
/// next to strips of several faces thinner than a pixel.
const MAX_WIDENED_FACES: usize = 60_000;
/// Largest number of times the candidates are widened.
const MAX_RINGS: usize = 3;
/// Edges per task.
const EDGES_PER_TASK: usize = 1 << 15;

/// Whether each face of the mesh may meet another in a visible curve; false for faces without area.
#[must_use]
pub(crate) fn find(mesh: &Mesh, buffer: &FaceBuffer) -> Vec<bool> {
    let unmarked = || -> Vec<AtomicBool> { mesh.triangles.iter().map(|_| AtomicBool::new(false)).collect() };
    let is_marked = |marks: &[AtomicBool], face: u32| marks[face as usize].load(Ordering::Relaxed);
    let mark = |marks: &[AtomicBool], face: u32| marks[face as usize].store(true, Ordering::Relaxed);

    let contact_marks = unmarked();
    (0..buffer.rows.div_ceil(ROWS_PER_TASK)).into_par_iter().with_max_len(1).for_each(|task| {
        for row in task * ROWS_PER_TASK..((task + 1) * ROWS_PER_TASK).min(buffer.rows) {
            for_each_pair(mesh, buffer, row, |a, b| {
                mark(&contact_marks, a);
                mark(&contact_marks, b);
            });
        }
    });

    let near_marks = unmarked();
    let edges = mesh.edges.len();
    (0..edges.div_ceil(EDGES_PER_TASK)).into_par_iter().with_max_len(1).for_each(|task| {
        for edge in task * EDGES_PER_TASK..((task + 1) * EDGES_PER_TASK).min(edges) {
            let spread = |faces: &[u32]| {
                if faces.iter().any(|face| is_marked(&contact_marks, *face)) {
                    faces.iter().for_each(|face| mark(&near_marks, *face));
                }
            };
            match mesh.edges.faces(edge) {
                EdgeFaces::One(face) => spread(&[face]),
                EdgeFaces::Two { faces, .. } => spread(&faces),
                EdgeFaces::Many(faces) => spread(faces),
            }
        }
    });
    let mut active: Vec<bool> = near_marks.into_iter().map(AtomicBool::into_inner).collect();
    for _ in 0..MAX_RINGS {
        if active.iter().filter(|a| **a).count() > MAX_WIDENED_FACES {
            break;
        }
        add_ring(mesh, &mut active);
    }
    active.par_iter_mut().enumerate().for_each(|(f, active)| *active &= !mesh.is_degenerate(FaceId::from(f)));
    active
}

/// Adds all faces that share a vertex with a candidate.
fn add_ring(mesh: &Mesh, active: &mut [bool]) {
    let mut reached = vec![false; mesh.positions.len()];
    for (corners, _) in mesh.triangles.iter().zip(&*active).filter(|(_, active)| **active) {
        corners.iter().for_each(|v| reached[*v as usize] = true);
    }
    active.par_iter_mut().zip(&mesh.triangles).for_each(|(active, corners)| {
        *active |= corners.iter().any(|v| reached[*v as usize]);
    });
}

/// Calls `visit` for faces without a common vertex at neighbouring pixels, in a row and between it and the
/// next row.
fn for_each_pair(mesh: &Mesh, buffer: &FaceBuffer, row: usize, visit: impl Fn(u32, u32)) {
    for column in 0..buffer.columns {
        let pixel = row * buffer.columns + column;
        let Some(front_face) = buffer.front(pixel) else { continue };
        let compare_with = |pixel: usize| {
            if let Some(other_face) = buffer.front(pixel)
                && other_face != front_face
                && !are_neighbours(mesh, front_face, other_face)
            {
                visit(front_face, other_face);
            }
        };
        if column + 1 < buffer.columns {
            compare_with(pixel + 1);
        }
        if row + 1 < buffer.rows {
            compare_with(pixel + buffer.columns);
        }
    }
}

fn are_neighbours(mesh: &Mesh, a: u32, b: u32) -> bool {
    let corners = mesh.triangles[b as usize];
    mesh.triangles[a as usize].iter().any(|v| corners.contains(v))
}
