//! Geometry of points in the plane.
//!
//! Files, in reading order: [`planar_distance`] lengths, nearest points of segments, and the best circle
//! through points; [`polylines`] bounding boxes, areas and lengths of polylines and rings; [`polyline_path`]
//! paths of straight sides; [`douglas_peucker`] the corners that a simplified polyline keeps (Douglas and
//! Peucker 1973); [`planar_grid`] a uniform grid over a rectangle; [`convex_hull`] the convex hull of points;
//! [`marching_squares`] the zero lines of a bilinear grid (Lorensen and Cline 1987, Nielson and Hamann 1991).

pub(crate) mod convex_hull;
pub(crate) mod douglas_peucker;
pub(crate) mod marching_squares;
pub(crate) mod planar_distance;
pub(crate) mod planar_grid;
pub(crate) mod polyline_path;
pub(crate) mod polylines;
