//! Apparent ridges: where the curvature of the surface, as seen from the camera, is largest.
//!
//! The view-dependent curvature is the largest singular value of Q = S P⁻¹, the change of the normal per
//! distance in the image. An apparent ridge is where it is largest along its direction t₁. The derivative
//! along t₁ is a difference over the two faces in that direction.
//!
//! Source: Judd, Durand and Adelson, "Apparent ridges for line drawing", SIGGRAPH 2007.

use crate::parallel::prelude::*;
use glam::{DVec2, DVec3};

use super::ridges::maximum;
use super::{CurvatureView, InsideOptions, positive};
use crate::lines::tolerances;
use crate::lines::zero_sets::zero_set::{EdgePoint, trace_crossings};
use crate::lines::{FeatureLines, LineKind};
use crate::parallel::task_size::MIN_TASK_ITEMS;

/// View-dependent curvature at a smooth vertex.
#[derive(Debug, Clone, Copy, Default)]
struct ApparentCurvature {
    /// Square of the largest singular value of Q.
    q1: f64,
    /// Unit direction of that curvature on the surface.
    t1: DVec3,
}

/// Adds the apparent ridges.
pub(crate) fn find(seen: &CurvatureView, options: &InsideOptions, lines: &mut FeatureLines) {
    let count = seen.eye.len();
    let apparent: Vec<ApparentCurvature> = (0..count)
        .into_par_iter()
        .with_min_len(MIN_TASK_ITEMS)
        .map(|v| apparent_curvature(seen, v))
        .collect();
    let uphill: Vec<DVec3> =
        (0..count).into_par_iter().with_min_len(MIN_TASK_ITEMS).map(|v| uphill(seen, &apparent, v)).collect();
    let position = |v: u32| seen.mesh.positions[seen.smooth.vertices[v as usize] as usize];
    let set = trace_crossings(
        seen.mesh,
        seen.smooth,
        |face| seen.shows(face),
        |a, b| maximum([uphill[a as usize], uphill[b as usize]], position(b) - position(a)),
    );
    let measure = |point: &EdgePoint, _| {
        let [a, b] = point.between.map(|v| apparent[v as usize].q1);
        (a + (b - a) * point.t) * seen.size(point) * seen.size(point) / positive(options.apparent_ridge)
    };
    seen.add(&set, |_| Some(LineKind::Ridge), measure, lines);
}

fn apparent_curvature(seen: &CurvatureView, vertex: usize) -> ApparentCurvature {
    let (p, eye) = (&seen.curvature.principal[vertex], seen.eye[vertex]);
    let sin2 = eye.x * eye.x + eye.y * eye.y;
    let (uu, uv, vv) = if sin2 > 0.0 {
        (eye.x * eye.x / sin2, eye.x * eye.y / sin2, eye.y * eye.y / sin2)
    } else {
        (0.0, 0.0, 0.0)
    };
    // Q = S + (sec θ − 1) S w wᵀ, in the principal directions.
    let stretch = 1.0 / eye.z.abs().max(tolerances::MIN_FACING_COSINE) - 1.0;
    let q = [
        DVec2::new(p.k1 * (1.0 + stretch * uu), p.k2 * stretch * uv),
        DVec2::new(p.k1 * stretch * uv, p.k2 * (1.0 + stretch * vv)),
    ];
    // QᵀQ from the columns of Q.
    let (a, b, c) = (q[0].length_squared(), q[0].dot(q[1]), q[1].length_squared());
    let spread = (b * b + 0.25 * (a - c) * (a - c)).sqrt();
    let half = 0.5 * (a - c);
    let t = if half >= 0.0 { DVec2::new(half + spread, b) } else { DVec2::new(b, spread - half) };
    let t = t.try_normalize().unwrap_or(DVec2::X);
    ApparentCurvature { q1: 0.5 * (a + c) + spread, t1: p.dir1 * t.x + p.dir2 * t.y }
}

/// Gradient of the view-dependent curvature along its own direction.
fn uphill(seen: &CurvatureView, apparent: &[ApparentCurvature], vertex: usize) -> DVec3 {
    let position = |v: u32| seen.mesh.positions[seen.smooth.vertices[v as usize] as usize];
    let own = &apparent[vertex];
    let (at, across) = (position(vertex as u32), seen.curvature.normals[vertex].cross(own.t1));
    let (mut sum, mut count) = (0.0, 0u32);
    for (face, corner) in seen.curvature.fans.around(vertex) {
        let corners = seen.smooth.corners[face];
        let (next, last) = (corners[(corner + 1) % 3], corners[(corner + 2) % 3]);
        // Point where the line through the vertex leaves the face.
        let (beside_next, beside_last) =
            ((position(next) - at).dot(across), (position(last) - at).dot(across));
        if (beside_next >= 0.0) == (beside_last >= 0.0) {
            continue;
        }
        let t = beside_next / (beside_next - beside_last);
        let there = position(next).lerp(position(last), t);
        let bend = apparent[next as usize].q1 + (apparent[last as usize].q1 - apparent[next as usize].q1) * t;
        let distance = (there - at).dot(own.t1) * seen.eye[vertex].z.abs();
        if distance != 0.0 {
            sum += (bend - own.q1) / distance;
            count += 1;
        }
    }
    if count == 0 { DVec3::ZERO } else { own.t1 * (sum / f64::from(count)) }
}
