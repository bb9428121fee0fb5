//! Tidying: drops duplicate and noisy lines of the view map, and joins lines that one pen stroke would draw.
//!
//! 1. Short hidden stretches of a smooth contour are made visible.
//! 2. Three rounds follow. Each stitches contours across small gaps, drops double lines, and drops short
//!    and noisy lines.
//! 3. Each line is cut where it changes between silhouette and inner contour.
//!
//! Source: Bénard, Hertzmann and Kass, Computing smooth surface contours with accurate topology, ACM TOG
//! 2014, section 6.
//!
//! Files, in reading order: [`tidy_passes`] the order of the steps; [`raw_line`] a line with what tidying
//! needs; [`hidden_gaps`]; [`stitching`]; [`oriented_line`] cuts near an end of a line; [`double_lines`];
//! [`piece_grid`] lookup of parallel lines; [`short_lines`]; [`silhouette_runs`]; [`removed_lines`] a report
//! of dropped lines and the reasons.

mod double_lines;
mod hidden_gaps;
mod oriented_line;
mod piece_grid;
pub(crate) mod raw_line;
pub(crate) mod removed_lines;
mod short_lines;
mod silhouette_runs;
mod stitching;
pub(crate) mod tidy_passes;
