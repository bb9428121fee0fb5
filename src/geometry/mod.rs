//! Numerical and geometric helpers that know nothing about models or drawings. Every other module may import
//! them.
//!
//! The only import from another module is `parallel`. Results are the same on every machine and with every
//! number of threads.
//!
//! - [`numbers`]: portable functions, powers of two, linear systems and noise.
//! - [`plane`]: distances, convex hulls and zero lines of grids.
//! - [`lists`]: lists of lists (CSR) and bit sets.
//! - [`names`]: name patterns and stable ids.
//! - [`tolerances`]: thresholds that several modules share.

#[cfg(test)]
#[path = "../../tests/library/support/scenes/random_dice.rs"]
pub mod dice;
pub mod lists;
pub mod names;
pub mod numbers;
pub mod plane;
pub mod tolerances;
