//! [`least_bending`]: minimises the bending energy of a mesh with quantized vertices, each confined to the
//! box of positions that its quantization allows.
//!
//! Source: Beck and Teboulle, "A fast iterative shrinkage-thresholding algorithm for linear inverse
//! problems" (FISTA), SIAM J. Imaging Sciences 2(1), 2009, equations 4.1 to 4.3. Each vertex moves against
//! the gradient and is projected back into its box. Deviation: each vertex has its own step size.

use crate::parallel::prelude::*;
use glam::Vec3;

use super::hinges::Hinge;
use crate::geometry::lists::csr_lists::csr_lists_from_pairs;
use crate::mesh::tolerances;
use crate::parallel::task_size::MIN_TASK_ITEMS;

/// Maximum number of descent steps. They remove at least 5/6 of the removable bending; further steps affect
/// few sharp edges.
pub(crate) const MAX_DESCENT_STEPS: usize = 16;

/// Displacement of each position after at most `steps` steps of descent, in half steps of the lattice: -1 to
/// 1 along each axis, zero for positions that are not `free`.
pub(crate) fn least_bending(hinges: &[Hinge], free: &[bool], steps: usize) -> Vec<Vec3> {
    // For each position, its hinges and its coefficient in each.
    let parts = hinges.iter().zip(0u32..).flat_map(|(hinge, k)| {
        hinge
            .corners
            .into_iter()
            .zip(hinge.corner_coefficients())
            .map(move |(v, share)| (v as usize, (k, share)))
    });
    let parts = csr_lists_from_pairs(free.len(), parts);
    let all = (0..free.len()).into_par_iter().with_min_len(MIN_TASK_ITEMS);
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
        let pulls: Vec<Vec3> = hinges.par_iter().with_min_len(MIN_TASK_ITEMS).map(pull).collect();
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
        ahead.par_iter_mut().with_min_len(MIN_TASK_ITEMS).zip(&next).zip(&found).for_each(
            |((ahead, next), found)| {
                *ahead = *next + (*next - *found) * on;
            },
        );
        found = next;
        if most <= tolerances::MIN_MOVE_HALF_STEPS {
            break;
        }
    }
    found
}
