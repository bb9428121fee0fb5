//! A conservative test that skips edges where n·v cannot vanish. It changes the time, not the result.
//!
//! [`edge_on_margin`] computes the margin of each vertex from being seen edge-on. Short edges between such
//! vertices are skipped.

pub(crate) mod edge_on_margin;
