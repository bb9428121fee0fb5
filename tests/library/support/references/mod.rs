//! Reference solutions by simple, slow methods that share no algorithm with the library.
//!
//! Reading order:
//!
//! 1. [`textbook_camera`]: projection by the textbook.
//! 2. [`triangle_scene`]: a scene as welded triangles with connected components.
//! 3. [`ray_casts`]: rays from the camera through every triangle of an image cell.
//! 4. [`triangle_intersections`], [`polyhedron_lines`]: the lines of a polyhedron that may be drawn.
//! 5. [`line_visibility`]: visibility along these lines, one ray per px.
//! 6. [`drawing_judge`]: shares of a drawing that are missing, hidden or misplaced.
//! 7. [`visible_points`]: whether other parts hide lines that the view map calls visible.
//! 8. [`torus_contour`]: the exact contour of a torus. [`polyhedron_contour`]: distances of smooth contours.
//! 9. [`contour_stops`]: whether each end of a visible contour has a reason.
//! 10. [`shadow_rays`]: cast shadows by rays.

pub(crate) mod contour_stops;
pub(crate) mod drawing_judge;
pub(crate) mod line_visibility;
pub(crate) mod polyhedron_contour;
pub(crate) mod polyhedron_lines;
pub(crate) mod ray_casts;
pub(crate) mod shadow_rays;
pub(crate) mod textbook_camera;
pub(crate) mod torus_contour;
pub(crate) mod triangle_intersections;
pub(crate) mod triangle_scene;
pub(crate) mod visible_points;
