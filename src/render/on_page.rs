//! From the camera's frame to the page: the frame lies in its middle.

use kurbo::Vec2;

use crate::drawing::Page;
use crate::scene::Camera;
use crate::viewmap::ViewMap;

/// Moves the picture from the camera's frame to the middle of the page.
pub(super) fn centre_on_page(map: &mut ViewMap, camera: &Camera, page: &Page) {
    let margin = margin(camera, page);
    if margin != Vec2::ZERO {
        for vertex in &mut map.vertices {
            vertex.position += margin;
        }
    }
}

/// From the camera's frame to the page.
pub(super) fn margin(camera: &Camera, page: &Page) -> Vec2 {
    Vec2::new(page.width - camera.width, page.height - camera.height) / 2.0
}
