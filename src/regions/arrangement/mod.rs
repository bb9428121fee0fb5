//! Arrangement: border segments on an integer grid that meet in shared points only.
//!
//! 1. Chains of short segments are simplified (Douglas and Peucker 1973).
//! 2. Segments are cut where they cross or touch; new points are rounded to the grid, until nothing crosses.
//! 3. Free ends are extended to the nearest segment within reach.
//!
//! Source: Halperin and Packer, Iterated snap rounding, Computational Geometry 23, 2002.
//!
//! Files, in reading order: [`border_simplification`]; [`snap_rounding`] the rounds; [`segment_crossing`]
//! exact tests in integers; [`grid_tiles`] only for speed: segments by the tiles they touch.

pub(crate) mod border_simplification;
pub(crate) mod grid_tiles;
mod segment_crossing;
pub(crate) mod snap_rounding;
