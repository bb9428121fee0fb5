//! Geometry in space: boxes, trees of boxes, and triangles.
//!
//! Files, in reading order: [`bounds`] (boxes, and lines that meet them), [`bounds_tree`] (queries over many
//! boxes), [`triangles`] (areas, normals and distances), [`morton_curve`] (positions along a curve that keeps
//! neighbours together).

pub(crate) mod bounds;
pub(crate) mod bounds_tree;
pub(crate) mod morton_curve;
pub(crate) mod triangles;
