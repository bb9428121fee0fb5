//! [`Stage`]: what a view shows pictures on.

use kurbo::Vec2;

use super::face_crossings::Crossings;
use super::visible_faces::InFront;
use crate::mesh::Mesh;
use crate::view::View;
use crate::view::raster::Screen;

/// What a view shows pictures on.
#[derive(Clone, Copy)]
pub(crate) struct Stage<'a> {
    pub mesh: &'a Mesh,
    pub view: &'a View,
    pub screen: &'a Screen<'a>,
    pub in_front: &'a InFront,
    pub crossings: &'a Crossings,
    /// Where the frame lies on the page.
    pub offset: Vec2,
    /// A px in user units.
    pub px: f64,
    /// Texels that are kept along a px, at most.
    pub samples: f64,
}
