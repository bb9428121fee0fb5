//! Face normals, degenerate faces, and the dihedral angle at each edge.
//!
//! 1. A triangle has an area if its height exceeds rounding at the scale of its part.
//! 2. Narrow faces, whose normal is uncertain, take the normal of a wider coplanar neighbour (their
//!    carrier).
//! 3. Faces without area (needles) are skipped: the face on the far side of their long edge counts as the
//!    neighbour.
//! 4. The dihedral angle at an edge is the angle between the normals of its two faces.
//!
//! Files, in reading order: [`triangle_area`] (step 1), [`face_normals`], [`normal_carriers`] (step 2),
//! [`degenerate_faces`] (step 3), [`dihedral`] (step 4), [`dihedral_cosines`] (the cosine at every edge).

pub(crate) mod degenerate_faces;
pub(crate) mod dihedral;
pub(crate) mod dihedral_cosines;
pub(crate) mod face_normals;
pub(crate) mod normal_carriers;
pub(crate) mod triangle_area;
