//! Slow and obvious references: rays through every triangle, textbook projection, exact contours.

pub mod contour_stops;
pub mod drawing_judge;
pub mod line_visibility;
pub mod polyhedron_contour;
pub mod polyhedron_lines;
pub mod ray_casts;
pub mod shadow_rays;
pub mod textbook_camera;
pub mod torus_contour;
pub mod triangle_intersections;
pub mod triangle_scene;
pub mod visible_points;
