//! Edge tests: which pixels of the normal and depth maps are edges.
//!
//! - Gradient test: where gradients change within 3 × 3 pixels (Scheelk, Non-Photorealistic Rendering,
//!   section 3.4).
//! - Opposite test: where pixels on opposite sides differ (Ishaya, Real-Time Cartoon Rendering, listing 4).
//!
//! Both return one flag per pixel, row by row.
//!
//! Files, in reading order: [`gradient_test`]; [`opposite_test`]; [`pixel_neighbours`] the 3 × 3 pixels
//! around one.

pub(crate) mod gradient_test;
pub(crate) mod opposite_test;
mod pixel_neighbours;
