//! The surface that a mesh stands for: creases, seams, fillets and rounded coordinates.

mod crease_chains;
mod creases;
mod cylinders;
mod evidence;
mod narrow_fillets;
mod part_bodies;
mod quantized_coordinates;
mod rounded_coordinates;
mod seams;
mod shallow_creases;
mod sliver_creases;
mod tiled_boxes;
mod touching_bodies;
