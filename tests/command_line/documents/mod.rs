//! Documents: links, examples, commands that run, pictures, generated pages, and plain words.

mod documented_commands;
mod language;
mod links_and_examples;
mod pictures;
mod reference;
