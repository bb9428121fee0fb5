//! `ligne animate`, `info` and `lod`, and the memory of the program.

mod animate_command;
mod heap;
mod info_command;
mod lod_command;
