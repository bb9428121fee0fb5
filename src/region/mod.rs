//! Regions: the parts of the page that look alike, with borders that neighbours share.

pub mod options;

pub use options::{RegionOptions, Seams};
