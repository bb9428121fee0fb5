//! Edits of a scene before it is drawn: cut open, pulled apart or simplified.
//!
//! Folders: [`section`] cuts a scene by planes and closes the cut faces; [`explode`] moves parts apart along
//! their directions of assembly; [`simplify`] reduces the number of faces by edge collapses. File:
//! `tolerances`.

pub mod explode;
pub mod section;
pub mod simplify;
mod tolerances;
