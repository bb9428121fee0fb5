//! Pairs of faces that may meet in a visible curve, proposed by the face buffer.
//!
//! Where surfaces pass through each other in sight, the one goes on just behind the other, or else
//! both show in pixels side by side and each lies in front of the other's plane. Both signs are
//! looked for at each pixel; in either case the planes must meet near it.

use rayon::prelude::*;

use super::FaceBuffer;
use super::screen::{Screen, ScreenPlane};
use crate::mesh::Mesh;

/// How far from a pixel's centre two planes may meet, pixels: farther ones meet nearer to others.
const REACH: f32 = 1.5;
/// Triangles handled by one task.
const TRIANGLES: usize = 1 << 13;
/// Rows handled by one task.
const ROWS: usize = 16;

/// The pairs of faces without common vertices that may meet in a visible curve and that `accept`
/// accepts; the lesser face first, sorted, each pair once.
pub fn find(
    mesh: &Mesh,
    screen: &Screen,
    buffer: &FaceBuffer,
    accept: impl Fn([u32; 2]) -> bool + Sync,
) -> Vec<[u32; 2]> {
    let count = screen.triangle_count();
    let behind = (0..count.div_ceil(TRIANGLES)).into_par_iter().flat_map_iter(|task| {
        let mut pairs = Pairs::new(mesh, &accept);
        for id in task * TRIANGLES..((task + 1) * TRIANGLES).min(count) {
            look_in_front(screen, buffer, id, &mut pairs);
        }
        pairs.found
    });
    let rows = screen.rows;
    let beside = (0..rows.div_ceil(ROWS)).into_par_iter().flat_map_iter(|task| {
        let mut pairs = Pairs::new(mesh, &accept);
        let (first, end) = (task * ROWS, ((task + 1) * ROWS).min(rows));
        let mut row = shown(screen, buffer, first);
        for y in first..end {
            for two in row.windows(2) {
                look_beside(&two[0], &two[1], &mut pairs);
            }
            if y + 1 < rows {
                let below = shown(screen, buffer, y + 1);
                for (upper, lower) in row.iter().zip(&below) {
                    look_beside(upper, lower, &mut pairs);
                }
                row = below;
            }
        }
        pairs.found
    });
    let mut found: Vec<[u32; 2]> = behind.chain(beside).collect();
    found.par_sort_unstable();
    found.dedup();
    found
}

/// The pairs that one task found.
struct Pairs<'a, F> {
    mesh: &'a Mesh,
    accept: &'a F,
    /// The pair asked about last: pixels side by side propose the same.
    last: [u32; 2],
    found: Vec<[u32; 2]>,
}

impl<'a, F: Fn([u32; 2]) -> bool> Pairs<'a, F> {
    fn new(mesh: &'a Mesh, accept: &'a F) -> Self {
        Self { mesh, accept, last: [u32::MAX; 2], found: Vec::new() }
    }

    fn are_neighbours(&self, a: u32, b: u32) -> bool {
        let corners = self.mesh.triangles[b as usize];
        self.mesh.triangles[a as usize].iter().any(|v| corners.contains(v))
    }

    fn propose(&mut self, a: u32, b: u32) {
        let pair = [a.min(b), a.max(b)];
        if pair == self.last {
            return;
        }
        self.last = pair;
        if !self.are_neighbours(a, b) && (self.accept)(pair) {
            self.found.push(pair);
        }
    }
}

/// Proposes a triangle with the faces that show where it is hidden just behind them.
fn look_in_front<F: Fn([u32; 2]) -> bool>(
    screen: &Screen,
    buffer: &FaceBuffer,
    id: usize,
    pairs: &mut Pairs<F>,
) {
    let (corners, face) = screen.triangle(id);
    let mut own = None;
    let mut front = (face, ScreenPlane::default());
    screen.cover(corners, |pixel, q| {
        let Some((shown, nearness)) = buffer.front(pixel) else { return };
        if shown == face {
            return;
        }
        if shown != front.0 {
            front = (shown, screen.plane(shown));
        }
        let own = *own.get_or_insert_with(|| ScreenPlane::new(corners));
        if planes_meet_within(REACH, nearness - q, own, front.1) {
            pairs.propose(face, shown);
        }
    });
}

/// Whether two planes meet within `reach` pixels of a place where their nearness differs by `gap`.
#[inline]
fn planes_meet_within(reach: f32, gap: f32, a: ScreenPlane, b: ScreenPlane) -> bool {
    let (x, y) = (a.slope[0] - b.slope[0], a.slope[1] - b.slope[1]);
    gap * gap <= reach * reach * (x * x + y * y)
}

/// The face in a pixel.
#[derive(Debug, Clone, Copy)]
struct Shown {
    face: Option<u32>,
    plane: ScreenPlane,
    place: [f32; 2],
    nearness: f32,
}

/// The faces in a row.
fn shown(screen: &Screen, buffer: &FaceBuffer, row: usize) -> Vec<Shown> {
    let mut last = (u32::MAX, ScreenPlane::default());
    let pixels = row * screen.columns..(row + 1) * screen.columns;
    let y = row as f32 + 0.5;
    pixels
        .enumerate()
        .map(|(column, pixel)| {
            let place = [column as f32 + 0.5, y];
            let Some((face, nearness)) = buffer.front(pixel) else {
                return Shown { face: None, plane: last.1, place, nearness: 0.0 };
            };
            if last.0 != face {
                last = (face, screen.plane(face));
            }
            Shown { face: Some(face), plane: last.1, place, nearness }
        })
        .collect()
}

/// Proposes the faces of two pixels where each lies in front of the plane of the other.
#[inline]
fn look_beside<F: Fn([u32; 2]) -> bool>(a: &Shown, b: &Shown, pairs: &mut Pairs<F>) {
    let (Some(face_a), Some(face_b)) = (a.face, b.face) else { return };
    if face_a == face_b {
        return;
    }
    let in_front = |a: &Shown, b: &Shown| a.nearness >= b.plane.at(a.place[0], a.place[1]);
    if in_front(a, b) && in_front(b, a) {
        pairs.propose(face_a, face_b);
    }
}
