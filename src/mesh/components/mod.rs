//! Connected surfaces, their orientation, and bodies made of several parts.
//!
//! 1. Faces are grouped into connected surfaces by [`DisjointSets`](crate::geometry::lists::disjoint_sets::DisjointSets).
//! 2. Windings within a surface are made consistent by union-find with parity.
//! 3. Closed surfaces are turned outward by their volume; open ones by the volume of a cone over their
//!    border.
//! 4. Parts whose surfaces continue in each other form one body, which shares tolerances and classification.
//!
//! Files, in reading order: [`orientation`] (steps 1 to 3), `parity_union_find`
//! (step 2), [`bodies`] (step 4), [`solid_parts`] (parts whose inside is never visible).

pub(crate) mod bodies;
pub(crate) mod orientation;
mod parity_union_find;
pub(crate) mod solid_parts;
