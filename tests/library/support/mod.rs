//! What tests share: scenes, references that are slow and obvious, and measures.

pub mod imports;
pub mod long_run;
pub mod measures;
pub mod pipeline;
pub mod properties;
pub mod readers;
pub mod references;
pub mod rewriting;
pub mod scenes;
pub mod styled;
