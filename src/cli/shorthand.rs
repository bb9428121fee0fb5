//! Short form `ligne MODEL [OUT]... [OPTIONS]` of `ligne draw MODEL [OUT]... [OPTIONS]`.
//!
//! The first word decides:
//! - A command stays unchanged.
//! - A model is any other word that looks like a path: `-`, a word with a dot or slash, or an existing file.
//! - An option counts if `ligne draw` has it and the program does not.
//!
//! All other words go to the parser unchanged, which suggests the nearest command.

use std::ffi::{OsStr, OsString};
use std::path::Path;

use clap::Command;

use super::say;

/// Inserts `draw` before a model. Prints a note if a command hides a file of the same name.
pub(crate) fn expanded(mut words: Vec<OsString>, program: &Command) -> Vec<OsString> {
    let is_global = |word: &OsString| word == "--no-config";
    let Some(at) = words.iter().skip(1).position(|word| !is_global(word)).map(|at| at + 1) else {
        return words;
    };
    let Some(first) = words.get(at) else { return words };
    if is_command(program, first) {
        if Path::new(first).is_file() {
            let name = first.to_string_lossy();
            say(&format!("note: `{name}` is a command here; write ./{name} for the file"));
        }
        return words;
    }
    if is_path(first) || is_option_of_draw(program, first) {
        words.insert(at, OsString::from("draw"));
    }
    words
}

fn is_command(program: &Command, word: &OsStr) -> bool {
    word == "help" || program.find_subcommand(word).is_some()
}

/// Whether a word must be a path, because no command has such a name.
fn is_path(word: &OsStr) -> bool {
    let text = word.to_string_lossy();
    let is_option = text.starts_with('-') && text != "-";
    !is_option && (text == "-" || text.contains(['.', '/', '\\']) || Path::new(word).is_file())
}

/// Whether a word is an option of `ligne draw` but not of the program.
fn is_option_of_draw(program: &Command, word: &OsStr) -> bool {
    let text = word.to_string_lossy();
    let has = |command: &Command| {
        command.get_arguments().any(|option| {
            let long = text.strip_prefix("--").map(|name| name.split('=').next().unwrap_or(name));
            let is_short = option.get_short().is_some_and(|short| text == format!("-{short}"));
            is_short || long.is_some_and(|name| option.get_long() == Some(name))
        })
    };
    program.find_subcommand("draw").is_some_and(has) && !has(program)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn expanded_line(line: &str) -> String {
        let words = std::iter::once("ligne").chain(line.split_whitespace()).map(OsString::from).collect();
        let words = expanded(words, &super::super::program());
        let words: Vec<_> = words.iter().skip(1).map(|word| word.to_string_lossy()).collect();
        words.join(" ")
    }

    #[test]
    fn shorthand_inserts_draw_before_models_and_keeps_commands() {
        for (line, expected) in [
            ("gear.obj", "draw gear.obj"),
            ("gear.obj a.svg b.png --style toon", "draw gear.obj a.svg b.png --style toon"),
            ("--no-config gear.obj", "--no-config draw gear.obj"),
            ("--style toon gear.obj", "draw --style toon gear.obj"),
            ("--view=iso gear.obj", "draw --view=iso gear.obj"),
            ("- --input-format obj", "draw - --input-format obj"),
            ("models/gear", "draw models/gear"),
            ("draw gear.obj", "draw gear.obj"),
            ("info gear.obj", "info gear.obj"),
            ("help draw", "help draw"),
            ("drow gear.obj", "drow gear.obj"),
            ("--help", "--help"),
            ("-h", "-h"),
            ("--version", "--version"),
            ("--hidden gear.obj", "--hidden gear.obj"),
            ("", ""),
        ] {
            assert_eq!(expanded_line(line), expected);
        }
    }
}
