//! Curve fitting: turns a raw line into the path that is drawn, and into the points that strokes follow.
//!
//! 1. Corners on one circle become an arc (`circular_arcs`), within the rounding of the file.
//! 2. Stretches on smooth surfaces are freed of fold-backs, resampled, cut at corners and smoothed.
//! 3. Each stretch is simplified and fitted with cubic Béziers. All other stretches keep their exact corners.
//! 4. A line that runs over several parts of a body is cut where the part changes.
//!
//! Files, in reading order: [`line_finish`] the order of the steps; [`circular_arcs`]; [`foldbacks`];
//! [`resampling`]; [`corner_points`]; [`whittaker_smoothing`]; [`line_simplification`]; [`bezier_fit`] (Schneider
//! 1990); [`curve_path`] straight and curved pieces as one path; [`part_runs`].

pub(crate) mod bezier_fit;
pub(crate) mod circular_arcs;
mod corner_points;
pub(crate) mod curve_path;
mod foldbacks;
pub(crate) mod line_finish;
pub(crate) mod line_simplification;
pub(crate) mod part_runs;
mod resampling;
pub(crate) mod whittaker_smoothing;
