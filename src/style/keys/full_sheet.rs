//! [`full_sheet`]: prints a sheet with every key of a style.
//!
//! The order is that of the table of keys. Each key has its value or default, and its help as a comment.
//! Named pens list only the keys that they set.

use std::fmt::Write as _;

use toml::{Table, Value};

use super::key_table::{KeyType, StyleKey};

/// Maximum width of a comment that lists keys, columns.
const MAX_COMMENT_COLUMNS: usize = 100;

/// A sheet with all keys: the values of the style, and defaults for the rest. Keys without a value are
/// commented out.
pub(crate) fn full_sheet(name: &str, set: &Table) -> String {
    let mut sheet = format!("# All keys of the style `{name}`. A line that begins with # has no effect.\n\n");
    for key in StyleKey::all().iter().filter(|key| key.prefix.is_empty() && key.kind != KeyType::Tables) {
        write_key(&mut sheet, key, key.name, set, true);
    }
    let mut written: Vec<&str> = Vec::new();
    for key in StyleKey::all().iter().filter(|key| !key.prefix.is_empty()) {
        let (list, is_list) = match key.prefix.split_once("[]") {
            Some((list, _)) => (list, true),
            None => (key.prefix, false),
        };
        if written.contains(&list) {
            continue;
        }
        written.push(list);
        if is_list { write_list(&mut sheet, list, set) } else { write_table(&mut sheet, list, set) }
    }
    sheet
}

/// Writes a table `[prefix]` with its keys.
fn write_table(sheet: &mut String, prefix: &str, set: &Table) {
    let keys = || StyleKey::all().iter().filter(|key| key.prefix == prefix && key.kind != KeyType::Tables);
    let empty = Table::new();
    let own = value_at(set, prefix).and_then(Value::as_table).unwrap_or(&empty);
    if prefix.starts_with("pen.") {
        // A named pen changes only the fields that are set.
        let (set_keys, unset): (Vec<_>, Vec<_>) = keys().partition(|key| is_set(own, key.name));
        if set_keys.is_empty() {
            let _ = writeln!(sheet, "\n# [{prefix}] sets no key: all are as in [pen].");
            return;
        }
        let _ = writeln!(sheet, "\n[{prefix}]");
        for key in set_keys {
            write_key(sheet, key, key.name, own, false);
        }
        let names: Vec<&str> = unset.iter().map(|key| key.name).collect();
        comment(sheet, "as in [pen]", &names);
        return;
    }
    let _ = writeln!(sheet, "\n[{prefix}]");
    for key in keys() {
        write_key(sheet, key, key.name, own, true);
    }
}

/// Writes the entries of a list of tables, `[[list]]`, or its keys in a comment.
fn write_list(sheet: &mut String, list: &str, set: &Table) {
    let start = format!("{list}[].");
    let keys: Vec<(&StyleKey, &str)> =
        StyleKey::all().iter().filter_map(|key| Some((key, key.path.strip_prefix(&start)?))).collect();
    let entries = value_at(set, list).and_then(Value::as_array).map(Vec::as_slice).unwrap_or_default();
    for entry in entries.iter().filter_map(Value::as_table) {
        let _ = writeln!(sheet, "\n[[{list}]]");
        for (key, name) in &keys {
            // Keys that a rule or material does not set keep their values from elsewhere.
            let changes = key.inherits.is_some()
                || ["fills.material[]", "rule[].pen"].iter().any(|table| key.prefix.starts_with(table));
            if !changes || is_set(entry, name) {
                write_key(sheet, key, name, entry, !changes);
            }
        }
    }
    if entries.is_empty() {
        let names: Vec<&str> = keys.iter().map(|(_, name)| *name).collect();
        sheet.push('\n');
        comment(sheet, &format!("[[{list}]] may be added, with the keys"), &names);
    }
}

/// Writes the line of a key: its value, its default, or a comment.
fn write_key(sheet: &mut String, key: &StyleKey, name: &str, own: &Table, with_defaults: bool) {
    let help = key.full_help();
    // The table that holds the key may be the value of another key, such as a brush or a shade.
    let start = key.path.strip_suffix(name).unwrap_or_default();
    let holders: Vec<&str> = name.match_indices('.').filter_map(|(at, _)| name.get(..at)).collect();
    let is_key = |holder: &&&str| StyleKey::find(&format!("{start}{holder}")).is_some();
    let is_held = holders.iter().any(|holder| is_key(&holder));
    if holders.iter().filter(is_key).any(|holder| value_at(own, holder).is_some()) {
        return;
    }
    if let Some(value) = value_at(own, name) {
        let _ = writeln!(sheet, "{name} = {value}  # {help}");
        return;
    }
    let other_scale = ["steps", "ramp", "table"].iter().any(|other| own.contains_key(*other));
    let default = key.default.filter(|_| with_defaults && !is_held && !(name == "thresholds" && other_scale));
    match default {
        Some(default) => {
            let _ = writeln!(sheet, "{name} = {default}  # {help}");
        }
        None => {
            let _ = writeln!(sheet, "# {name} =  # {help}");
        }
    }
}

/// Writes a comment that lists keys, wrapped to lines.
fn comment(sheet: &mut String, head: &str, names: &[&str]) {
    let mut line = format!("# {head}:");
    for (number, name) in names.iter().enumerate() {
        if line.len() + name.len() + 2 > MAX_COMMENT_COLUMNS {
            let _ = writeln!(sheet, "{line}");
            "#  ".clone_into(&mut line);
        }
        let comma = if number + 1 < names.len() { "," } else { "" };
        let _ = write!(line, " {name}{comma}");
    }
    let _ = writeln!(sheet, "{line}");
}

fn is_set(table: &Table, name: &str) -> bool {
    value_at(table, name).is_some()
}

/// The value at a dotted path of a table.
pub(crate) fn value_at<'a>(table: &'a Table, path: &str) -> Option<&'a Value> {
    match path.split_once('.') {
        None => table.get(path),
        Some((first, rest)) => value_at(table.get(first)?.as_table()?, rest),
    }
}
