//! `feature_size`: the length by which thresholds of curvature are measured.
//!
//! Source: the measure of the same name in Rusinkiewicz's rtsc: a hundredth of the radius of
//! curvature that nine tenths of the surface do not exceed, but no more than a small part of the
//! model. Here parts of the surface count by their area, so that how finely they are cut does not
//! matter.

use rayon::prelude::*;

use super::Mesh;
use super::curvature::Principal;
use super::fans::{Fans, GRAIN};

/// The part of the surface that may be flatter than the measured curvature.
const FLATTER: f64 = 0.1;

/// The feature size in radii of that curvature.
const OF_RADIUS: f64 = 0.01;

/// The largest feature size, as a fraction of the model.
pub const MOST_OF_MODEL: f64 = 0.025;

/// The size of the features of a surface, world units: thresholds of curvature are multiples of its
/// inverse, those of derivatives of its inverse square. Scales with the model.
pub(super) fn feature_size(mesh: &Mesh, fans: &Fans, principal: &[Principal]) -> f64 {
    let most = MOST_OF_MODEL * mesh.size;
    let mut bends: Vec<(f64, f64)> = principal
        .par_iter()
        .with_min_len(GRAIN)
        .enumerate()
        .flat_map_iter(|(vertex, p)| {
            let area = fans.area(vertex);
            [(p.k1.abs(), area), (p.k2.abs(), area)]
        })
        .collect();
    // Areas are summed in the order of the curvatures, whatever the order of vertices.
    bends.par_sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let total: f64 = bends.iter().map(|bend| bend.1).sum();
    let mut sum = 0.0;
    let flat = bends.iter().find(|bend| {
        sum += bend.1;
        bend.1 > 0.0 && sum >= FLATTER * total
    });
    flat.map_or(most, |(bend, _)| if *bend > 0.0 { (OF_RADIUS / bend).min(most) } else { most })
}
