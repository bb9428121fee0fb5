//! Feature lines: each kind against closed forms, the formulas of its paper, or brute force.

mod image_lines;
mod inner_lines;
mod intersections;
mod isophote_lines;
mod joints;
mod marked_edges;
mod pairwise_intersections;
mod polygon_diagonals;
mod silhouettes;
mod visible_intersections;
