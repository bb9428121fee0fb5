//! Intersecting pairs kept from one mesh to the next.
//!
//! [`intersection_cache`] reuses the pairs of a mesh after some of its faces are cut.

pub(crate) mod intersection_cache;
