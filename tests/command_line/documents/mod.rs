//! Documents: links, examples, runnable commands, pictures, generated references, and plain language.

mod documented_commands;
mod language;
mod links_and_examples;
mod pictures;
mod reference;
