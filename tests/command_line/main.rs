//! Tests of the program `ligne`, a file for each command or matter.

mod folder;

mod animate;
mod calls;
mod cases;
mod config;
mod diff;
mod diff_causes;
mod documentation;
mod draw;
mod dxf;
mod fmt;
mod framing;
mod heap;
mod hints;
mod info;
mod language;
mod left_out;
mod lod;
mod many;
mod pages;
mod pictures;
mod print;
mod reference;
mod sheets;
mod shorthand;
mod web;
