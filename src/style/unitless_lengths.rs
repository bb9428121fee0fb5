//! [`unitless_length_warning`]: a warning about numbers without a unit on a page in mm.
//!
//! A bare number is a length in px. On a page in mm users often intend mm, so these numbers are reported
//! once:
//!
//! 1. Only numbers of the user count: those of `--set`, and those of sheets that are not built in.
//! 2. Only keys with lengths count, and 0 is the same in every unit.
//! 3. A number in a sheet is ignored if it is the default of its key, or a built-in sheet has it, because the
//!    sheet is probably a copy.

use toml::{Table, Value};

use super::Style;
use super::keys::{KeyType, StyleKey};
use super::sheet_loader::{change, own_sheets};
use crate::drawing::length::MM_PER_PX;

/// A number without a unit.
struct UnitlessLength {
    /// Path of its key, without `[]`.
    key: String,
    value: f64,
}

/// The warning about numbers without a unit in a style and its changes, for a page in mm. `None` if there are
/// none or the style cannot be read.
pub(crate) fn unitless_length_warning(name_or_path: &str, sets: &[String]) -> Option<String> {
    let mut found = Vec::new();
    for set in sets {
        if let Ok(table) = change(set) {
            gather(&table, "", &mut found);
        }
    }
    let sheets = own_sheets(name_or_path).ok()?;
    let mut in_sheets = Vec::new();
    for (_, table) in &sheets {
        gather(table, "", &mut in_sheets);
    }
    if !in_sheets.is_empty() {
        let mut stock = Vec::new();
        let texts = Style::names().filter_map(Style::sheet_text);
        for table in texts.filter_map(|text| toml::from_str::<Table>(text).ok()) {
            gather(&table, "", &mut stock);
        }
        let is_stock = |own: &UnitlessLength| {
            let same = |other: &UnitlessLength| other.key == own.key && other.value == own.value;
            stock.iter().any(same) || is_default(own)
        };
        found.extend(in_sheets.into_iter().filter(|own| !is_stock(own)));
    }
    let first = found.first()?;
    let value = first.value;
    let mm = (value * MM_PER_PX * 1000.0).round() / 1000.0;
    let mut others: Vec<&str> =
        found.iter().map(|other| other.key.as_str()).filter(|key| *key != first.key).collect();
    others.dedup();
    let more = match others[..] {
        [] => String::new(),
        [one] => format!("; so is {one}"),
        [one, ..] => format!("; so are {one} and {} more", others.len() - 1),
    };
    Some(format!(
        "{}: {value} is px, which is {mm} mm here; write {value}mm, or {value}px to keep it{more}",
        first.key
    ))
}

/// Whether a number is the default of its key.
fn is_default(own: &UnitlessLength) -> bool {
    let Some(key) = StyleKey::find(&own.key) else { return false };
    let general = key.inherits.as_deref().and_then(StyleKey::find).unwrap_or(key);
    let default = general.default.and_then(|text| toml::from_str::<Table>(&format!("v = {text}")).ok());
    let mut numbers = Vec::new();
    if let Some(value) = default.as_ref().and_then(|table| table.get("v")) {
        gather_numbers(value, &own.key, &mut numbers);
    }
    numbers.iter().any(|default| default.value == own.value)
}

/// Collects the bare lengths of a table at path `above`.
fn gather(table: &Table, above: &str, found: &mut Vec<UnitlessLength>) {
    for (key, value) in table {
        let path = if above.is_empty() { key.clone() } else { format!("{above}.{key}") };
        match (StyleKey::find(&path).map(|key| key.kind), value) {
            (Some(KeyType::Length | KeyType::Lengths), value) => gather_numbers(value, &path, found),
            (_, Value::Table(inner)) => gather(inner, &path, found),
            (_, Value::Array(list)) => {
                list.iter().filter_map(Value::as_table).for_each(|inner| gather(inner, &path, found));
            }
            _ => {}
        }
    }
}

fn gather_numbers(value: &Value, key: &str, found: &mut Vec<UnitlessLength>) {
    let number = match value {
        Value::Integer(number) => *number as f64,
        Value::Float(number) => *number,
        Value::Array(list) => return list.iter().for_each(|value| gather_numbers(value, key, found)),
        _ => return,
    };
    if number != 0.0 {
        found.push(UnitlessLength { key: key.to_owned(), value: number });
    }
}
