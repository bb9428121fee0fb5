//! Value types of options, each with its parser.
//!
//! Files:
//! - [`paper_size`]: sizes, pages, margins and scales.
//! - [`model_unit`]: the unit of length of a model.
//! - [`shard`]: `K/N` shares of work, also from job arrays.
//! - [`completion_values`]: a parser that also lists values for shell completion.

pub(crate) mod completion_values;
pub(crate) mod model_unit;
pub(crate) mod paper_size;
pub(crate) mod shard;
