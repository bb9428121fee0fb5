//! Models of requests: read, posed, filtered and simplified.
//!
//! 1. [`opened_model`] reads the model from a file or standard input.
//! 2. [`posed_scene`] poses it at the time of the request, with the weights of [`clip_blend`].
//! 3. [`opened_model`] removes the parts excluded by `--only` and `--hide`.
//! 4. [`lod`] limits the number of faces. It also holds the command `ligne lod`, which stores the
//!    simplification.

pub(crate) mod clip_blend;
pub(crate) mod lod;
pub(crate) mod opened_model;
mod posed_scene;
