//! Tests of the program `ligne`, a file for each command or matter.

mod commands;
mod compare;
mod documents;
mod draw;
mod folder;
mod options;
mod output;
