//! Triangles that show a part of an image, small or flat enough for one affine map each.
//!
//! 1. Faces that are nearest somewhere in the face buffer, or too small for it, count as visible.
//! 2. Their triangles are cut along the curves where other faces pass through them, so that a back-to-front
//!    order exists.
//! 3. In perspective they are halved until an affine map misses the true one by less than a tolerance.
//!
//! Files, in reading order: [`facet`] a triangle with image coordinates; [`visible_faces`] step 1;
//! [`face_crossings`] step 2; [`image_context`] the shared input; [`face_subdivision`] all steps.

pub(crate) mod face_crossings;
pub(crate) mod face_subdivision;
pub(crate) mod facet;
pub(crate) mod image_context;
pub(crate) mod visible_faces;
