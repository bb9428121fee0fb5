//! Formats a list of style keys as an aligned text table or as JSON.

use std::fmt::Write as _;

use serde_json::{Map, Value, json};

use crate::cli::json_files;
use crate::style::{KeyType, StyleKey};

/// Maximum width of the column of defaults, characters. Help after a longer default is not aligned.
const MAX_DEFAULT_COLUMNS: usize = 22;

/// A line for each key: path, type, default, and help with the allowed values.
pub(crate) fn text(keys: &[&StyleKey]) -> String {
    let rows: Vec<[String; 4]> = keys.iter().map(|key| row(key)).collect();
    let width = |column: usize, most: usize| {
        let widths = rows.iter().map(|row| row[column].chars().count()).filter(|width| *width <= most);
        widths.max().unwrap_or(0)
    };
    let [path, kind, default] = [width(0, usize::MAX), width(1, usize::MAX), width(2, MAX_DEFAULT_COLUMNS)];
    let mut list = String::new();
    for [a, b, c, d] in &rows {
        let _ = writeln!(list, "{a:path$}  {b:kind$}  {c:default$}  {d}");
    }
    list
}

fn row(key: &StyleKey) -> [String; 4] {
    [key.path.clone(), key.kind.name().to_owned(), default(key), key.full_help()]
}

/// Default of a key as displayed: a value, `as KEY` if it is inherited, or `-` if there is none.
pub(crate) fn default(key: &StyleKey) -> String {
    match (key.default, &key.inherits) {
        (Some(default), _) => default.to_owned(),
        (None, Some(other)) => {
            let general = other.strip_suffix(key.name).unwrap_or(other).trim_end_matches('.');
            format!("as {general}")
        }
        (None, None) => "-".to_owned(),
    }
}

/// The keys as a JSON list of objects.
pub(crate) fn json(keys: &[&StyleKey]) -> String {
    json_files::text(&keys.iter().map(|key| object(key)).collect::<Vec<Value>>())
}

fn object(key: &StyleKey) -> Value {
    let text = |text: &str| if text.is_empty() { Value::Null } else { Value::from(text) };
    let words = match key.kind {
        KeyType::Switch => json!([true, false]),
        _ if key.words.is_empty() => Value::Null,
        _ => Value::from(key.words.clone()),
    };
    let default =
        key.default.and_then(|default| toml::from_str::<toml::Table>(&format!("v = {default}")).ok());
    let default = default.as_ref().and_then(|table| table.get("v")).map_or(Value::Null, plain);
    let mut object = Map::new();
    for (name, value) in [
        ("key", Value::from(key.path.as_str())),
        ("type", Value::from(key.kind.name())),
        ("values", words),
        ("range", text(key.range)),
        ("default", default),
        ("inherits", key.inherits.as_deref().map_or(Value::Null, Value::from)),
        ("unit", text(key.unit)),
        ("settable", Value::from(key.is_settable())),
        ("help", Value::from(key.help)),
    ] {
        object.insert(name.to_owned(), value);
    }
    Value::Object(object)
}

fn plain(value: &toml::Value) -> Value {
    match value {
        toml::Value::Boolean(value) => Value::from(*value),
        toml::Value::Integer(value) => Value::from(*value),
        toml::Value::Float(value) => Value::from(*value),
        toml::Value::String(value) => Value::from(value.as_str()),
        toml::Value::Array(list) => Value::from(list.iter().map(plain).collect::<Vec<_>>()),
        other => Value::from(other.to_string()),
    }
}
