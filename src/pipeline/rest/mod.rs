//! Rest positions of lines and mesh vertices: where they lie on the model before its animation moves it.
//!
//! Strokes and patterns that depend on rest positions stay fixed to a moving surface.
//!
//! 1. A point of a line is unprojected from the page; the nearest triangle of its part gives its position
//!    on the surface ([`chain_anchors`]).
//! 2. The same barycentric position on this triangle of the part at rest is its rest position. Mesh
//!    vertices get theirs in the same way ([`rest_pose`]).
//!
//! Files, in reading order: [`chain_anchors`]; [`rest_pose`].

pub(crate) mod chain_anchors;
pub(crate) mod rest_pose;
