//! [`Stage`]: the input shared by all pictures of a view.

use kurbo::Vec2;

use super::face_crossings::Crossings;
use super::visible_faces::InFront;
use crate::mesh::Mesh;
use crate::view::View;
use crate::view::raster::Screen;

/// Input shared by all pictures of a view.
#[derive(Clone, Copy)]
pub(crate) struct Stage<'a> {
    pub mesh: &'a Mesh,
    pub view: &'a View,
    pub screen: &'a Screen<'a>,
    pub in_front: &'a InFront,
    pub crossings: &'a Crossings,
    /// Offset of the frame on the page.
    pub offset: Vec2,
    /// A px in user units.
    pub px: f64,
    /// Largest number of texels kept along a px.
    pub samples: f64,
}
