//! Numbers without meaning: tolerances, colours, intervals, deterministic functions.

pub mod colour;
pub mod function;
pub mod linear;
pub mod tolerance;
