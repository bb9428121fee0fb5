//! Zero sets: smooth curves through the faces of a mesh along which a field on its vertices vanishes.
//!
//! 1. A field on the smooth vertices (n·v, radial curvature, …) is linear inside each face.
//! 2. A face whose corners differ in sign has one straight piece. Neighbours share its end points.
//! 3. Pieces are joined into curves (`smooth_contours`) or thresholded by a measure (`interior`).
//!
//! Source: Hertzmann and Zorin, Illustrating smooth surfaces, SIGGRAPH 2000, section 4.
//!
//! Files, in reading order: [`zero_set`] the tracer; [`smooth_contours`]; [`interior`] suggestive contours,
//! ridges and valleys.

pub(crate) mod interior;
pub(crate) mod smooth_contours;
pub(crate) mod zero_set;
