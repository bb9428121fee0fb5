//! Animations of a glTF file.
//!
//! Files: [`clip_reader`] reads animations as clips; [`animation_pointers`] resolves the targets of
//! KHR_animation_pointer.

mod animation_pointers;
pub(crate) mod clip_reader;
