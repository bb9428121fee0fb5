//! Facets of the faces that show a picture in a view.

use glam::{DVec2, DVec3};

use super::facet::{Facet, FacetCorner};
use super::image_context::ImageContext;
use crate::mesh::FaceId;
use crate::scene::textures::EmbeddedTexture;
use crate::view::Frame;

/// Largest error of an affine map in a facet, px. Facets are joined again where the tolerance allows it.
const MAX_AFFINE_ERROR_PX: f64 = 0.1;

/// Largest number of times a facet is halved.
const MAX_HALVINGS: u32 = 20;

/// Facets of the faces that show a picture and may be visible.
pub(crate) fn visible_facets(stage: &ImageContext, imaged: &EmbeddedTexture) -> Vec<Facet> {
    let ImageContext { mesh, view, screen, visible_faces: in_front, crossings, px, .. } = *stage;
    let frame = &view.frame;
    let mut facets = Vec::new();
    let texels = imaged.texels();
    let corners = |face: u32| -> Option<[DVec2; 3]> {
        let uvs = mesh.corner_uvs.get(face as usize)?;
        let [a, b, c] = uvs.map(|uv| texels.place(*mesh.uvs.get(uv as usize)?));
        Some([a?, b?, c?])
    };
    let mut add = |face: u32, image: [DVec3; 3], texel_corners: [DVec2; 3]| {
        let corners = [0, 1, 2].map(|k| FacetCorner { image: image[k], place: texel_corners[k] });
        let part = mesh.face_part[face as usize];
        let facet = Facet::new(corners, part);
        let pieces = crossings.cut(face, facet, frame, px);
        let is_whole = pieces.len() == 1;
        for piece in pieces {
            if !is_whole && !in_front.piece(screen, face, piece.corners.map(|corner| corner.image)) {
                continue;
            }
            halve(piece, frame, px, 0, &mut facets);
        }
    };
    let shows = |face: u32| {
        mesh.paint(FaceId(face)) == imaged.paint && !mesh.is_degenerate(FaceId(face)) && in_front.face(face)
    };
    for face in (0..mesh.triangles.len() as u32).filter(|face| shows(*face)) {
        let image = mesh.triangles[face as usize].map(|v| view.points[v as usize]);
        if let Some(corner_places) = corners(face).filter(|_| image.iter().all(|p| p.is_finite())) {
            add(face, image, corner_places);
        }
    }
    for clipped in view.clipped.iter().filter(|clipped| shows(clipped.face.0)) {
        let Some(clipped_places) = corners(clipped.face.0) else { continue };
        let texel_at = |p: DVec3| {
            let weights = mesh.weights(clipped.face, frame.local_from_image(p));
            clipped_places[0] * weights[0] + clipped_places[1] * weights[1] + clipped_places[2] * weights[2]
        };
        if clipped.points.iter().all(|p| p.is_finite()) {
            add(clipped.face.0, clipped.points, clipped.points.map(texel_at));
        }
    }
    facets
}

/// Halves a facet until one affine map is correct in all of it, and drops facets off the page.
fn halve(facet: Facet, frame: &Frame, px: f64, depth: u32, facets: &mut Vec<Facet>) {
    if !facet.is_on(frame) {
        return;
    }
    let (side, miss) = facet.miss();
    if !frame.perspective || miss <= MAX_AFFINE_ERROR_PX * px || depth == MAX_HALVINGS {
        facets.push(facet);
        return;
    }
    facet.cut(side, 0.5, frame).into_iter().for_each(|half| halve(half, frame, px, depth + 1, facets));
}
