//! Buffers of a view: they propose, exact geometry decides.

mod bands;
mod cell;
pub mod face_buffer;
mod hairlines;
pub mod maps;
pub mod painter;
pub mod screen;
pub mod strangers;

pub use face_buffer::FaceBuffer;
pub use maps::{Maps, NO_FRONT};
pub use screen::{Screen, ScreenPoint};
