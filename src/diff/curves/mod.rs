//! Polylines of a drawing in px, with distances and spatial indexes.
//!
//! 1. [`chain`] flattens paths within a stated error and joins open polylines where exactly two ends meet.
//! 2. [`segment_grid`] sorts the segments of chains into square cells.
//! 3. [`segment_clusters`] is a tree of segments by both end points, for places where thousands nearly
//!    coincide.
//! 4. [`hausdorff_distance`] measures two chains by branch and bound.
//! 5. [`chain_alignment`] fits a shift and a similarity to corresponding points.
//!
//! Also: [`segment`] nearest point of a segment, points and boxes; [`region_area`] area of a region minus its holes.

pub(crate) mod chain;
pub(crate) mod chain_alignment;
pub(crate) mod hausdorff_distance;
pub(crate) mod region_area;
pub(crate) mod segment;
pub(crate) mod segment_clusters;
pub(crate) mod segment_grid;
