//! Results computed from a picture, kept for later views.
//!
//! [`result_cache`] shares them between views and threads.

pub(crate) mod result_cache;
