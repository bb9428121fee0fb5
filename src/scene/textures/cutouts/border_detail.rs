//! Simplification of mask borders to the detail that a large drawing shows.

use super::mask_borders::trace;
use super::opacity_mask::Mask;
use super::texels_of;
use crate::scene::Scene;
use crate::scene::textures::texel_plane::texel_borders::Outline;

/// Width of the assumed drawing in px, and the tolerance of borders in it.
const ACROSS_PX: f64 = 4096.0;
const FINE_PX: f64 = 0.2;

/// Larger tolerances for many borders, as on trees with thousands of leaves, and for very many, as in a
/// street with such trees.
const SLIGHT_PX: f64 = 1.0;
const COARSE_PX: f64 = 4.0;

/// Maximum number of border segments, instances counted, at the default tolerance and at the medium one.
const MUCH: f64 = 3e5;
const VERY_MUCH: f64 = 1.5e6;

/// Maximum number of border segments that are cut out of a material, and that are tested against triangles.
const MOST_PIECES: f64 = 3e7;
const MOST_LOOKS: f64 = 1e9;

/// Minimum and maximum tolerance, texels.
const TOLERANCES: [f64; 2] = [0.005, 2.0];

/// Borders of a material's mask, simplified to the detail that a large drawing of the whole scene shows;
/// `None` if there are too many to cut along.
pub(crate) fn outline(scene: &Scene, material: usize, mask: &Mask) -> Option<Outline> {
    let (mut in_space, mut in_texels, mut in_boxes) = (0.0_f64, 0.0_f64, 0.0_f64);
    for part in &scene.parts {
        let Some(geometry) = scene.geometries.get(part.geometry) else { continue };
        for triangle in 0..geometry.triangles.len() {
            if geometry.material_of(triangle) != Some(material as u32) {
                continue;
            }
            let Some([a, b, c]) = texels_of(geometry, triangle, mask) else { continue };
            let corners = geometry.triangles[triangle].map(|corner| geometry.positions.get(corner as usize));
            let [Some(p), Some(q), Some(r)] = corners else { continue };
            let [p, q, r] = [p, q, r].map(|p| part.world_from_part.transform_point3(*p));
            in_space += (q - p).cross(r - p).length() / 2.0;
            in_texels += (b - a).perp_dot(c - a).abs() / 2.0;
            in_boxes += (a.max(b).max(c) - a.min(b).min(c)).element_product();
        }
    }
    let size = scene.bounds().map_or(0.0, |(low, high)| (high - low).length());
    let texel: f64 = (in_space / in_texels).sqrt();
    let px_texels = size / ACROSS_PX / texel;
    let [width, height] = mask.texels.size;
    let [least, most] = TOLERANCES;
    let within =
        |px: f64, most: f64| if px_texels.is_finite() { (px * px_texels).clamp(least, most) } else { least };
    let mut tolerance = within(FINE_PX, most);
    let slight = within(SLIGHT_PX, most);
    let coarsest = within(COARSE_PX, most.max(width.min(height) as f64 / 16.0));
    let [times_shown, times_near] = [in_texels, in_boxes].map(|texels| texels / (width * height) as f64);
    let traced = trace(mask)?;
    loop {
        let outline = Outline::new(&traced, tolerance);
        let (count, limit) = (outline.count() as f64, if tolerance < slight { slight } else { coarsest });
        let is_enough = count * times_shown <= if tolerance < slight { MUCH } else { VERY_MUCH };
        if is_enough || tolerance >= coarsest {
            let can_be_cut = count * times_shown <= MOST_PIECES && count * times_near <= MOST_LOOKS;
            return can_be_cut.then_some(outline);
        }
        tolerance = (tolerance * 1.7).min(limit);
    }
}
