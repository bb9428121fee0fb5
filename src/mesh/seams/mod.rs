//! Sewing of open edges that lie along each other but do not share vertices.
//!
//! 1. Open edges are collected by part.
//! 2. Corners on both sides of a seam that nearly coincide are joined.
//! 3. Each open edge is cut at the corners that lie on it, within tolerance or within the sagitta of the
//!    curve that both sides approximate.
//! 4. Faces are split into triangles around the opposite corner. Vertices do not move.
//!
//! Files, in reading order: [`open_edges`] (step 1), [`seam_search`] (steps 2 and 3), [`face_split`] (step 4),
//! [`point_tree`] (k-d tree that finds corners near a segment; Bentley 1975).

pub(crate) mod face_split;
mod open_edges;
mod point_tree;
pub(crate) mod seam_search;
