//! Tests of the program `ligne`, in folders by subject.

mod commands;
mod compare;
mod documents;
mod draw;
mod folder;
mod options;
mod output;
