//! Subdivision of curved faces where a view needs it.
//!
//! 1. Edges of curved surfaces whose arc deviates too far from the chord are marked.
//! 2. Edges of thin walls, where the arcs of both sides would swell the wall, stay straight.
//! 3. Marked edges are split at the middle of their arc, and faces by the pattern of their split edges. The
//!    decision depends on the edge alone, so that no cracks open.
//! 4. Kept faces and new pieces are spliced into one mesh.
//!
//! Source for arcs: Vlachos, Peters, Boyd and Mitchell, "Curved PN triangles", I3D 2001.
//!
//! Files, in reading order: [`edge_arc`], [`subdivision`] (step 3), [`face_pieces`], [`edge_marks`] (step
//! 1), [`wall_thickness`] (step 2), [`mesh_splice`] (step 4).

pub(crate) mod edge_arc;
pub(crate) mod edge_marks;
mod face_pieces;
pub(crate) mod mesh_splice;
pub(crate) mod subdivision;
mod wall_thickness;
