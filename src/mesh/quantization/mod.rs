//! Removal of quantization noise from compressed vertices.
//!
//! Compression such as Draco stores vertices as whole numbers of steps, so small faces tilt at random. Every
//! vertex is known to lie within half a step of its stored position on each axis. Of all surfaces within
//! these boxes, the one with the least bending is drawn.
//!
//! 1. Find the coarsest lattice that holds all vertices.
//! 2. Free the vertices whose faces are only a few steps wide. Wide faces and open borders stay fixed.
//! 3. Minimise the quadratic bending energy (Bergou et al. 2006) by accelerated projected descent (FISTA,
//!    Beck and Teboulle 2009).
//!
//! Files, in reading order: this file (steps 1 and 2), `hinges` (the energy), `least_bending` (the
//! descent).

mod hinges;
mod least_bending;

use crate::parallel::prelude::*;
use glam::DVec3;

use self::hinges::{FaceTilts, hinges};
use self::least_bending::{MAX_DESCENT_STEPS, least_bending};
use super::{EdgeFaces, Edges};
use crate::parallel::task_size::MIN_TASK_ITEMS;

/// Range of the number of bits of a lattice. Files have 8 to 16; below 7 the match may be random.
const LATTICE_BITS: std::ops::RangeInclusive<u32> = 7..=16;
/// Maximum distance of a vertex from its lattice point, as a share of a step. It covers decoding in single
/// precision.
const MAX_OFFSET_STEPS: f64 = 0.02;

/// Lattice over the box of some vertices, with 2ᵇ − 1 steps along its longest side, for a whole number b.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct QuantizationLattice {
    /// Lower corner of the box, a point of the lattice.
    low: DVec3,
    /// Length of a step, the same on all axes, in the unit of the vertices.
    step: f64,
}

impl QuantizationLattice {
    /// The coarsest lattice that contains all of these vertices; `None` if there is none.
    #[must_use]
    pub(crate) fn of(vertices: &[DVec3]) -> Option<Self> {
        let low = vertices.iter().fold(DVec3::INFINITY, |low, p| low.min(*p));
        let high = vertices.iter().fold(DVec3::NEG_INFINITY, |high, p| high.max(*p));
        let side = (high - low).max_element();
        if !(side > 0.0 && side.is_finite()) {
            return None;
        }
        let lattices = LATTICE_BITS.map(|bits| Self { low, step: side / f64::from((1 << bits) - 1) });
        lattices.into_iter().find(|lattice| vertices.iter().all(|p| lattice.has(*p)))
    }

    fn has(&self, p: DVec3) -> bool {
        let steps = (p - self.low) / self.step;
        (steps - steps.round()).abs().max_element() <= MAX_OFFSET_STEPS
    }

    /// Lattice point of a vertex as one number, 16 bits per axis.
    fn key(&self, p: DVec3) -> u64 {
        let steps = ((p - self.low) / self.step).round().to_array();
        steps.iter().fold(0, |key, steps| key << 16 | (*steps as u64 & 0xffff))
    }
}

/// Moves vertices on a lattice by at most half a step along each axis, so that the surface bends as little as
/// possible.
///
/// Vertices at the same position stay together. `normals` are those of the vertices, or empty. An edge whose
/// faces have different normals is a crease and may bend freely. Vertices on no lattice, and those of wide
/// faces, stay unchanged.
pub(crate) fn dequantize(vertices: &mut [DVec3], triangles: &[[u32; 3]], normals: &[[f32; 3]]) {
    let Some(lattice) = QuantizationLattice::of(vertices) else { return };
    if triangles.as_flattened().iter().any(|v| *v as usize >= vertices.len()) {
        return;
    }
    let (place_of, places) = distinct_positions(&lattice, vertices);
    let sound = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| place_of[v as usize]);
        a != b && b != c && c != a
    };
    let corners: Vec<[u32; 3]> = triangles.iter().filter(|t| sound(t)).copied().collect();
    let faces: Vec<[u32; 3]> = corners.iter().map(|t| t.map(|v| place_of[v as usize])).collect();
    let doubts = FaceTilts::of(&places, &faces, lattice.step / 2.0);
    let mut free = doubts.movable_positions(&faces, places.len());
    if !free.contains(&true) {
        return;
    }
    let edges = Edges::build(places.len(), &faces);
    for edge in 0..edges.len() {
        if !matches!(edges.faces(edge), EdgeFaces::Two { .. }) {
            edges.vertices[edge].iter().for_each(|place| free[*place as usize] = false);
        }
    }
    let hinges = hinges(&places, (&faces, &edges), &doubts, (&corners, normals), &free);
    let moved = least_bending(&hinges, &free, MAX_DESCENT_STEPS);
    vertices.par_iter_mut().with_min_len(MIN_TASK_ITEMS).zip(place_of).for_each(|(vertex, place)| {
        let place = place as usize;
        if free[place] {
            *vertex = places[place] + moved[place].as_dvec3() * (lattice.step / 2.0);
        }
    });
}

/// Position index of each vertex, and the positions in the order of their first vertices, which keeps
/// neighbours close in memory.
fn distinct_positions(lattice: &QuantizationLattice, vertices: &[DVec3]) -> (Vec<u32>, Vec<DVec3>) {
    let keys = vertices.par_iter().with_min_len(MIN_TASK_ITEMS).enumerate();
    let mut keys: Vec<(u64, u32)> = keys.map(|(v, p)| (lattice.key(*p), v as u32)).collect();
    keys.par_sort_unstable();
    // First the smallest vertex at the same position, then the index of the position.
    let mut place_of = vec![0; vertices.len()];
    for same in keys.chunk_by(|a, b| a.0 == b.0) {
        same.iter().for_each(|(_, v)| place_of[*v as usize] = same[0].1);
    }
    let mut places = Vec::new();
    for vertex in 0..vertices.len() {
        let first = place_of[vertex] as usize;
        place_of[vertex] = if first == vertex {
            places.push(vertices[vertex]);
            places.len() as u32 - 1
        } else {
            place_of[first]
        };
    }
    (place_of, places)
}

#[cfg(test)]
mod tests;
