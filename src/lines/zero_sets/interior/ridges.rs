//! Ridges and valleys: where the larger principal curvature is extremal along its own direction.
//!
//! The extremality coefficients change sign between the ends of an edge, and the curvature grows towards the
//! crossing.
//!
//! Source: Ohtake, Belyaev and Seidel, "Ridge-valley lines on meshes via implicit surface fitting", SIGGRAPH
//! 2004, section 3. Deviation: derivatives follow Rusinkiewicz 2004 instead of a fitted surface.

use glam::DVec3;

use super::{CurvatureView, InsideOptions, positive};
use crate::lines::zero_sets::zero_set::{Crossing, EdgePoint, trace_crossings};
use crate::lines::{FeatureLines, LineKind};

/// Adds ridges, valleys or both.
pub(crate) fn find(
    seen: &CurvatureView,
    ridges: bool,
    valleys: bool,
    options: &InsideOptions,
    lines: &mut FeatureLines,
) {
    for sign in [1.0, -1.0] {
        // A ridge of the outside is a valley of the inside.
        let kind = |face: u32| {
            let ridge = sign * seen.side(face) > 0.0;
            match (ridge && ridges, !ridge && valleys) {
                (true, _) => Some(LineKind::Ridge),
                (_, true) => Some(LineKind::Valley),
                _ => None,
            }
        };
        let crossing = |a: u32, b: u32| crossing(seen, sign, a as usize, b as usize);
        let set = trace_crossings(
            seen.mesh,
            seen.smooth,
            |face| seen.shows(face) && kind(face).is_some(),
            crossing,
        );
        let measure = |point: &EdgePoint, side: f64| {
            let [a, b] = point.between.map(|v| sign * seen.curvature.principal[v as usize].k1);
            let threshold = if sign * side > 0.0 { options.ridge } else { options.valley };
            (a + (b - a) * point.t) * seen.size(point) / positive(threshold)
        };
        seen.add(&set, kind, measure, lines);
    }
}

/// Crossing on an edge whose ends are both convex (`sign` 1) or both concave (−1).
fn crossing(seen: &CurvatureView, sign: f64, a: usize, b: usize) -> Option<Crossing> {
    let principal = &seen.curvature.principal;
    if principal[a].k1 * sign <= 0.0 || principal[b].k1 * sign <= 0.0 {
        return None;
    }
    let derivative = &seen.curvature.derivative;
    // Gradient of the curvature along its own direction.
    let uphill = |v: usize| principal[v].dir1 * (sign * derivative[v][0]);
    let way = [a, b].map(|v| seen.mesh.positions[seen.smooth.vertices[v] as usize]);
    maximum([uphill(a), uphill(b)], way[1] - way[0])
}

/// Maximum of a curvature between the ends of an edge, from its gradients at the ends.
pub(crate) fn maximum(uphill: [DVec3; 2], edge: DVec3) -> Option<Crossing> {
    // The gradients do not point towards each other.
    if uphill[0].dot(uphill[1]) > 0.0 || (uphill[0] - uphill[1]).dot(edge) <= 0.0 {
        return None;
    }
    let speeds = uphill.map(DVec3::length);
    let sum = speeds[0] + speeds[1];
    (sum > 0.0).then(|| Crossing { t: speeds[0] / sum, rising: false })
}
