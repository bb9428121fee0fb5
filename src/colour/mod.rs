//! Colours, their names and spaces, and pictures of pixels.
//!
//! Files, in reading order: [`srgb`] a colour of eight bits a channel with opacity; [`css_names`] the colour
//! names of CSS; [`colour_factor`] a factor for each channel, as style sheets write it; [`oklab`] a
//! perceptually uniform space (Ottosson 2020); [`pixel_picture`] decoded PNG, JPEG and WebP files;
//! [`darkness_map`] the darkness of a picture as a summed-area table, and outlines of its dark parts.

pub(crate) mod colour_factor;
pub(crate) mod css_names;
pub(crate) mod darkness_map;
pub(crate) mod oklab;
pub(crate) mod pixel_picture;
pub(crate) mod srgb;
