//! Conservative tests that skip edges where n·v cannot vanish. They change the time, not the result.
//!
//! 1. Per mesh: a bounding sphere and a normal cone for every run of edges (Shirman and Abi-Ezzi 1993). A
//!    view skips whole runs.
//! 2. Per view: the margin of each vertex from being seen edge-on. Short edges between such vertices are
//!    skipped.
//!
//! Both leave a margin for rounding.
//! Files, in reading order: [`normal_cones`] test 1; [`edge_on_margin`] test 2.

pub(crate) mod edge_on_margin;
pub(crate) mod normal_cones;
