//! The keys of a sheet in a page file.
//!
//! Files, in reading order:
//!
//! - [`sheet_keys`]: all keys, as serde reads them.
//! - `explosion_keys`: the settings of the exploded view, checked and converted.

pub(crate) mod explosion_keys;
pub(crate) mod sheet_keys;
