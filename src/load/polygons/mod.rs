//! Polygons of a file, cut into triangles.
//!
//! Files: [`triangulation`] quads by the better diagonal, others by a fan or by ear clipping (Eberly);
//! [`added_diagonals`] which sides of these triangles are diagonals that the cut has added.

pub(crate) mod added_diagonals;
pub(crate) mod triangulation;
