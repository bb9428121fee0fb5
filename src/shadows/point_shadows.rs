//! Shadow test for points of the surface.

use crate::parallel::prelude::*;
use glam::{DVec2, DVec3};

use super::face_orientation::FaceOrientation;
use super::light_views::LightView;
use crate::light::Caster;
use crate::mesh::{FaceId, Mesh};
use crate::visibility::front_faces;

/// Sets a bit in the masks of the points that another face shades from a light.
pub(crate) fn mark_shadowed(
    mesh: &Mesh,
    caster: &Caster,
    views: &[LightView],
    outside: &[FaceOrientation],
    points: &[(u32, DVec3)],
    bit: u32,
    masks: &mut [u32],
) {
    let asked: Vec<bool> = points
        .par_iter()
        .with_min_len(1 << 10)
        .map(|(face, point)| !is_averted(mesh, caster, outside, *face, *point))
        .collect();
    for light in views {
        let frame = &light.view.frame;
        let chosen: Vec<usize> =
            (0..points.len()).filter(|k| asked[*k] && light.shows(points[*k].1)).collect();
        let images: Vec<DVec3> = chosen.iter().map(|k| frame.image_from_local(points[*k].1)).collect();
        let places: Vec<DVec2> =
            images.iter().map(|p| if p.z.is_nan() { DVec2::splat(-1.0) } else { p.truncate() }).collect();
        let fronts = front_faces(mesh, &light.view, &places);
        for ((k, image), front) in chosen.iter().zip(&images).zip(fronts) {
            let Some(front) = front else { continue };
            let (face, point) = points[*k];
            let gap = front.nearness - image.z;
            let contact = [face, front.face].map(|face| mesh.extent(FaceId(face)).contact);
            let contact = contact[0].max(contact[1]);
            if front.face != face
                && gap > frame.nearness_step(image.z, contact)
                && distance(point, mesh.corners(FaceId(front.face))) > contact
            {
                masks[*k] |= bit;
            }
        }
    }
}

/// Direction from a point towards a light, of any length.
fn towards(caster: &Caster, point: DVec3) -> DVec3 {
    match *caster {
        Caster::Directional { towards } => towards,
        Caster::Point { position } => position - point,
    }
}

/// Whether a face of a solid turns its inside to the light.
fn is_averted(mesh: &Mesh, caster: &Caster, outside: &[FaceOrientation], face: u32, point: DVec3) -> bool {
    let [a, b, c] = mesh.corners(FaceId(face));
    let fall = (b - a).cross(c - a).dot(towards(caster, point));
    match outside[face as usize] {
        FaceOrientation::Front => fall <= 0.0,
        FaceOrientation::Back => fall >= 0.0,
        FaceOrientation::Unknown => false,
    }
}

/// Distance of a point from a triangle.
///
/// Source: Christer Ericson, "Real-time collision detection", 2005, section 5.1.5.
fn distance(p: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    let to_segment = |a: DVec3, b: DVec3| {
        let along = b - a;
        let part = ((p - a).dot(along) / along.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        p.distance(a + along * part)
    };
    let normal = (b - a).cross(c - a);
    let inside = |a: DVec3, b: DVec3| (b - a).cross(p - a).dot(normal) >= 0.0;
    if inside(a, b) && inside(b, c) && inside(c, a) {
        (p - a).dot(normal.normalize_or_zero()).abs()
    } else {
        to_segment(a, b).min(to_segment(b, c)).min(to_segment(c, a))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distance_to_a_triangle_is_exact() {
        let triangle = [DVec3::ZERO, DVec3::X, DVec3::Y];
        for (p, wanted) in [
            (DVec3::new(0.2, 0.2, -3.0), 3.0),
            (DVec3::new(0.5, -2.0, 0.0), 2.0),
            (DVec3::new(4.0, -4.0, 0.0), 5.0),
            (DVec3::new(1.0, 1.0, 0.0), 0.5_f64.sqrt()),
            (DVec3::new(0.3, 0.3, 0.0), 0.0),
        ] {
            assert!((distance(p, triangle) - wanted).abs() < 1e-12, "{p}");
        }
    }
}
