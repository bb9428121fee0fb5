//! Tests of the program `ligne`, a file for each command or matter.

mod folder;

mod advice;
mod animate;
mod calls;
mod cases;
mod config;
mod contact_sheets;
mod diff;
mod diff_causes;
mod documentation;
mod documented_commands;
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
mod step;
mod step_file;
mod style_keys;
mod web;
