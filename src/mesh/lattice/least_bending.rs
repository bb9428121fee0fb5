//! [`least_bending`]: where in the box around each vertex a surface bends least.
//!
//! Source: Beck and Teboulle, "A fast iterative shrinkage-thresholding algorithm for linear inverse problems", SIAM J. Imaging
//! Sciences 2(1), 2009, equations 4.1 to 4.3, with a step for each vertex: each goes against the slope of what it bends, and back into its box.

use crate::parallel::prelude::*;
use glam::Vec3;

use super::hinges::Hinge;
use crate::geometry::lists::csr_lists::grouped_pairs;
use crate::parallel::task_size::GRAIN;

/// By then five sixths and more of the bending that can go are gone, and later steps change what is sharp at few edges.
pub(crate) const STEPS: usize = 16;
/// A step in which nothing moves by more than this share of half a box is the last.
const STILL: f32 = 4e-3;

/// How far each place is moved in so many steps of descent, in half steps of the lattice: along each axis from -1 to 1, and not
/// at all those that are not `free`.
pub(crate) fn least_bending(hinges: &[Hinge], free: &[bool], steps: usize) -> Vec<Vec3> {
    // For each place the hinges it takes part in, and what it counts there.
    let parts = hinges.iter().zip(0u32..).flat_map(|(hinge, k)| {
        hinge.corners.into_iter().zip(hinge.shares()).map(move |(v, share)| (v as usize, (k, share)))
    });
    let parts = grouped_pairs(free.len(), parts);
    let all = (0..free.len()).into_par_iter().with_min_len(GRAIN);
    let pace = |v: usize| {
        let steepest = |(k, share): &(u32, f32)| hinges[*k as usize].steepest(*share);
        let steepest: f32 = if free[v] { parts.of(v).iter().map(steepest).sum() } else { 0.0 };
        if steepest > 0.0 { 1.0 / steepest } else { 0.0 }
    };
    let paces: Vec<f32> = all.clone().map(pace).collect();
    let mut found = vec![Vec3::ZERO; free.len()];
    let mut ahead = found.clone();
    let mut momentum = 1.0f32;
    for _ in 0..steps {
        let pull = |hinge: &Hinge| hinge.gap_at(&ahead) * hinge.weight;
        let pulls: Vec<Vec3> = hinges.par_iter().with_min_len(GRAIN).map(pull).collect();
        let next = |v: usize| {
            let slope =
                parts.of(v).iter().fold(Vec3::ZERO, |sum, (k, share)| sum + pulls[*k as usize] * *share);
            (ahead[v] - slope * paces[v]).clamp(Vec3::NEG_ONE, Vec3::ONE)
        };
        let next: Vec<Vec3> = all.clone().map(next).collect();
        let next_momentum = 0.5 * (1.0 + (1.0 + 4.0 * momentum * momentum).sqrt());
        let on = (momentum - 1.0) / next_momentum;
        momentum = next_momentum;
        let moved = |v: usize| (next[v] - found[v]).abs().max_element();
        let most = all.clone().map(moved).reduce(|| 0.0, f32::max);
        ahead.par_iter_mut().with_min_len(GRAIN).zip(&next).zip(&found).for_each(|((ahead, next), found)| {
            *ahead = *next + (*next - *found) * on;
        });
        found = next;
        if most <= STILL {
            break;
        }
    }
    found
}
