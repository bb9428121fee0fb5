//! Shared support of the library tests: scenes, independent reference solutions, and measures of drawings.
//!
//! Reading order:
//!
//! 1. [`scenes`] builds solids, random scenes and animated scenes.
//! 2. [`pipeline`] and [`styled`] build cameras and styles, and run the library's stages on a scene.
//! 3. [`references`] computes the correct lines and their visibility by simple, slow methods.
//! 4. [`measures`] compares lines, areas and pictures.
//! 5. [`readers`] parses model and output files with code that is independent of the library.
//! 6. [`properties`] tests that a drawing is invariant under changes such as rotation or renumbering.
//! 7. [`rewriting`] tests that a model gives the same drawing in every file format and encoding.
//! 8. [`imports`] reads the import graph from source code; [`plain_words`] measures English; [`long_run`] selects the size of a test run.

pub(crate) mod imports;
pub(crate) mod long_run;
pub(crate) mod measures;
pub(crate) mod pipeline;
pub(crate) mod plain_words;
pub(crate) mod properties;
pub(crate) mod readers;
pub(crate) mod references;
pub(crate) mod rewriting;
pub(crate) mod scenes;
pub(crate) mod styled;
