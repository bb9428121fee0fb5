//! Functions and constants of plain numbers.
//!
//! Files, in reading order: [`portable_math`] transcendental functions with the same last bit on every
//! machine; [`powers_of_two`] the powers of two around a number; [`linear_solver`] small symmetric systems of
//! equations; [`noise`] hashes and value noise in place of a random generator; [`ranges`] ranges that
//! overlap; [`checked_number`] numbers of style sheets that must pass a check; [`length_units`] units of lengths by
//! name.

pub(crate) mod checked_number;
pub(crate) mod length_units;
pub(crate) mod linear_solver;
pub(crate) mod noise;
pub(crate) mod portable_math;
pub(crate) mod powers_of_two;
pub(crate) mod ranges;
