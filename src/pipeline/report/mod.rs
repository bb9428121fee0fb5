//! Times, counts and warnings of a drawing.
//!
//! Files, in reading order:
//! 1. [`drawing_report`]: times and counts, as JSON.
//! 2. [`mesh_defects`]: defects of the mesh as warnings.
//! 3. [`empty_drawing`]: the reason why a drawing has no mark.

pub(crate) mod drawing_report;
pub(crate) mod empty_drawing;
pub(crate) mod mesh_defects;
