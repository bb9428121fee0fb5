//! Extent of a scene: the points that count for its size, and the limits of their coordinates.
//!
//! Files, in reading order: [`coordinate_limits`] which coordinates can be drawn, and the bounding box of
//! points; [`drawn_points`] the points of faces with area and of wires with length; [`precision_warning`]
//! warns about coordinates that are too coarse for the size of the model.

pub(crate) mod coordinate_limits;
pub(crate) mod drawn_points;
pub(crate) mod precision_warning;
