//! Buffers of a view: they propose, exact geometry decides.

pub mod face_buffer;
pub mod painter;
pub mod screen;
pub mod strangers;

pub use face_buffer::FaceBuffer;
pub use screen::Screen;
