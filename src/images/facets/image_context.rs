//! [`ImageContext`]: the mesh, camera and visibility data that all material images (textures) of a view share
//! when they are projected to the page.

use kurbo::Vec2;

use super::face_crossings::FaceCrossings;
use super::visible_faces::VisibleFaces;
use crate::mesh::Mesh;
use crate::view::View;
use crate::view::raster::PixelGrid;

/// Shared input for projecting the material images of a view to the page.
#[derive(Clone, Copy)]
pub(crate) struct ImageContext<'a> {
    pub mesh: &'a Mesh,
    pub view: &'a View,
    /// The projected mesh over a grid of pixels.
    pub screen: &'a PixelGrid<'a>,
    /// Faces that may be visible; images are projected for these only.
    pub visible_faces: &'a VisibleFaces,
    /// Lines where faces intersect. Faces are cut there, so that a painting order exists.
    pub crossings: &'a FaceCrossings,
    /// Offset of the camera's frame on the page, user units.
    pub offset: Vec2,
    /// Length of a px in user units.
    pub px: f64,
    /// Largest number of image pixels per px of the page.
    pub max_pixels_per_px: f64,
}
