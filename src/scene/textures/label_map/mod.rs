//! A picture reduced to a few colours: one label per texel, and the borders between labels.
//!
//! 1. The picture is reduced until a texel is about as large as a pixel ([`painted_texture`]).
//! 2. Each texel gets its nearest and second nearest colour of the palette ([`soft_assignment`],
//!    [`texel_assignments`]).
//! 3. Texels that only blend two neighbouring colours lose a false third colour ([`blend_removal`]).
//! 4. A Gaussian blur of the assignments rounds the borders; the strongest colour wins ([`colour_labels`]).
//! 5. Regions smaller than a speck go to a neighbour ([`speck_removal`]).
//! 6. Borders between labels are traced and linked ([`label_borders`]); [`colour_map`] holds labels and
//!    borders.

mod blend_removal;
mod colour_labels;
pub(crate) mod colour_map;
mod label_borders;
pub(crate) mod painted_texture;
mod soft_assignment;
mod speck_removal;
pub(crate) mod texel_assignments;
