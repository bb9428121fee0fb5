//! The result of a comparison: one finding per changed mark, causes, totals and pixel counts.
//!
//! Files, in reading order: [`finding`] findings, verdicts, causes and the whole result; [`ink_totals`]
//! marks, lengths and areas by layer, class and part; [`pixel_count`] the number of pixels that differ.

pub(crate) mod finding;
pub(crate) mod ink_totals;
pub(crate) mod pixel_count;
