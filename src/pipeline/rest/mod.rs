//! Positions of lines and surface points on the model at rest, so that strokes stay on a moving model.
//!
//! 1. A point of the page is unprojected; the nearest triangle of its part gives its position on the surface
//!    ([`chain_anchors`]).
//! 2. The same triangle of the resting part gives its rest position, for chains and for mesh vertices
//!    ([`rest_pose`]).
//!
//! Files, in reading order: [`chain_anchors`]; [`rest_pose`].

pub(crate) mod chain_anchors;
pub(crate) mod rest_pose;
