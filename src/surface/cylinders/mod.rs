//! Circular cylinders that a mesh approximates, with their axes.
//!
//! 1. Facets with parallel side lines are strips.
//! 2. The perpendicular bisectors of two neighbouring strips meet in the centre of their circle.
//! 3. Strips that agree on a circle form a cylinder, refined by a circle fit (Kåsa 1976).
//! 4. Around known axes, separate narrow facets at equal radius form rims, such as gear tips.
//!
//! Files, in reading order: [`cylinder`] (the result), [`strip_cylinders`] (steps 1 to 3), [`coaxial_rims`]
//! (step 4).

mod coaxial_rims;
pub(crate) mod cylinder;
pub(crate) mod strip_cylinders;
