//! What was typed, completed by environment variables and by `ligne.toml`.
//!
//! A flag wins over a variable, a variable over the file, and the file over what is built in.

use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};

use clap::parser::ValueSource;
use clap::{ArgMatches, Command};

use super::project_config::Config;
use super::toml_options::{Given, displace, fault_of, word};
use crate::error::Error;
use crate::style::Style;

/// Variables that stand for options, in every command that has the option.
pub(crate) const VARIABLES: [(&str, &str); 3] =
    [("LIGNE_STYLE", "style"), ("LIGNE_THREADS", "threads"), ("LIGNE_STEP_CONVERTER", "step-converter")];

/// What surrounds a call.
#[derive(Debug, Default)]
pub(crate) struct Surroundings {
    /// The working folder.
    pub(crate) folder: Option<PathBuf>,
    /// The values of [`VARIABLES`].
    pub(crate) variables: [Option<String>; VARIABLES.len()],
    /// Whether no person is at work, but a machine that checks what people did.
    pub(crate) is_ci: bool,
}

impl Surroundings {
    /// Those of this process.
    pub(crate) fn of_process() -> Self {
        let value = |(name, _)| std::env::var_os(name).map(|value| value.to_string_lossy().into_owned());
        Self {
            folder: std::env::current_dir().ok(),
            variables: VARIABLES.map(value),
            is_ci: std::env::var_os("CI").is_some_and(|value| !value.is_empty()),
        }
    }
}

/// The words of a call with those that variables and the file add, just behind the command's name.
///
/// # Errors
/// Where a variable or the file is wrong. Where the call itself is wrong it is left as it is, for
/// the parser to say so.
pub(crate) fn complete(
    mut words: Vec<OsString>,
    program: &Command,
    surroundings: &Surroundings,
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

    // Options of `ligne styles` are of its sheet only, which shows all styles unless some are typed.
    let mut variables = if name == "styles" { Vec::new() } else { of_variables(command, surroundings) };
    displace(command, &mut variables, &known);
    known.extend(variables.iter().map(|given| given.option.clone()));
    check(command, &variables)?;

    let mut configured = Vec::new();
    if !known.iter().any(|option| option == "no-config") {
        configured = of_file(name, surroundings.folder.as_deref())?;
        displace(command, &mut configured, &known);
    }
    let added = configured.into_iter().chain(variables).flat_map(|given| given.words).map(OsString::from);
    // Nothing but switches stands before the name of the command.
    if let Some(at) = words.iter().skip(1).position(|word| word == OsStr::new(name)) {
        words.splice(at + 2..at + 2, added);
    }
    Ok(words)
}

/// What variables say to a command; an empty one says nothing.
fn of_variables(command: &Command, surroundings: &Surroundings) -> Vec<Given> {
    let pairs = VARIABLES.iter().zip(&surroundings.variables);
    let said = pairs.filter_map(|((_, option), value)| Some((*option, value.as_deref()?)));
    let has = |option: &str| command.get_arguments().any(|known| known.get_long() == Some(option));
    said.filter(|(option, value)| !value.is_empty() && has(option))
        .map(|(option, value)| Given {
            option: option.to_owned(),
            words: vec![word(option, Some(value))],
            span: 0..value.len(),
        })
        .collect()
}

/// Refuses variables that would be refused as options.
fn check(command: &Command, variables: &[Given]) -> Result<(), Error> {
    for given in variables {
        let name = VARIABLES.iter().find(|(_, option)| *option == given.option).map_or("", |(name, _)| name);
        let value = given.words.first().and_then(|word| word.split_once('=')).map(|(_, value)| value);
        if let Some((message, advice)) = fault_of(command, &given.option, value) {
            let error = Error::new(message).at(name);
            return Err(match advice {
                Some(advice) => error.remedy(advice),
                None => error,
            });
        }
        if given.option == "style" {
            Style::load(value.unwrap_or_default(), &[]).map_err(|error| match error.place {
                Some(_) => error,
                None => error.at(name),
            })?;
        }
    }
    Ok(())
}

/// What the file says to a command.
fn of_file(command: &str, folder: Option<&Path>) -> Result<Vec<Given>, Error> {
    let find = || folder.map_or(Ok(None), Config::find);
    Ok(match command {
        "draw" => find()?.map(|config| config.draw),
        // Frames have times of their own.
        "animate" => {
            find()?.map(|config| config.draw.into_iter().filter(|given| given.option != "time").collect())
        }
        "diff" => find()?.map(Config::diff),
        // How STEP models are read is the same in all commands. These read nothing else from the file, and stand other faults in it.
        "page" | "info" | "lod" => find().unwrap_or_default().map(|config| {
            config.draw.into_iter().filter(|given| given.option.starts_with("step-")).collect()
        }),
        _ => None,
    }
    .unwrap_or_default())
}
