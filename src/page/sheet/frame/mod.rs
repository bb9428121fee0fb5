//! The parts of a sheet whose place is fixed: frame, title block and parts table.
//!
//! Files, in reading order:
//!
//! - [`zone_frame`]: frame, zones, centring marks and trimming marks (ISO 5457).
//! - [`title_block`]: title block in the lower right corner (ISO 7200), with scale, size and projection
//!   symbol.
//! - `parts_table`: the parts list as a table above the title block (ISO 7573).

pub(crate) mod parts_table;
pub(crate) mod title_block;
pub(crate) mod zone_frame;
