//! `ligne.toml`: what a project draws with unless told otherwise.
//!
//! It is looked for in the working folder and then in each folder above. The table `[draw]` holds
//! options of `ligne draw`, the table `[diff]` the tolerance within which drawings count as the same.

use std::path::{Path, PathBuf};

use clap::{Args, Command};
use toml::de::DeValue;

use super::draw_args::DrawArgs;
use super::keys::{File, Given, Keys};
use crate::error::Error;

/// The name of the file.
const NAME: &str = "ligne.toml";

/// Options of `ligne draw` that are of one call, or of one's own files, rather than of a project.
pub(super) const OF_ONE_CALL: [&str; 4] = ["output", "report", "stage", "help"];

/// What a `ligne.toml` says.
#[derive(Debug)]
pub(super) struct Config {
    pub(super) draw: Vec<Given>,
    pub(super) diff: Vec<Given>,
}

impl Config {
    /// Finds the file upward from a folder and reads it.
    pub(super) fn find(folder: &Path) -> Result<Option<Self>, Error> {
        let mut above = PathBuf::new();
        for candidate in folder.ancestors() {
            if candidate.join(NAME).is_file() {
                return Self::read(&above.join(NAME)).map(Some);
            }
            above.push("..");
        }
        Ok(None)
    }

    fn read(path: &Path) -> Result<Self, Error> {
        let file = File::read(path, NAME)?;
        let (table, values) = (file.table()?, file.values()?);
        let mut config = Self { draw: Vec::new(), diff: Vec::new() };
        for (key, value) in &table {
            let name = key.get_ref().as_ref();
            let (command, without, list): (_, &[&str], _) = match name {
                "draw" => (DrawArgs::augment_args(Command::new("draw")), &OF_ONE_CALL, &mut config.draw),
                _ => return Err(file.unknown(key, &["draw"])),
            };
            let (DeValue::Table(table), Some(values)) =
                (value.get_ref(), values.get(name).and_then(toml::Value::as_table))
            else {
                return Err(file.misfit(value, "a table"));
            };
            *list = Keys { command: &command, without, others: &[] }.read(&file, table, values)?;
        }
        Ok(config)
    }
}
