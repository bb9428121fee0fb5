//! Completes the words of a call with environment variables and `ligne.toml`.
//!
//! Precedence: option, environment variable, file, built-in default.

use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};

use clap::parser::ValueSource;
use clap::{ArgMatches, Command};

use super::project_config::ProjectConfig;
use super::toml_options::{ConfiguredOption, drop_overridden, option_fault, word};
use crate::error::Error;
use crate::style::Style;

/// Environment variables and the options that they set, in every command with that option.
pub(crate) const VARIABLES: [(&str, &str); 3] =
    [("LIGNE_STYLE", "style"), ("LIGNE_THREADS", "threads"), ("LIGNE_STEP_CONVERTER", "step-converter")];

/// Environment of a call.
#[derive(Debug, Default)]
pub(crate) struct CallEnvironment {
    /// The working folder.
    pub(crate) folder: Option<PathBuf>,
    /// Values of [`VARIABLES`].
    pub(crate) variables: [Option<String>; VARIABLES.len()],
    /// Whether the call runs in continuous integration (`CI` is set).
    pub(crate) is_ci: bool,
}

impl CallEnvironment {
    /// Environment of this process.
    pub(crate) fn of_process() -> Self {
        let value = |(name, _)| std::env::var_os(name).map(|value| value.to_string_lossy().into_owned());
        Self {
            folder: std::env::current_dir().ok(),
            variables: VARIABLES.map(value),
            is_ci: std::env::var_os("CI").is_some_and(|value| !value.is_empty()),
        }
    }
}

/// Inserts the options from variables and the file after the command name.
///
/// # Errors
/// If a variable or the file is wrong. A wrong call is returned unchanged, for the parser to report.
pub(crate) fn complete(
    mut words: Vec<OsString>,
    program: &Command,
    surroundings: &CallEnvironment,
) -> Result<Vec<OsString>, Error> {
    let lenient = program.clone().ignore_errors(true).try_get_matches_from(&words);
    let Some((name, matches)) = lenient.as_ref().ok().and_then(ArgMatches::subcommand) else {
        return Ok(words);
    };
    let mut program = program.clone();
    program.build();
    let Some(command) = program.find_subcommand(name) else { return Ok(words) };
    let mut known: Vec<String> = command
        .get_arguments()
        .filter(|option| matches.value_source(option.get_id().as_str()) == Some(ValueSource::CommandLine))
        .filter_map(|option| option.get_long().map(ToOwned::to_owned))
        .collect();

    // Drawing options of `ligne styles` apply to its sheet only, which shows all styles unless some are
    // typed.
    let mut variables = if name == "styles" { Vec::new() } else { of_variables(command, surroundings) };
    drop_overridden(command, &mut variables, &known);
    known.extend(variables.iter().map(|given| given.option.clone()));
    check(command, &variables)?;

    let mut configured = Vec::new();
    if !known.iter().any(|option| option == "no-config") {
        configured = of_file(name, surroundings.folder.as_deref())?;
        drop_overridden(command, &mut configured, &known);
    }
    let added = configured.into_iter().chain(variables).flat_map(|given| given.words).map(OsString::from);
    // Only switches can precede the command name.
    if let Some(at) = words.iter().skip(1).position(|word| word == OsStr::new(name)) {
        words.splice(at + 2..at + 2, added);
    }
    Ok(words)
}

/// Options that variables set for a command. Empty variables are ignored.
fn of_variables(command: &Command, surroundings: &CallEnvironment) -> Vec<ConfiguredOption> {
    let pairs = VARIABLES.iter().zip(&surroundings.variables);
    let said = pairs.filter_map(|((_, option), value)| Some((*option, value.as_deref()?)));
    let has = |option: &str| command.get_arguments().any(|known| known.get_long() == Some(option));
    said.filter(|(option, value)| !value.is_empty() && has(option))
        .map(|(option, value)| ConfiguredOption {
            option: option.to_owned(),
            words: vec![word(option, Some(value))],
            span: 0..value.len(),
        })
        .collect()
}

/// Refuses values of variables that the option would refuse.
fn check(command: &Command, variables: &[ConfiguredOption]) -> Result<(), Error> {
    for given in variables {
        let name = VARIABLES.iter().find(|(_, option)| *option == given.option).map_or("", |(name, _)| name);
        let value = given.words.first().and_then(|word| word.split_once('=')).map(|(_, value)| value);
        if let Some((message, advice)) = option_fault(command, &given.option, value) {
            let error = Error::new(message).at(name);
            return Err(match advice {
                Some(advice) => error.remedy(advice),
                None => error,
            });
        }
        if given.option == "style" {
            Style::load(value.unwrap_or_default()).map_err(|error| match error.place {
                Some(_) => error,
                None => error.at(name),
            })?;
        }
    }
    Ok(())
}

/// Options that the file sets for a command.
fn of_file(command: &str, folder: Option<&Path>) -> Result<Vec<ConfiguredOption>, Error> {
    let find = || folder.map_or(Ok(None), ProjectConfig::find);
    Ok(match command {
        "draw" => find()?.map(|config| config.draw),
        // Each frame has its own time.
        "animate" => {
            find()?.map(|config| config.draw.into_iter().filter(|given| given.option != "time").collect())
        }
        "diff" => find()?.map(ProjectConfig::diff),
        // STEP options apply to all commands that read models. These commands use no other keys, so they
        // ignore errors in the file.
        "page" | "info" | "lod" => find().unwrap_or_default().map(|config| {
            config.draw.into_iter().filter(|given| given.option.starts_with("step-")).collect()
        }),
        _ => None,
    }
    .unwrap_or_default())
}
