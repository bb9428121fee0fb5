//! People and animals: [`bear`], [`goose`], [`brick`] (a brick and a man), and [`helmet`].

pub mod bear;
pub mod brick;
pub mod goose;
pub mod helmet;
