//! `feature_size`: length that makes curvature thresholds dimensionless.
//!
//! The feature size is a hundredth of a radius of curvature, limited to a small share of the part. 90 % of
//! the surface has a radius of at most this value. Surface elements are weighted by area, so that the
//! tessellation has no effect. Each part has its own feature size, so that its lines do not depend on other
//! parts.
//!
//! Source: the measure of the same name in Rusinkiewicz's rtsc.

use crate::parallel::prelude::*;

use super::principal_curvatures::PrincipalCurvatures;
use super::vertex_fans::VertexFans;
use crate::mesh::{Mesh, PartId};
use crate::parallel::task_size::MIN_TASK_ITEMS;

/// Share of the surface, by area, that may be flatter than the measured curvature.
const FLAT_AREA_QUANTILE: f64 = 0.1;

/// Feature size, as a share of the radius of that curvature.
const FEATURE_OF_RADIUS: f64 = 0.01;

/// Maximum feature size, as a share of the part.
pub(crate) const MAX_FEATURE_OF_PART: f64 = 0.025;

/// Feature size of each part, world units. It scales with the part. Curvature thresholds are multiples of its
/// inverse; thresholds on derivatives are multiples of its inverse square. `part_of` has one part per smooth
/// vertex.
pub(crate) fn feature_sizes(
    mesh: &Mesh,
    fans: &VertexFans,
    principal: &[PrincipalCurvatures],
    part_of: &[PartId],
) -> Vec<f64> {
    let mut bends: Vec<(PartId, f64, f64)> = principal
        .par_iter()
        .with_min_len(MIN_TASK_ITEMS)
        .enumerate()
        .flat_map_iter(|(vertex, p)| {
            let (part, area) = (part_of[vertex], fans.area(vertex));
            [(part, p.k1.abs(), area), (part, p.k2.abs(), area)]
        })
        .collect();
    // Areas are summed in the order of curvatures, so that the order of vertices has no effect.
    bends.par_sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.total_cmp(&b.2)));
    let mut sizes = vec![0.0; bends.last().map_or(0, |last| last.0.index() + 1)];
    for of_part in bends.chunk_by(|a, b| a.0 == b.0) {
        let part = of_part[0].0;
        sizes[part.index()] = feature_size(of_part, MAX_FEATURE_OF_PART * mesh.extents.part(part).scale);
    }
    sizes
}

/// Feature size of a part from its curvatures, ascending, with their areas.
fn feature_size(bends: &[(PartId, f64, f64)], most: f64) -> f64 {
    let total: f64 = bends.iter().map(|bend| bend.2).sum();
    let mut sum = 0.0;
    let flat = bends.iter().find(|bend| {
        sum += bend.2;
        bend.2 > 0.0 && sum >= FLAT_AREA_QUANTILE * total
    });
    flat.map_or(most, |(_, bend, _)| if *bend > 0.0 { (FEATURE_OF_RADIUS / bend).min(most) } else { most })
}
