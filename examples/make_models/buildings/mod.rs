//! Buildings and structures: [`castle`] with its [`castle_parts`], [`street`], [`trellis`], and [`rack`].

pub mod castle;
mod castle_parts;
pub mod rack;
pub mod street;
pub mod trellis;
