//! Page transform: centres the camera's frame on the page.

use kurbo::{Rect, Size, Vec2};

use crate::drawing::Page;
use crate::view::Frame;
use crate::visibility::ViewMap;

/// Moves the picture from the camera's frame to the middle of the page.
pub(crate) fn centre_on_page(map: &mut ViewMap, frame: &Frame, page: &Page) {
    let margin = margin(frame, page);
    if margin != Vec2::ZERO {
        for vertex in &mut map.vertices {
            vertex.position += margin;
        }
    }
}

/// Offset from the camera's frame to the page.
pub(crate) fn margin(frame: &Frame, page: &Page) -> Vec2 {
    Vec2::new(page.width - frame.width, page.height - frame.height) / 2.0
}

/// The camera's frame on the page.
pub(crate) fn frame_on_page(frame: &Frame, page: &Page) -> Rect {
    Rect::from_origin_size(margin(frame, page).to_point(), Size::new(frame.width, frame.height))
}
