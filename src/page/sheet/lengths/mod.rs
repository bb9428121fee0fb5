//! Lengths as numbers: the measured value, its precision and its digits. `dimensions` adds ⌀, R and counts.
//!
//! 1. `true_length` finds the length of the model that a dimension measures in a view, or the reason to
//!    refuse it.
//! 2. `length_precision` finds how many decimals the input file carries of that length.
//! 3. `length_format` rounds, converts the unit and writes the number.

pub(crate) mod length_format;
pub(crate) mod length_precision;
pub(crate) mod true_length;
