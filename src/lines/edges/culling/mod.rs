//! Shortcuts of the search for edge lines. They change the time, not the result.
//!
//! [`edge_search`] lists candidate edges once, for many views of one surface.

pub(crate) mod edge_search;
