//! Tolerances of numbers and plane geometry, and those that several modules share. Every other top-level
//! module has its own `tolerances.rs`.
//!
//! Conventions of all these files:
//!
//! - A tolerance is a fraction of a named length or angle, or a length in px of the page.
//! - `PART` in a name stands for the diagonal of the part's bounding box, or of the larger part where two
//!   meet (see `mesh::part_metrics`). Results therefore do not depend on the model's scale or on its other
//!   parts.
//! - Lengths in space that are given in px are measured at their depth.

/// Maximum distance between neighbouring `f32` numbers, as a fraction of the number: 2^-23.
pub(crate) const F32_STEP: f64 = 1.0 / 8_388_608.0;

/// A point within this distance of a projected triangle's border (px) is inside, so a line exactly behind an
/// edge is hidden by the faces of that edge.
pub(crate) const TRIANGLE_BORDER_PX: f64 = 1e-7;

/// Minimum pivot of a positive definite matrix, as a fraction of its trace: the rounding of `f64`. Smaller
/// pivots count as zero.
pub(crate) const MIN_PIVOT_OF_TRACE: f64 = f64::EPSILON;

/// Margin of the columns of a planar grid that a segment passes in a row, in cells. Exceeds rounding, so no
/// cell is missed.
pub(crate) const CELL_MARGIN: f64 = 1e-6;

/// Margin on the parameter of a segment (0 to 1) in box tests. Several roundings of `f64` are smaller.
pub(crate) const PARAMETER_ROUNDING: f64 = 1e-9;
