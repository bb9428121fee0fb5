//! [`with_tip`]: tip for unknown options that have the name of a style key.

use std::ffi::OsString;

use clap::builder::StyledStr;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Command, Error};

use crate::error::spelling::british;
use crate::style::StyleKey;
use crate::style::keys::advice::ending;

/// Adds a tip to the error about an unknown option, if a style key has its name and the command has `--set`.
pub(crate) fn with_tip(mut error: Error, words: &[OsString], program: &Command) -> Error {
    if error.kind() != ErrorKind::UnknownArgument || !takes_settings(words, program) {
        return error;
    }
    let Some(ContextValue::String(option)) = error.get(ContextKind::InvalidArg) else { return error };
    let Some(name) = option.strip_prefix("--") else { return error };
    let name = name.split('=').next().unwrap_or_default();
    let keys = ending(&british(&name.to_lowercase().replace('-', "_")), true);
    let keys: Vec<String> = keys.into_iter().filter(|key| StyleKey::find(key).is_some()).collect();
    if keys.is_empty() {
        return error;
    }
    let calls: Vec<String> = keys.iter().map(|key| format!("--set {key}=…")).collect();
    let tip = format!("'--{name}' is a key of the style: {}", calls.join(" or "));
    error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![StyledStr::from(tip)]));
    error
}

/// Whether the called command has `--set`. A call without a command draws.
fn takes_settings(words: &[OsString], program: &Command) -> bool {
    let called = words.iter().skip(1).find_map(|word| program.find_subcommand(word));
    called.is_none_or(|command| command.get_arguments().any(|option| option.get_long() == Some("set")))
}
