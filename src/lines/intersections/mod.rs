//! Intersection lines: curves along which surfaces pass through each other.
//!
//! 1. Pairs of intersecting triangles are found in full for small meshes, or proposed by a buffer of visible
//!    faces.
//! 2. The segments of each pair are joined into curves (`mesh::intersect`).
//! 3. Curves along which curved surfaces merely touch are removed: their facets cross at a smaller angle than
//!    they turn.
//!
//! Files, in reading order: [`intersection_lines`]; [`facet_contacts`].

mod facet_contacts;
pub(crate) mod intersection_lines;
