//! Canonical form of any SVG file, so that version control shows small differences.
//!
//! 1. [`presentation_attributes`] replaces style sheets and `style` attributes by presentation attributes
//!    where that is exact.
//! 2. [`computed_style`] derives, for each path, which rewrites keep the picture the same.
//! 3. [`path_parser`] reads path data by the grammar of SVG.
//! 4. [`canonical_document`] rewrites path data and sorts neighbouring paths of equal paint, in place in the
//!    text.

pub(crate) mod canonical_document;
mod computed_style;
mod path_parser;
mod presentation_attributes;
