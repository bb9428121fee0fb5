//! Lines that coincide in the image, drawn once.
//!
//! 1. Of two visible lines that coincide, the stronger kind stays; of equal kinds, the nearer one.
//! 2. Hidden lines within the ink of visible lines, or of hidden lines that precede them, are left out.
//!
//! Source: ISO 128-2: visible outlines and edges take precedence over hidden ones.
//! Files, in reading order: [`edge_line`] a view edge in the image; [`edge_grid`] lookup by place;
//! [`coincident_lines`] step 1; [`hidden_line_precedence`] step 2; [`smooth_chains`] hidden edges chained up to
//! corners and branches.

pub(crate) mod coincident_lines;
mod edge_grid;
mod edge_line;
pub(crate) mod hidden_line_precedence;
mod smooth_chains;
