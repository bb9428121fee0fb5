//! Requests: checked options of one drawing, its camera and sheet, and advice to the user.
//!
//! Files, in reading order:
//! - [`draw_request`]: checks the options and collects them in a `DrawRequest`.
//! - [`viewpoint`]: computes the camera and the sheet for a scene.
//! - [`usage_warnings`]: warns about options without effect and empty drawings.
//! - [`model_hints`]: suggests options for common problems of models.

pub(crate) mod draw_request;
pub(crate) mod model_hints;
pub(crate) mod usage_warnings;
pub(crate) mod viewpoint;
