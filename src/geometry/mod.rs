//! Numbers, lists and plane geometry that every other area may import.
//!
//! Nothing here depends on another room except the parallel loops, so results are the same on every machine
//! and thread count.
//!
//! Folders, in reading order: [`numbers`] portable functions, powers of two, linear systems and noise;
//! [`plane`] distances, convex hulls and zero lines of grids; [`lists`] lists of lists (CSR) and sets of
//! bits; [`names`] name patterns and stable ids of named things. File: [`tolerances`].

#[cfg(test)]
#[path = "../../tests/library/support/scenes/random_dice.rs"]
pub mod dice;
pub mod lists;
pub mod names;
pub mod numbers;
pub mod plane;
pub mod tolerances;
