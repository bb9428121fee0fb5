//! [`trace_mask_borders`]: traces the borders between opaque and transparent texels of a mask, in the texel
//! plane.

use super::opacity_mask::OpacityMask;
use crate::geometry::plane::marching_squares::marching_squares;
use crate::scene::textures::texel_plane::TracedBorders;
use crate::scene::tolerances::MAX_CURVE_ERROR_OF_SEGMENT;

/// Maximum number of opaque to transparent transitions between texels.
const MAX_CROSSINGS: usize = 1 << 22;

/// Traces the borders of a mask, with opaque on their left (x to the right, y upwards); `None` if there are
/// too many.
pub(crate) fn trace_mask_borders(mask: &OpacityMask) -> Option<TracedBorders> {
    let (reach, periods) = (mask.texels.reach(), mask.texels.periods());
    let lines = marching_squares(&|i, j| mask.texel(i, j), reach, MAX_CURVE_ERROR_OF_SEGMENT, MAX_CROSSINGS)?;
    Some(TracedBorders { lines, parted: Vec::new(), reach, periods })
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;
    use crate::scene::material::Wrap;
    use crate::scene::textures::texel_plane::texel_borders::BorderIndex;

    fn border_index(mask: &OpacityMask, tolerance: f64) -> BorderIndex {
        BorderIndex::new(&trace_mask_borders(mask).unwrap(), tolerance)
    }

    fn round_hole_opacity(size: usize, radius: f64) -> Vec<u8> {
        let middle = (size as f64 - 1.0) / 2.0;
        let at = |k: usize| DVec2::new((k % size) as f64 - middle, (k / size) as f64 - middle).length();
        (0..size * size).map(|k| (127.5 + 255.0 * (at(k) - radius)).clamp(0.0, 255.0) as u8).collect()
    }

    #[test]
    fn mask_borders_of_a_round_hole_are_a_circle() {
        let mask = OpacityMask::of_opacities(64, round_hole_opacity(64, 20.3), Wrap::Repeat);
        let outline = border_index(&mask, 0.02);
        let middle = DVec2::splat(31.5);
        assert!(outline.segments.len() > 40 && outline.segments.len() < 240, "{}", outline.segments.len());
        for [a, b] in &outline.segments {
            let off = (a.distance(middle) - 20.3).abs().max(((*a + *b) / 2.0).distance(middle) - 20.3);
            assert!(off < 0.1, "{off}");
            // Opaque is outside.
            assert!((*b - *a).perp_dot(middle - *a) < 0.0);
        }
        // Identical three periods further.
        let far = outline.near(DVec2::splat(192.0), DVec2::splat(256.0)).unwrap();
        assert_eq!(far.len(), outline.segments.len());
    }

    #[test]
    fn mask_borders_follow_the_wrap_mode_across_the_seam() {
        // The left half is opaque.
        let half = |wrap| OpacityMask::of_opacities(4, [255, 255, 0, 0].repeat(4), wrap);
        let repeated = border_index(&half(Wrap::Repeat), 0.1);
        assert_eq!(repeated.segments.len(), 2);
        assert!(repeated.segments.iter().all(|[a, b]| (a.y - b.y).abs() == 4.0));
        let clamped = border_index(&half(Wrap::Clamp), 0.1);
        let far = clamped.near(DVec2::new(0.0, 500.0), DVec2::new(3.0, 600.0)).unwrap();
        assert!(far.iter().all(|[a, b]| a.x == 1.5 && b.x == 1.5) && !far.is_empty());
        assert_eq!(border_index(&half(Wrap::Mirror), 0.1).segments.len(), 2);
    }

    #[test]
    fn mask_borders_exist_for_a_picture_of_one_column() {
        let mask = OpacityMask::of_opacities(1, vec![0, 0, 255, 255], Wrap::Clamp);
        let near = border_index(&mask, 0.1).near(DVec2::new(-0.3, 0.0), DVec2::new(0.2, 3.0)).unwrap();
        assert!(!near.is_empty() && near.iter().flatten().all(|p| p.y == 1.5));
    }

    #[test]
    fn mask_borders_over_too_many_repeats_are_refused() {
        let outline =
            border_index(&OpacityMask::of_opacities(4, [255, 255, 0, 0].repeat(4), Wrap::Repeat), 0.1);
        assert!(outline.near(DVec2::new(0.0, 0.0), DVec2::new(9e8, 1e-3)).is_none());
    }
}
