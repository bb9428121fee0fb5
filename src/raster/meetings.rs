//! Pairs of faces that may meet in a visible curve, proposed by the face buffer.
//!
//! Where surfaces pass through each other in sight, the one goes on just behind the other, or else
//! both show in pixels side by side and each lies in front of the other's plane. Both signs are
//! looked for at each pixel; in either case the planes must meet near it.

use rayon::prelude::*;

use super::FaceBuffer;
use super::face_buffer::{Cell, Fragment};
use super::screen::{Screen, ScreenPlane, is_small};
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
    let small = buffer.fragments().par_iter().flat_map_iter(|fragments| {
        let mut pairs = Pairs::new(mesh, &accept);
        for fragment in fragments {
            look_in_front_of_fragment(screen, buffer, fragment, &mut pairs);
        }
        pairs.found
    });
    let large = (0..count.div_ceil(TRIANGLES)).into_par_iter().flat_map_iter(|task| {
        let mut pairs = Pairs::new(mesh, &accept);
        for id in task * TRIANGLES..((task + 1) * TRIANGLES).min(count) {
            look_in_front_of_large(screen, buffer, id, &mut pairs);
        }
        pairs.found
    });
    let rows = buffer.rows;
    let beside = (0..rows.div_ceil(ROWS)).into_par_iter().flat_map_iter(|task| {
        let mut pairs = Pairs::new(mesh, &accept);
        for row in task * ROWS..((task + 1) * ROWS).min(rows) {
            look_beside(buffer, row, &mut pairs);
        }
        pairs.found
    });
    let mut found: Vec<[u32; 2]> = small.chain(large).chain(beside).collect();
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

/// Proposes a small triangle with the face that hides it at a pixel, if that is just before it.
#[inline]
fn look_in_front_of_fragment<F: Fn([u32; 2]) -> bool>(
    screen: &Screen,
    buffer: &FaceBuffer,
    fragment: &Fragment,
    pairs: &mut Pairs<F>,
) {
    let &Fragment { pixel, face, nearness } = fragment;
    let front = buffer.front(pixel as usize);
    if front.face() == face || is_fold(front, screen.is_facing(face)) {
        return;
    }
    let own = screen.plane(face).slope;
    if planes_meet(front.nearness() - nearness, own, buffer.slope(pixel as usize)) {
        pairs.propose(face, front.face());
    }
}

/// Proposes a large triangle with all faces that hide it just before it.
fn look_in_front_of_large<F: Fn([u32; 2]) -> bool>(
    screen: &Screen,
    buffer: &FaceBuffer,
    id: usize,
    pairs: &mut Pairs<F>,
) {
    let (corners, face) = screen.triangle(id);
    let Some(pixel_box) = screen.pixel_box(&corners).filter(|b| !is_small(*b)) else { return };
    let facing = screen.is_facing(face);
    let own = ScreenPlane::new(corners).slope;
    screen.cover(&corners, pixel_box, |pixel, nearness| {
        let front = buffer.front(pixel);
        if front.face() != face
            && !is_fold(front, facing)
            && planes_meet(front.nearness() - nearness, own, buffer.slope(pixel))
        {
            pairs.propose(face, front.face());
        }
    });
}

/// Whether an averted face lies behind a facing one: at folds of the surface such faces come near
/// each other, but where they pass through each other in sight, the facing one is also seen to
/// hide itself behind the averted one.
#[inline]
fn is_fold(front: Cell, facing: bool) -> bool {
    front.is_facing() && !facing
}

/// Whether two planes meet near a place where their nearness differs by `gap`.
#[inline]
fn planes_meet(gap: f32, a: [f32; 2], b: [f32; 2]) -> bool {
    let (x, y) = (a[0] - b[0], a[1] - b[1]);
    gap * gap <= REACH * REACH * (x * x + y * y)
}

/// Proposes the faces of neighbouring pixels, to the right and down, where each lies in front of
/// the plane of the other.
fn look_beside<F: Fn([u32; 2]) -> bool>(buffer: &FaceBuffer, row: usize, pairs: &mut Pairs<F>) {
    for column in 0..buffer.columns {
        let pixel = row * buffer.columns + column;
        let own = buffer.front(pixel);
        if !own.is_filled() {
            continue;
        }
        let mut look = |axis: usize, pixel_beside: usize| {
            let other = buffer.front(pixel_beside);
            if !other.is_filled() || other.face() == own.face() {
                return;
            }
            let rise = other.nearness() - own.nearness();
            if rise >= buffer.slope(pixel)[axis] && rise <= buffer.slope(pixel_beside)[axis] {
                pairs.propose(own.face(), other.face());
            }
        };
        if column + 1 < buffer.columns {
            look(0, pixel + 1);
        }
        if row + 1 < buffer.rows {
            look(1, pixel + buffer.columns);
        }
    }
}
