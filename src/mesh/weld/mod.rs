//! Welding of nearby vertices, and removal of duplicate faces.
//!
//! 1. Vertices on open edges are joined within the weld tolerance of their part, by union-find over a hash
//!    grid.
//! 2. Faces of one part with the same three vertices are reduced to one.
//! 3. Where faces lie back to back, one side is chosen for the whole sheet, so that the sheet does not flip
//!    from face to face.
//!
//! Files, in reading order: [`nearby_vertices`] (step 1), [`duplicate_faces`] (step 2, and the `Cleaning`
//! counts), [`doubled_sheets`] (step 3).

mod doubled_sheets;
pub(crate) mod duplicate_faces;
pub(crate) mod nearby_vertices;
