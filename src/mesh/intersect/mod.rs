//! Curves along which triangles of a mesh pass through each other.
//!
//! 1. A box tree proposes pairs of triangles.
//! 2. Exact predicates decide whether two triangles cross, and where (after Möller 1997).
//! 3. Ends of segments are joined if they have a name in common, such as "this edge through that face".
//!    Positions are never compared.
//! 4. For a refined mesh, known pairs are reused and only the pieces of cut faces are tested.
//!
//! Files, in reading order: [`triangle_pair`] (step 2), [`intersection_curves`] (steps 1 and 3),
//! [`curve_tracer`] (follows a curve from given pairs), [`cache`] (step 4).

pub(crate) mod cache;
pub(crate) mod curve_tracer;
pub(crate) mod intersection_curves;
pub(crate) mod triangle_pair;
