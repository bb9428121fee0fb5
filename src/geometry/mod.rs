//! Numerical and geometric helpers that know nothing about models or drawings. Every other module may import
//! them.
//!
//! The only import from another module is `parallel`. Results are the same on every machine and with every
//! number of threads.
//!
//! - [`numbers`]: portable functions, powers of two, linear systems and noise.
//! - [`plane`]: distances, polylines, a uniform grid, convex hulls and zero lines of grids.
//! - [`space`]: boxes, trees of boxes, and triangles.
//! - [`lists`]: lists of lists (CSR) and bit sets.
//! - [`names`]: name patterns and stable ids.
//! - [`tolerances`]: thresholds that several modules share. `dice`: random numbers for tests.

#[cfg(test)]
pub(crate) mod dice;
pub(crate) mod lists;
pub(crate) mod names;
pub(crate) mod numbers;
pub(crate) mod plane;
pub(crate) mod space;
pub(crate) mod tolerances;
