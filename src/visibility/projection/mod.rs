//! Feature segments in image space.
//!
//! 1. Both ends are projected to (x, y, nearness). Straight lines stay straight.
//! 2. The segment is clipped to the near plane and to the page.
//! 3. The sides that its own faces leave open are found. Only there can background be visible next to the
//!    line.
//!
//! Files, in reading order: [`image_segments`] the projected segments; [`host_sides`] the sides covered by a
//! line's own faces.

pub(crate) mod host_sides;
pub(crate) mod image_segments;
