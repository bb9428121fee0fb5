//! Path data in canonical form: the same path always gives the same text.
//!
//! 1. Each coordinate is rounded to the written precision (`path_piece`).
//! 2. Pieces of zero length are dropped. Closed subpaths start at their least point (least rotation), and
//!    solid lines run in the direction that sorts first (`canonical_path`).
//! 3. `path_data` writes relative commands with the fewest characters that the grammar of SVG allows.

pub(crate) mod canonical_path;
mod path_data;
pub(crate) mod path_piece;
