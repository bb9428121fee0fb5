//! The data that is compared: a drawing as shapes in px, each with ink and label.
//!
//! Files, in reading order: [`picture`] a drawing and its shapes; [`label`] layer, classes and part of a
//! mark; [`ink`] how a mark is painted; [`placeholder`] words and properties that stand for a text or an
//! embedded picture; [`render_tree`] the parsed file that is rasterised; [`tolerance_table`] distances allowed, by
//! layer and class; [`ignore_options`] aspects left out of a comparison; [`mark_groups`] labels and inks as
//! numbers, so that each pair is compared once.

pub(crate) mod ignore_options;
pub(crate) mod ink;
pub(crate) mod label;
pub(crate) mod mark_groups;
pub(crate) mod picture;
pub(crate) mod placeholder;
pub(crate) mod render_tree;
pub(crate) mod tolerance_table;
