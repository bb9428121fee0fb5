//! Shadow test for points of the surface.

use crate::parallel::prelude::*;
use glam::{DVec2, DVec3};

use super::face_orientation::FaceOrientation;
use super::light_views::LightView;
use crate::geometry::space::triangles::{area_vector, squared_distance};
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
                && squared_distance(point, &mesh.corners(FaceId(front.face))) > contact * contact
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
    let fall = area_vector(mesh.corners(FaceId(face))).dot(towards(caster, point));
    match outside[face as usize] {
        FaceOrientation::Front => fall <= 0.0,
        FaceOrientation::Back => fall >= 0.0,
        FaceOrientation::Unknown => false,
    }
}
