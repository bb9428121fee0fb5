//! Command-line reference as Markdown, generated from the definitions of the parser.
//!
//! Each command gets its usage, its examples and a table of its options. Options that several commands share
//! with `ligne draw` are listed once, in a separate section. The test `the_reference_is_current` compares the
//! result with `docs/reference/command-line.md`.

use std::fmt::Write;

use clap::{Arg, ArgAction, Args, Command};

use super::conventions::{EXIT_STATUS, FILES, environment};
use crate::cli::SHARING_COMMANDS;
use crate::cli::options::draw_args::HowArgs;

const INTRODUCTION: &str = "\
# Command line

This page is generated from the program with `ligne man --markdown`. `ligne COMMAND --help` prints the same options, and
`ligne man COMMAND` prints a manual page.

`ligne MODEL` is short for `ligne draw MODEL`. Options may stand before or after file names. An option marked *repeatable* may be
given several times. GLOB is a name pattern: `*` matches any characters and `?` one character. Upper and lower case differ.
";

const SHARED_TEXT: &str = "\
`draw`, `animate` and `diff` take these options. Their long names are also the keys of [ligne.toml](config.md) and of
[case files](case-file.md).
";

const EXIT_TEXT: &str = "\
Errors and warnings go to standard error. After an error nothing is written, and existing files stay unchanged.
";

/// Reference of the program.
pub(crate) fn markdown(program: &Command) -> String {
    let drawing = HowArgs::augment_args(Command::new("draw"));
    let is_shared = |command: &Command, option: &Arg| {
        let is_known = drawing.get_arguments().any(|other| other.get_id() == option.get_id());
        let is_own = command.get_name() == "styles" && option.get_id() == "style";
        is_known
            && !is_own
            && (command.get_name() == "draw" || SHARING_COMMANDS.contains(&command.get_name()))
    };
    let mut text = INTRODUCTION.to_owned();
    text.push_str("\n| Command | Purpose |\n| --- | --- |\n");
    let commands = || program.get_subcommands().filter(|command| command.get_name() != "help");
    for command in commands() {
        let (name, about) = (command.get_name(), about(command));
        // Writing to a string cannot fail.
        let _ = writeln!(text, "| [{name}](#ligne-{name}) | {about} |");
    }
    text.push_str("\nOptions of every command: `--no-config` (ignore ligne.toml), `-h`, `--help`. `ligne --version` prints the version.\n");
    for command in commands() {
        section(&mut text, command, &is_shared);
    }
    let _ = write!(text, "\n## Shared options\n\n{SHARED_TEXT}");
    tables(&mut text, drawing.get_arguments());
    text.push_str("\n## Environment\n\nAn option wins over a variable. An empty variable counts as unset.\n\n| Variable | Effect |\n| --- | --- |\n");
    for (name, effect) in environment(|_| true) {
        let names: Vec<String> = name.split(", ").map(|name| format!("`{name}`")).collect();
        let _ = writeln!(text, "| {} | {} |", names.join(", "), cell(effect));
    }
    text.push_str("\n## Files\n");
    for paragraph in FILES {
        let _ = write!(text, "\n{paragraph}\n");
    }
    let _ = write!(text, "\n## Exit status\n\n{EXIT_TEXT}\n| Status | Meaning |\n| --- | --- |\n");
    for (status, meaning) in EXIT_STATUS {
        let _ = writeln!(text, "| {status} | {} |", cell(meaning));
    }
    text
}

fn about(command: &Command) -> String {
    command.get_about().map(ToString::to_string).unwrap_or_default()
}

fn section(text: &mut String, command: &Command, is_shared: &impl Fn(&Command, &Arg) -> bool) {
    let name = command.get_name();
    let usage = command.clone().render_usage().to_string();
    let usage: Vec<&str> = usage.trim_start_matches("Usage: ").lines().map(str::trim).collect();
    let _ = write!(text, "\n## ligne {name}\n\n{}.\n\n```text\n{}\n```\n", about(command), usage.join("\n"));
    let own: Vec<&Arg> = command.get_arguments().filter(|option| !is_shared(command, option)).collect();
    tables(text, own.iter().copied());
    if own.len() < command.get_arguments().count() {
        text.push_str("\nAlso takes the [shared options](#shared-options).\n");
    }
    let examples = command.get_after_help().map(ToString::to_string).unwrap_or_default();
    if let Some((_, examples)) = examples.split_once('\n') {
        let lines: Vec<&str> = examples.lines().map(|line| line.strip_prefix("  ").unwrap_or(line)).collect();
        let _ = write!(text, "\n```text\n{}\n```\n", lines.join("\n"));
    }
}

/// A table for each heading, in order of first occurrence.
fn tables<'a>(text: &mut String, options: impl Iterator<Item = &'a Arg>) {
    let is_listed = |option: &&Arg| !option.is_hide_set() && !is_global(option);
    let options: Vec<&Arg> = options.filter(is_listed).collect();
    let mut headings: Vec<&str> = Vec::new();
    for option in &options {
        let heading = heading(option);
        if !headings.contains(&heading) {
            headings.push(heading);
        }
    }
    for wanted in headings {
        let _ = write!(text, "\n| {wanted} | Meaning |\n| --- | --- |\n");
        for option in options.iter().filter(|option| heading(option) == wanted) {
            let _ = writeln!(text, "| {} | {} |", term(option), meaning(option));
        }
    }
}

fn is_global(option: &Arg) -> bool {
    matches!(option.get_long(), Some("help" | "no-config" | "version"))
}

fn heading(option: &Arg) -> &str {
    let default = if option.is_positional() { "Argument" } else { "Option" };
    option.get_help_heading().unwrap_or(default)
}

/// An option with its value, as typed.
fn term(option: &Arg) -> String {
    let names = option.get_value_names().unwrap_or_default();
    let value: Vec<&str> = names.iter().map(|name| name.as_str()).collect();
    let value = value.join(" ");
    if option.is_positional() {
        return format!("`{}`", cell(&value));
    }
    let long = option.get_long().unwrap_or_default();
    let short = option.get_short().map_or_else(String::new, |short| format!("`-{short}`, "));
    let takes_value = matches!(option.get_action(), ArgAction::Set | ArgAction::Append);
    let value = if takes_value { format!(" {value}") } else { String::new() };
    format!("{short}`--{long}{}`", cell(&value))
}

fn meaning(option: &Arg) -> String {
    let mut text = option.get_help().map(ToString::to_string).unwrap_or_default();
    let values: Vec<String> = option
        .get_possible_values()
        .iter()
        .filter(|_| {
            !option.is_hide_possible_values_set() && !matches!(option.get_action(), ArgAction::SetTrue)
        })
        .map(|value| value.get_name().to_owned())
        .collect();
    if !values.is_empty() {
        let _ = write!(text, " [values: {}]", values.join(", "));
    }
    let defaults: Vec<String> = option
        .get_default_values()
        .iter()
        .filter(|_| !option.is_hide_default_value_set() && !matches!(option.get_action(), ArgAction::SetTrue))
        .map(|value| value.to_string_lossy().into_owned())
        .collect();
    if !defaults.is_empty() {
        let _ = write!(text, " [default: {}]", defaults.join(", "));
    }
    if let Some([first, ..]) = option.get_visible_aliases().as_deref() {
        let _ = write!(text, " [alias: --{first}]");
    }
    cell(&text)
}

/// Escapes text for a table cell.
fn cell(text: &str) -> String {
    text.replace('|', "\\|").replace('*', "\\*").replace('<', "&lt;")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Maximum number of words on the page.
    const MAX_WORDS: usize = 5000;

    fn page() -> String {
        let mut program = crate::cli::program();
        program.build();
        markdown(&program)
    }

    #[test]
    fn shared_options_are_listed_once_and_hidden_ones_never() {
        let page = page();
        for option in ["`--style ", "`--azimuth ", "`--strict`"] {
            let count = page.lines().filter(|line| line.starts_with(&format!("| {option}"))).count();
            // `ligne page` has a different `--strict`, and `ligne styles` a different `--style`.
            assert!(count == 1 || (!option.contains("azimuth") && count == 2), "{option}: {count}");
        }
        for alias in ["--current-color", "--report-all"] {
            assert!(!page.contains(alias), "{alias}");
        }
        let words = page.split_whitespace().filter(|word| word.contains(char::is_alphabetic)).count();
        assert!(words <= MAX_WORDS, "{words} words");
    }
}
