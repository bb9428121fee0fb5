//! Geometry of points in the plane.
//!
//! Files, in reading order: [`planar_distance`] lengths, distances to segments and the best circle through
//! points; [`convex_hull`] the convex hull of points; [`marching_squares`] the zero lines of a bilinear grid
//! (Lorensen and Cline 1987, Nielson and Hamann 1991).

pub(crate) mod convex_hull;
pub(crate) mod marching_squares;
pub(crate) mod planar_distance;
