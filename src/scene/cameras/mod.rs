//! Cameras: from the direction of a named view to a frame that the model fills.
//!
//! Files, in reading order: [`camera`] eye, target, projection and frame; [`named_views`] the views of
//! technical drawing as directions; [`framing`] moves a camera until the model fills its frame;
//! [`enclosing_part`] finds the part that a camera was put into by mistake; [`camera_json`] a camera as JSON,
//! for other programs.

pub(crate) mod camera;
pub(crate) mod camera_json;
mod enclosing_part;
pub(crate) mod framing;
pub(crate) mod named_views;
