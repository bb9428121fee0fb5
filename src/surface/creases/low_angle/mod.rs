//! Creases of machined parts that turn by less than the crease angle.
//!
//! 1. From each candidate edge, a straight trace crosses the surface on both sides.
//! 2. Facets of a curve bend again by a similar angle in the same direction. Where they do not on either
//!    side, the edge is a shallow crease, such as the border of a chamfer.
//! 3. Regular steps that turn by 50 to 130 degrees in total form a fillet. If the fillet is narrow, its
//!    centre line is drawn.
//!
//! Files, in reading order: [`surface_trace`] (step 1), [`continuation`] and [`shallow_creases`] (step 2),
//! [`narrow_fillets`] and [`fillet_centre_lines`] (step 3).

mod continuation;
mod fillet_centre_lines;
pub(crate) mod narrow_fillets;
pub(crate) mod shallow_creases;
pub(crate) mod surface_trace;
