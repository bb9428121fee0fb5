//! British and American spelling of keys: `color` is read as `colour`.

use toml::{Table, Value};

use crate::error::spelling::british;

/// A table whose keys are names chosen by the user.
const USER_NAMED_TABLE: &str = "artist_texture";

/// Renames the keys of a sheet to British spelling, so that sheets in either spelling merge.
pub(crate) fn to_british(table: &mut Table) {
    let keys: Vec<String> = table.keys().filter(|key| british(key) != **key).cloned().collect();
    for key in keys {
        if let Some(value) = table.remove(&key) {
            table.insert(british(&key), value);
        }
    }
    for (key, value) in table.iter_mut() {
        if key != USER_NAMED_TABLE {
            value_to_british(value);
        }
    }
}

fn value_to_british(value: &mut Value) {
    match value {
        Value::Table(table) => to_british(table),
        Value::Array(list) => list.iter_mut().for_each(value_to_british),
        _ => {}
    }
}
