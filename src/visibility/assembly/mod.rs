//! The [`ViewMap`](super::ViewMap) assembled from the pieces of its lines.
//!
//! 1. All segments are projected and their visibility is computed.
//! 2. Every kept piece becomes a view edge. Pieces share a vertex by identity, never because two positions
//!    are close.
//! 3. Coincident lines are removed.
//! 4. Lines found in the image of the view, and motion lines, are added in the same form.
//!
//! Files, in reading order: [`map_builder`] steps 1 to 3; [`image_edges`] lines found in the image;
//! [`motion_lines`] the view map of motion lines.

pub(crate) mod image_edges;
pub(crate) mod map_builder;
pub(crate) mod motion_lines;
