//! Sewing of open edges that lie along each other but do not share vertices.
//!
//! 1. Open edges are collected by part.
//! 2. Corners on both sides of a seam that nearly coincide are joined.
//! 3. Each open edge is cut at the corners that lie on it, within tolerance or within the sagitta of the
//!    curve that both sides approximate.
//! 4. Faces are split into triangles around the opposite corner. Vertices do not move.
//!
//! Files, in reading order: [`open_edges`] (step 1), [`seam_search`] (steps 2 and 3), [`sagitta`], [`face_split`] (step 4).

pub(crate) mod face_split;
mod open_edges;
pub(crate) mod sagitta;
pub(crate) mod seam_search;
