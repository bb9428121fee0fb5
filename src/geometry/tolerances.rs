//! Tolerances of numbers and plane geometry, and those that several rooms share.
//!
//! Every other room has its own `tolerances.rs`. Each tolerance is a fraction of a named length or angle, or
//! a length in px of the page. `part` is the diagonal of the bounding box of the part in question, or of the
//! larger part where two meet (see `mesh::part_metrics`). A 3 mm gear and a cathedral are therefore treated
//! alike, and other parts of the model have no influence. Lengths in px of things in space are measured at
//! their depth.

/// Maximum distance between neighbouring `f32` numbers, as a fraction of the number.
pub const F32_STEP: f64 = 1.0 / 8_388_608.0;

/// A point within this distance of a projected triangle's border (px) is inside, so a line exactly behind an
/// edge is hidden by the faces of that edge.
pub const TRIANGLE_BORDER_PX: f64 = 1e-7;

/// Minimum pivot of a positive definite matrix, as a fraction of its trace: the rounding of `f64`. Smaller
/// pivots count as zero.
pub const MIN_PIVOT_OF_TRACE: f64 = f64::EPSILON;
