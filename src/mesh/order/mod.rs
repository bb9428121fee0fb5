//! Canonical order of vertices and faces, which depends on positions only.
//!
//! 1. Vertices are sorted along a Morton curve over all of space, and equal positions become one vertex.
//! 2. Faces are sorted by part and material, then by their vertices. Each face starts with its smallest
//!    vertex.
//! 3. Faces with the same vertices are sorted by their remaining attributes.
//!
//! Sources: Morton 1966; Connor and Kumar 2010, section 3 (exact order of floating-point coordinates).
//!
//! Files, in reading order: [`canonical_order`] (the steps; keys in `geometry::space`),
//! [`counting_sort`] (parallel stable sort by small integer keys).

pub(crate) mod canonical_order;
pub(crate) mod counting_sort;
