//! Cells: the triangulated page, sets of triangles that look alike, and the borders between them.
//!
//! 1. The segments of the arrangement constrain a Delaunay triangulation. Triangles with no border between
//!    them are a cell.
//! 2. Connected triangles of one label become a patch. Patches below a minimum area go to a neighbour.
//! 3. Half edges between two patches are traced into arcs, and arcs into the loops around each patch.
//!
//! Source of the insertion order: Amenta, Choi and Rote, Incremental constructions con BRIO, SoCG 2003.
//!
//! Files, in reading order: [`triangulation`]; [`insertion_order`]; [`label_components`]; [`border_arcs`].

pub(crate) mod border_arcs;
mod insertion_order;
pub(crate) mod label_components;
pub(crate) mod triangulation;
