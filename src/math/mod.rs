//! Numbers without meaning: tolerances, colours, pictures, patterns of names, chance, deterministic functions.

pub mod colour;
pub mod colour_names;
#[cfg(test)]
#[path = "../../tests/library/support/dice.rs"]
pub mod dice;
pub mod factor;
pub mod function;
pub mod glob;
pub mod grain;
pub mod grouped;
pub(crate) mod hull;
pub mod identity;
pub mod joined;
pub mod level_lines;
pub mod linear;
pub mod noise;
pub mod oklab;
pub mod picture;
pub mod plane;
pub mod power;
pub mod ranks;
pub mod shades;
pub(crate) mod spare;
pub mod tolerance;
