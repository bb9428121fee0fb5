//! Simplification of mask borders to the detail that a large drawing shows.

use super::mask_borders::trace_mask_borders;
use super::opacity_mask::OpacityMask;
use super::texels_of;
use crate::scene::Scene;
use crate::scene::textures::texel_plane::texel_borders::BorderIndex;

/// Width of the assumed drawing in px, and the tolerance of borders in it.
const DRAWING_SIZE_PX: f64 = 4096.0;
const DEFAULT_TOLERANCE_PX: f64 = 0.2;

/// Larger tolerances for many borders, as on trees with thousands of leaves, and for very many, as in a
/// street with such trees.
const MEDIUM_TOLERANCE_PX: f64 = 1.0;
const MAX_TOLERANCE_PX: f64 = 4.0;

/// Maximum number of border segments, instances counted, at the default tolerance and at the medium one.
const MAX_FINE_SEGMENTS: f64 = 3e5;
const MAX_MEDIUM_SEGMENTS: f64 = 1.5e6;

/// Maximum number of border segments that are cut out of a material, and that are tested against triangles.
const MAX_CUT_SEGMENTS: f64 = 3e7;
const MAX_TESTED_SEGMENTS: f64 = 1e9;

/// Minimum and maximum tolerance, texels.
const TOLERANCE_RANGE_TEXELS: [f64; 2] = [0.005, 2.0];

/// Borders of a material's mask, simplified to the detail that a large drawing of the whole scene shows;
/// `None` if there are too many to cut along.
pub(crate) fn border_index(scene: &Scene, material: usize, mask: &OpacityMask) -> Option<BorderIndex> {
    let (mut in_space, mut in_texels, mut in_boxes) = (0.0_f64, 0.0_f64, 0.0_f64);
    for part in &scene.parts {
        let Some(geometry) = scene.geometries.get(part.geometry) else { continue };
        for triangle in 0..geometry.triangles.len() {
            if geometry.material_of(triangle) != Some(material as u32) {
                continue;
            }
            let Some([a, b, c]) = texels_of(geometry, triangle, mask) else { continue };
            let Some(area) = part.area_of(geometry, triangle) else { continue };
            in_space += area;
            in_texels += (b - a).perp_dot(c - a).abs() / 2.0;
            in_boxes += (a.max(b).max(c) - a.min(b).min(c)).element_product();
        }
    }
    let size = scene.bounds().map_or(0.0, |(low, high)| (high - low).length());
    let texel: f64 = (in_space / in_texels).sqrt();
    let px_texels = size / DRAWING_SIZE_PX / texel;
    let [width, height] = mask.texels.size;
    let [least, most] = TOLERANCE_RANGE_TEXELS;
    let within =
        |px: f64, most: f64| if px_texels.is_finite() { (px * px_texels).clamp(least, most) } else { least };
    let mut tolerance = within(DEFAULT_TOLERANCE_PX, most);
    let slight = within(MEDIUM_TOLERANCE_PX, most);
    let coarsest = within(MAX_TOLERANCE_PX, most.max(width.min(height) as f64 / 16.0));
    let [times_shown, times_near] = [in_texels, in_boxes].map(|texels| texels / (width * height) as f64);
    let traced = trace_mask_borders(mask)?;
    loop {
        let outline = BorderIndex::new(&traced, tolerance);
        let (count, limit) = (outline.count() as f64, if tolerance < slight { slight } else { coarsest });
        let is_enough =
            count * times_shown <= if tolerance < slight { MAX_FINE_SEGMENTS } else { MAX_MEDIUM_SEGMENTS };
        if is_enough || tolerance >= coarsest {
            let can_be_cut =
                count * times_shown <= MAX_CUT_SEGMENTS && count * times_near <= MAX_TESTED_SEGMENTS;
            return can_be_cut.then_some(outline);
        }
        tolerance = (tolerance * 1.7).min(limit);
    }
}
