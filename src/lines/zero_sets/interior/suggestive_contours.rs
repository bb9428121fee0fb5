//! Suggestive contours: where a contour would appear from a nearby viewpoint.
//!
//! The radial curvature is the normal curvature towards the camera. Where it vanishes and grows towards the
//! camera, n·v has a minimum: the surface almost turns away. Where it vanishes and falls, n·v has a maximum:
//! a suggestive highlight.
//!
//! Sources:
//!
//! - DeCarlo, Finkelstein, Rusinkiewicz and Santella, "Suggestive contours for conveying shape", SIGGRAPH
//!   2003.
//! - DeCarlo, Finkelstein and Rusinkiewicz, "Interactive rendering of suggestive contours with temporal
//!   coherence", NPAR 2004, for the test D_w κ_r · tan θ, which vanishes where the camera looks straight at
//!   the surface.
//! - DeCarlo and Rusinkiewicz, "Highlight lines for conveying shape", NPAR 2007.

use super::{CurvatureView, InsideOptions, positive};
use crate::lines::zero_sets::zero_set::{EdgePoint, trace};
use crate::lines::{FeatureLines, LineKind};

/// Adds suggestive contours, and highlights if wanted.
pub(crate) fn find(seen: &CurvatureView, options: &InsideOptions, lines: &mut FeatureLines) {
    // κ_r sin² θ, with the zeros of κ_r.
    let radial = seen.field(|v| {
        let (p, eye) = (&seen.curvature.principal[v], seen.eye[v]);
        p.k1 * eye.x * eye.x + p.k2 * eye.y * eye.y
    });
    let set = trace(seen.mesh, seen.smooth, &radial, |face| seen.shows(face));
    let change = seen.field(|v| radial_derivative(seen, v));
    let size2 = |point: &EdgePoint| seen.size(point) * seen.size(point);
    let cosine = |point: &EdgePoint| {
        let [a, b] = point.between.map(|v| seen.eye[v as usize].z);
        a + (b - a) * point.t
    };
    // The test divided by its threshold. Seen from behind, the curvature has the opposite sign.
    let measure = |threshold: f64, sense: f64| {
        let change = &change;
        move |point: &EdgePoint, side: f64| {
            let towards = cosine(point) * side;
            if towards > 0.0 {
                sense * side * point.value(change) * size2(point) / (positive(threshold) * towards)
            } else {
                0.0
            }
        }
    };
    let kind = |_| Some(LineKind::Suggestive);
    seen.add(&set, kind, measure(options.suggestive, 1.0), lines);
    if options.highlights {
        seen.add(&set, kind, measure(options.highlight, -1.0), lines);
    }
}

/// D_w κ_r · sin θ at a smooth vertex: the derivative of the radial curvature towards the camera.
fn radial_derivative(seen: &CurvatureView, vertex: usize) -> f64 {
    let (p, eye) = (&seen.curvature.principal[vertex], seen.eye[vertex]);
    let [a, b, c, d] = seen.curvature.derivative[vertex];
    let (u, v) = (eye.x, eye.y);
    let sin2 = u * u + v * v;
    if sin2 <= 0.0 {
        return 0.0;
    }
    let along = u * u * (u * a + 3.0 * v * b) + v * v * (3.0 * u * c + v * d);
    // The second term comes from the rotation of w itself (DeCarlo 2004, appendix).
    let torsion = (p.k2 - p.k1) * u * v / sin2;
    along / sin2 - 2.0 * eye.z * torsion * torsion
}
