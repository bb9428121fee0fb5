//! Half-tone dots on a lattice and stippling.
//!
//! 1. The rows of a lattice are intersected with all borders, which gives the cell of every lattice point
//!    ([`lattice_scan`]).
//! 2. Half-tone: a dot at each lattice point, sized by the tone there and clipped to its surface
//!    ([`halftone`]).
//! 3. Stippling: dots of nearly one size, spread by Lloyd relaxation of a weighted Voronoi diagram
//!    ([`weighted_voronoi`], [`stipple`]; Secord, Weighted Voronoi stippling, NPAR 2002).
//!
//! Files, in reading order: [`lattice_scan`]; [`halftone`]; [`weighted_voronoi`]; [`stipple`].

pub(crate) mod halftone;
mod lattice_scan;
pub(crate) mod stipple;
mod weighted_voronoi;
