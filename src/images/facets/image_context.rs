//! [`ImageContext`]: the input shared by all pictures of a view.

use kurbo::Vec2;

use super::face_crossings::FaceCrossings;
use super::visible_faces::VisibleFaces;
use crate::mesh::Mesh;
use crate::view::View;
use crate::view::raster::PixelGrid;

/// Input shared by all pictures of a view.
#[derive(Clone, Copy)]
pub(crate) struct ImageContext<'a> {
    pub mesh: &'a Mesh,
    pub view: &'a View,
    pub screen: &'a PixelGrid<'a>,
    pub in_front: &'a VisibleFaces,
    pub crossings: &'a FaceCrossings,
    /// Offset of the frame on the page.
    pub offset: Vec2,
    /// A px in user units.
    pub px: f64,
    /// Largest number of texels kept along a px.
    pub samples: f64,
}
