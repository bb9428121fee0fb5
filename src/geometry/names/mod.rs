//! Names: patterns that select them, and numbers that identify them.
//!
//! Files: [`glob`] patterns with `*` and `?`; [`name_ids`] a stable number for each of several named things.

pub(crate) mod glob;
pub(crate) mod name_ids;
