//! Visibility queries outside the view map.
//!
//! 1. For points of the image: the nearest face. The points are sorted into a grid and each face visits those
//!    in its bounding box.
//! 2. For gaps between line ends: whether a surface of another component is visible in front of the gap.
//!
//! Files, in reading order: [`nearest_faces`] query 1; [`gap_occlusion`] query 2, used when lines are chained
//! across gaps.

pub(crate) mod gap_occlusion;
pub(crate) mod nearest_faces;
