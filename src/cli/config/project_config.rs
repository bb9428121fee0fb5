//! Defaults of a project from `ligne.toml`.
//!
//! The file is searched in the working folder and its parents. The table `[draw]` holds options of drawings.
//! The table `[diff]` holds the tolerance for comparisons.

use std::path::{Path, PathBuf};

use clap::{Args, Command};
use toml::Spanned;
use toml::de::DeValue;

use super::toml_options::{ConfiguredOption, OptionKeys, TomlFile, word};
use crate::cli::options::draw_args::HowArgs;
use crate::diff::Tolerances;
use crate::error::Error;

/// Name of the file.
const FILE_NAME: &str = "ligne.toml";

/// Tables of the file.
const TABLE_NAMES: [&str; 2] = ["draw", "diff"];

/// Contents of a `ligne.toml`.
#[derive(Debug, Default)]
pub(crate) struct ProjectConfig {
    /// Options of drawings.
    pub(crate) draw: Vec<ConfiguredOption>,
    /// Tolerance for comparisons, in the form of the option `--tolerance`.
    pub(crate) tolerance: Option<String>,
}

impl ProjectConfig {
    /// Finds the file in a folder or its parents, and reads it.
    pub(crate) fn find(folder: &Path) -> Result<Option<Self>, Error> {
        let mut above = PathBuf::new();
        for candidate in folder.ancestors() {
            if candidate.join(FILE_NAME).is_file() {
                return Self::read(&above.join(FILE_NAME)).map(Some);
            }
            above.push("..");
        }
        Ok(None)
    }

    fn read(path: &Path) -> Result<Self, Error> {
        let file = TomlFile::read(path, FILE_NAME)?;
        let (table, values) = (file.table()?, file.values()?);
        let mut config = Self::default();
        for (key, value) in &table {
            let name = key.get_ref().as_ref();
            let DeValue::Table(table) = value.get_ref() else {
                let known = TABLE_NAMES.contains(&name);
                return Err(if known {
                    file.misfit(value, "a table")
                } else {
                    file.unknown(key, &TABLE_NAMES)
                });
            };
            match (name, values.get(name).and_then(toml::Value::as_table)) {
                ("draw", Some(values)) => {
                    let command = HowArgs::augment_args(Command::new("draw"));
                    let keys = OptionKeys { command: &command, without: &[], others: &[] };
                    config.draw = keys.read(&file, table, values)?;
                }
                ("diff", _) => {
                    for (key, value) in table {
                        if key.get_ref() != "tolerance" {
                            return Err(file.unknown(key, &["tolerance"]));
                        }
                        config.tolerance = Some(tolerance(&file, value)?);
                    }
                }
                _ => return Err(file.unknown(key, &TABLE_NAMES)),
            }
        }
        Ok(config)
    }

    /// Options for `ligne diff`: the tolerance and the drawing options, except `quiet`.
    pub(crate) fn diff(self) -> Vec<ConfiguredOption> {
        let words = |text: &String| vec![word("tolerance", Some(text))];
        let given =
            |text| ConfiguredOption { option: "tolerance".to_owned(), words: words(text), span: 0..0 };
        let drawn = self.draw.into_iter().filter(|given| given.option != "quiet");
        self.tolerance.iter().map(given).chain(drawn).collect()
    }
}

/// Reads a tolerance from text, or from a table with layers, classes, `lines`, `fills` and `default` as keys.
pub(crate) fn tolerance(file: &TomlFile, value: &Spanned<DeValue<'_>>) -> Result<String, Error> {
    let check = |text: String, value: &Spanned<DeValue<'_>>| match Tolerances::parse(&text) {
        Ok(_) => Ok(text),
        Err(error) => Err(file.with_position(&error, &value.span())),
    };
    let length = |value: &Spanned<DeValue<'_>>| match value.get_ref() {
        DeValue::String(text) => Ok(text.clone().into_owned()),
        DeValue::Integer(px) => Ok(px.to_string()),
        DeValue::Float(px) => Ok(px.to_string()),
        _ => Err(file.misfit(value, "a length such as \"0.1px\"")),
    };
    let DeValue::Table(table) = value.get_ref() else {
        return length(value).and_then(|text| check(text, value));
    };
    let mut parts = Vec::new();
    for (name, value) in table {
        parts.push(check(format!("{}={}", name.get_ref(), length(value)?), value)?);
    }
    Ok(parts.join(","))
}
