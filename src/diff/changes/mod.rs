//! Findings about single marks, from the events of their chains.
//!
//! 1. [`line_findings`] writes one finding per line.
//! 2. [`region_findings`] collects the events of all borders of a region into one finding.
//! 3. [`outline_findings`] compares the outlines of lines of varying width whose axis is unchanged.
//! 4. [`stacking_order`] finds marks painted in another order where they overlap (longest increasing
//!    subsequence).
//! 5. [`renamed_parts`] finds parts that only changed their name.
//! 6. [`missing_labels`] reports labels that one of the drawings lacks entirely.
//!
//! [`finding_writer`] holds the parts common to lines and regions.

pub(crate) mod finding_writer;
pub(crate) mod line_findings;
pub(crate) mod missing_labels;
pub(crate) mod outline_findings;
pub(crate) mod region_findings;
mod renamed_parts;
pub(crate) mod stacking_order;

pub(crate) use self::renamed_parts::{Renamed, renamed};
