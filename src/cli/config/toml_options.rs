//! Options of a command as keys of a TOML table, converted to words of a call.
//!
//! A key is the long name of an option. Its words are parsed like typed words, so a file and the command line
//! accept the same values.

use std::ops::Range;
use std::path::{Path, PathBuf};

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Arg, ArgAction, Command};
use toml::de::{DeTable, DeValue};
use toml::{Spanned, Table};

use crate::error::Error;
use crate::error::nearest::{nearest, suggestion};
use crate::error::spelling::british;
use crate::style::{self, Style, sheet_errors};

/// Options that need another option, with that option.
const REQUIRED_OPTIONS: [(&str, &str); 2] = [("landscape", "page"), ("scale", "page")];

/// TOML file whose keys are options.
#[derive(Debug, Clone)]
pub(crate) struct TomlFile {
    /// Path of the file in errors.
    pub(crate) path: PathBuf,
    /// Folder that relative paths in the file start from.
    pub(crate) folder: PathBuf,
    pub(crate) text: String,
}

impl TomlFile {
    /// Reads a file. `what` names it in errors.
    pub(crate) fn read(path: &Path, what: &str) -> Result<Self, Error> {
        let bytes = std::fs::read(path).map_err(|error| {
            Error::io(format!("cannot read {what}"), error).in_file(path).remedy("check the path")
        })?;
        let text = Error::utf8_text(bytes, path, what)?;
        let folder = path.parent().unwrap_or(Path::new("")).to_path_buf();
        Ok(Self { path: path.to_path_buf(), folder, text })
    }

    /// The keys and values with their positions in the text.
    pub(crate) fn table(&self) -> Result<DeTable<'_>, Error> {
        let parsed = DeTable::parse(&self.text).map(Spanned::into_inner);
        parsed.map_err(|error| sheet_errors::in_sheet(&self.text, &error.into()).in_file(&self.path))
    }

    /// The keys and values without positions.
    pub(crate) fn values(&self) -> Result<Table, Error> {
        toml::from_str(&self.text)
            .map_err(|error| sheet_errors::in_sheet(&self.text, &error.into()).in_file(&self.path))
    }

    /// Error at a position of the file.
    pub(crate) fn fault(&self, span: &Range<usize>, message: &str, advice: Option<&str>) -> Error {
        sheet_errors::at_span(&self.text, span, message, advice).in_file(&self.path)
    }

    /// Error about an unknown key.
    pub(crate) fn unknown(&self, key: &Spanned<impl AsRef<str>>, known: &[&str]) -> Error {
        let word = key.get_ref().as_ref();
        let advice = suggestion(nearest(word, known), || format!("known keys: {}", known.join(", ")));
        self.fault(&key.span(), &format!("unknown key `{word}`"), Some(&advice))
    }

    /// Error about a value of the wrong type.
    pub(crate) fn misfit(&self, value: &Spanned<DeValue<'_>>, wanted: &str) -> Error {
        let found = match value.get_ref() {
            DeValue::String(_) => "text",
            DeValue::Integer(_) | DeValue::Float(_) => "a number",
            DeValue::Boolean(_) => "true or false",
            DeValue::Datetime(_) => "a date",
            DeValue::Array(_) => "a list",
            DeValue::Table(_) => "a table",
        };
        self.fault(&value.span(), &format!("{found} does not fit here"), Some(&format!("write {wanted}")))
    }

    /// Moves an error to a position of this file.
    pub(crate) fn with_position(&self, error: &Error, span: &Range<usize>) -> Error {
        let message = match &error.file {
            Some(file) => format!("{}: {}", file.display(), error.message),
            None => error.message.clone(),
        };
        // Further lines of a remedy may show an excerpt of another file.
        let advice = error.remedy.as_deref().and_then(|remedy| remedy.lines().next());
        self.fault(span, &message, advice)
    }
}

/// Option that was set by a file or variable.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ConfiguredOption {
    /// Long name of the option.
    pub(crate) option: String,
    /// Equivalent words of a call.
    pub(crate) words: Vec<String>,
    /// Position of the value in the file.
    pub(crate) span: Range<usize>,
}

/// Keys that a table may hold.
pub(crate) struct OptionKeys<'a> {
    /// Command with the options.
    pub(crate) command: &'a Command,
    /// Options that are excluded.
    pub(crate) without: &'a [&'a str],
    /// Additional keys that the caller reads.
    pub(crate) others: &'a [&'a str],
}

impl OptionKeys<'_> {
    /// Reads a table. `table` has positions, and `values` the same entries without positions.
    pub(crate) fn read(
        &self,
        file: &TomlFile,
        table: &DeTable<'_>,
        values: &Table,
    ) -> Result<Vec<ConfiguredOption>, Error> {
        let mut given = Vec::new();
        for (key, value) in table {
            let name = key.get_ref().as_ref();
            if self.others.contains(&name) {
                continue;
            }
            let is_called = |option: &&Arg, name: &str| {
                let aliases = option.get_all_aliases().unwrap_or_default();
                option.get_long() == Some(name) || aliases.contains(&name)
            };
            let spelt = british(name);
            let option = self.options().find(|option| is_called(option, name) || is_called(option, &spelt));
            let Some(option) = option else {
                return Err(file.unknown(key, &self.names()));
            };
            let (written, name) = (name, option.get_long().unwrap_or(name));
            let values = texts(file, option, name, value, values.get(written))?;
            let mut words = Vec::new();
            for (text, span) in values {
                let text = resolve_paths(file, name, text, &span)?;
                if let Some((message, advice)) = option_fault(self.command, name, text.as_deref()) {
                    return Err(file.fault(&span, &message, advice.as_deref()));
                }
                words.push(word(name, text.as_deref()));
            }
            given.push(ConfiguredOption { option: name.to_owned(), words, span: value.span() });
        }
        // The parser returns keys in alphabetical order.
        given.sort_by_key(|given: &ConfiguredOption| given.span.start);
        self.refuse_contradictions(file, &given)?;
        Ok(given)
    }

    fn options(&self) -> impl Iterator<Item = &Arg> {
        let is_key = |option: &&Arg| {
            option.get_long().is_some_and(|name| !self.without.contains(&name))
                && matches!(option.get_action(), ArgAction::Set | ArgAction::SetTrue | ArgAction::Append)
        };
        self.command.get_arguments().filter(is_key)
    }

    fn names(&self) -> Vec<&str> {
        self.options().filter_map(Arg::get_long).chain(self.others.iter().copied()).collect()
    }

    fn refuse_contradictions(&self, file: &TomlFile, given: &[ConfiguredOption]) -> Result<(), Error> {
        for (i, later) in given.iter().enumerate() {
            let earlier = given.iter().take(i);
            let mut both_say_something = earlier.filter(|g| !g.words.is_empty() && !later.words.is_empty());
            if let Some(earlier) =
                both_say_something.find(|g| conflict(self.command, &g.option, &later.option))
            {
                let message = format!("`{}` and `{}` exclude each other", earlier.option, later.option);
                return Err(file.fault(&later.span, &message, Some("leave one out")));
            }
        }
        Ok(())
    }
}

/// Refuses options whose required option is missing.
pub(crate) fn refuse_incomplete(file: &TomlFile, given: &[ConfiguredOption]) -> Result<(), Error> {
    for ConfiguredOption { option, words, span } in given {
        let mut needs =
            REQUIRED_OPTIONS.iter().filter(|(needing, _)| needing == option).map(|(_, needed)| *needed);
        if let Some(missing) = needs.find(|needed| given.iter().all(|other| other.option != *needed))
            && !words.is_empty()
        {
            let message = format!("`{option}` means nothing without `{missing}`");
            return Err(file.fault(span, &message, Some("give both, or leave it out")));
        }
    }
    Ok(())
}

/// Removes options that typed options override: the same option, except `set`, which accumulates, and
/// conflicting options. Also removes options whose required option is then missing.
pub(crate) fn drop_overridden(command: &Command, given: &mut Vec<ConfiguredOption>, typed: &[String]) {
    given
        .retain(|g| typed.iter().all(|t| (*t != g.option || t == "set") && !conflict(command, t, &g.option)));
    let left: Vec<String> = given.iter().filter(|g| !g.words.is_empty()).map(|g| g.option.clone()).collect();
    given.retain(|g| {
        let mut needs =
            REQUIRED_OPTIONS.iter().filter(|(option, _)| *option == g.option).map(|(_, needed)| *needed);
        needs.all(|needed| typed.iter().chain(&left).any(|other| other == needed))
    });
}

/// Whether two options of a command exclude each other.
fn conflict(command: &Command, a: &str, b: &str) -> bool {
    let find = |name: &str| command.get_arguments().find(|option| option.get_long() == Some(name));
    let (Some(a), Some(b)) = (find(a), find(b)) else { return false };
    let excludes = |one: &Arg, other: &Arg| {
        command.get_arg_conflicts_with(one).iter().any(|excluded| excluded.get_id() == other.get_id())
    };
    excludes(a, b) || excludes(b, a)
}

/// Option as a word of a call.
pub(crate) fn word(option: &str, value: Option<&str>) -> String {
    value.map_or_else(|| format!("--{option}"), |value| format!("--{option}={value}"))
}

/// Checks the value of an option with the parser. Returns a message and advice; none if the value is valid.
pub(crate) fn option_fault(
    command: &Command,
    option: &str,
    value: Option<&str>,
) -> Option<(String, Option<String>)> {
    let words = [command.get_name().to_owned(), word(option, value)];
    let error = command.clone().try_get_matches_from(words).err()?;
    let shown = value.unwrap_or_default();
    match error.kind() {
        ErrorKind::ValueValidation => {
            let advice = std::error::Error::source(&error).map(|source| plain_advice(&source.to_string()));
            Some((format!("`{shown}` does not fit here"), advice))
        }
        ErrorKind::InvalidValue => {
            let known = match error.get(ContextKind::ValidValue) {
                Some(ContextValue::Strings(known)) => known.iter().map(String::as_str).collect(),
                _ => Vec::new(),
            };
            let advice = match nearest(shown, &known) {
                Some(near) => Some(format!("did you mean `{near}`?")),
                None if known.is_empty() => None,
                None => Some(format!("known values: {}", known.join(", "))),
            };
            Some((format!("unknown value `{shown}`"), advice))
        }
        // Other errors come from required words that this call omits.
        _ => None,
    }
}

/// Rewrites the message of a number parser in plain words. Other messages stay.
fn plain_advice(text: &str) -> String {
    if let Some((_, range)) = text.split_once(" is not in ")
        && let Some((low, high)) = range.split_once("..")
    {
        return match high.trim_start_matches('=') {
            "" => format!("write a whole number of at least {low}"),
            high => format!("write a whole number from {low} to {high}"),
        };
    }
    match text {
        "invalid digit found in string" | "cannot parse integer from empty string" => "write a whole number",
        "number too large to fit in target type" => "write a smaller number",
        "number too small to fit in target type" => "write a larger number",
        "invalid float literal" | "cannot parse float from empty string" => "write a number",
        _ => text,
    }
    .to_owned()
}

type OptionText = (Option<String>, Range<usize>);

/// Values of an option as typed text, with their positions. A switch that is off has none.
fn texts(
    file: &TomlFile,
    option: &Arg,
    name: &str,
    value: &Spanned<DeValue<'_>>,
    plain: Option<&toml::Value>,
) -> Result<Vec<OptionText>, Error> {
    match (option.get_action(), value.get_ref(), plain) {
        (ArgAction::SetTrue, DeValue::Boolean(on), _) => {
            Ok(if *on { vec![(None, value.span())] } else { Vec::new() })
        }
        (ArgAction::SetTrue, _, _) => Err(file.misfit(value, "true or false")),
        (ArgAction::Append, DeValue::Array(list), _) => {
            list.iter().map(|v| text(file, v, EXPECTED_TEXTS)).collect()
        }
        (ArgAction::Append, DeValue::Table(table), Some(toml::Value::Table(plain))) if name == "set" => {
            let changes = table.iter().filter_map(|(key, value)| {
                let change = format!("{}={}", key.get_ref(), plain.get(key.get_ref().as_ref())?);
                Some((Some(change), key.span().start..value.span().end))
            });
            Ok(changes.collect())
        }
        (ArgAction::Append, _, _) if name == "set" => {
            text(file, value, "a table such as { lines.crease_deg = 30 }").map(|t| vec![t])
        }
        (ArgAction::Append, _, _) => text(file, value, EXPECTED_TEXTS).map(|t| vec![t]),
        (_, DeValue::Integer(number), _) => Ok(vec![(Some(number.to_string()), value.span())]),
        (_, DeValue::Float(number), _) => Ok(vec![(Some(number.to_string()), value.span())]),
        _ => text(file, value, "text or a number").map(|t| vec![t]),
    }
}

/// Expected value of a repeatable option, for messages.
const EXPECTED_TEXTS: &str = "text, or a list of texts";

fn text(file: &TomlFile, value: &Spanned<DeValue<'_>>, wanted: &str) -> Result<OptionText, Error> {
    match value.get_ref() {
        DeValue::String(text) => Ok((Some(text.clone().into_owned()), value.span())),
        _ => Err(file.misfit(value, wanted)),
    }
}

/// Resolves paths in a value against the folder of the file.
fn resolve_paths(
    file: &TomlFile,
    name: &str,
    value: Option<String>,
    span: &Range<usize>,
) -> Result<Option<String>, Error> {
    let Some(value) = value else { return Ok(None) };
    let beside = file.folder.join(&value);
    let beside_text = || beside.to_string_lossy().into_owned();
    Ok(Some(match name {
        "set" => {
            style::placed_change(&value, &file.folder).map_err(|error| file.with_position(&error, span))?
        }
        "style" => {
            let is_path = value.ends_with(".toml") || value.contains(['/', '\\']) || beside.is_file();
            let style = if Style::sheet_text(&value).is_none() && is_path { beside_text() } else { value };
            // An error inside a style sheet keeps the position in that sheet.
            Style::load(&style).map_err(|error| match error.place {
                Some(_) => error,
                None => file.with_position(&error, span),
            })?;
            style
        }
        "camera" if value.ends_with(".json") || beside.is_file() => beside_text(),
        "step-converter" if value.contains(['/', '\\']) => beside_text(),
        _ => value,
    }))
}
