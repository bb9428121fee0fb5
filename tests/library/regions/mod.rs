//! Regions and fills: the colour of each point of the page, against rays, pictures and closed forms.

mod coplanar_surfaces;
mod cutouts;
mod glass;
mod gradients;
mod page_partition;
mod painted_surfaces;
mod picture_fills;
mod style_fills;
mod textured_surfaces;
mod textures;
