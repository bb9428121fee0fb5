//! Tests of the program `ligne`, a file for each command or matter.

mod folder;

mod animate;
mod calls;
mod cases;
mod config;
mod diff;
mod documentation;
mod draw;
mod fmt;
mod lod;
mod pictures;
mod web;
