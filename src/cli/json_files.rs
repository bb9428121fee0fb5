//! JSON files and texts of several commands.

use std::path::Path;

use serde::Serialize;
use serde_json::Value;

use crate::error::Error;

/// Reads a JSON file. `remedy` says what to write.
pub(crate) fn read(path: &Path, remedy: &str) -> Result<Value, Error> {
    let text =
        std::fs::read_to_string(path).map_err(|error| Error::io("cannot read", error).in_file(path))?;
    serde_json::from_str(text.trim_start_matches('\u{feff}'))
        .map_err(|error| Error::json("this is not JSON", &error).in_file(path).remedy(remedy))
}

/// Numbers and strings as JSON with indentation and a line break at the end.
pub(crate) fn text(data: &impl Serialize) -> String {
    // Numbers and strings always serialise.
    serde_json::to_string_pretty(data).unwrap_or_default() + "\n"
}
