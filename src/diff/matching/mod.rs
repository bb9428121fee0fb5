//! Correspondence between the marks of two drawings.
//!
//! 1. [`equal_shapes`] pairs shapes that are equal point for point, by hash.
//! 2. [`interval_cover`] computes, for each remaining chain, the intervals within tolerance of the other
//!    drawing. The points of a segment inside the capsule of another segment form one interval
//!    ([`capsule_interval`]), so the result is exact.
//! 3. [`chain_pairs`] pairs chains with uncovered intervals, nearest first, and then congruent closed chains
//!    at any distance.
//! 4. [`chain_events`] classifies each chain (one mark, not a part) as moved, reshaped, restyled, relabelled, removed or added.

mod capsule_interval;
pub(crate) mod chain_events;
pub(crate) mod chain_pairs;
pub(crate) mod equal_shapes;
pub(crate) mod interval_cover;
