//! Advice for error messages: the key that the user may have intended, and how to write its value.
//!
//! A wrong path is compared with the ends of all paths, so `crease_deg` is found as `lines.crease_deg`. If
//! nothing matches, the first misspelt part is replaced by the nearest known word.

use super::key_table::{KeyType, StyleKey};
use crate::error::nearest::nearest;
use crate::error::spelling::british;

/// Maximum number of suggested keys.
const MAX_SUGGESTIONS: usize = 3;

/// The keys whose path ends with an unknown word or dotted path, most general ones first. If there are none,
/// the first misspelt part is replaced by the nearest known one.
pub(crate) fn alternatives(typed: &str, only_settable: bool) -> Vec<String> {
    let typed = british(&typed.to_lowercase().replace('-', "_"));
    let exact = ending(&typed, only_settable);
    if !exact.is_empty() {
        return exact;
    }
    // Replace the first misspelt part.
    let known: Vec<&str> = StyleKey::all().iter().flat_map(|key| key.path.split(['.', '['])).collect();
    let mut parts: Vec<&str> = typed.split('.').collect();
    let Some(wrong) = parts.iter_mut().find(|part| !known.contains(*part)) else { return Vec::new() };
    let Some(near) = nearest(wrong, &known) else { return Vec::new() };
    *wrong = near;
    ending(&parts.join("."), only_settable)
}

/// The keys and tables whose path ends with a word or dotted path. `only_settable` excludes keys that `--set`
/// cannot set.
pub(crate) fn ending(typed: &str, only_settable: bool) -> Vec<String> {
    let suffix = format!(".{typed}");
    // Depth of each path, its generality, and the path.
    let mut found: Vec<(usize, bool, &str)> = Vec::new();
    for key in StyleKey::all().iter().filter(|key| key.is_settable() || !only_settable) {
        let ends = key.path.match_indices('.').map(|(at, _)| at).chain([key.path.len()]);
        for path in ends.filter_map(|end| key.path.get(..end)) {
            let plain_path = path.replace("[]", "");
            let fits = plain_path == typed || plain_path.ends_with(&suffix);
            let is_general = key.inherits.is_none() || path.len() <= key.prefix.len();
            if fits && found.iter().all(|(.., listed_path)| *listed_path != path) {
                found.push((path.matches('.').count(), is_general, path));
            }
        }
    }
    if found.iter().any(|(_, is_general, _)| *is_general) {
        found.retain(|(_, is_general, _)| *is_general);
    }
    let is_key = |path: &str| StyleKey::find(path).is_some();
    if only_settable && found.iter().any(|(.., path)| is_key(path)) {
        found.retain(|(.., path)| is_key(path));
    }
    found.sort_by_key(|(depth, ..)| *depth);
    found.into_iter().take(MAX_SUGGESTIONS).map(|(.., path)| path.to_owned()).collect()
}

/// Words in back quotes as a list, with "or" before the last one.
pub(crate) fn listed(words: &[String]) -> String {
    let quoted: Vec<String> = words.iter().map(|word| format!("`{word}`")).collect();
    match quoted.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, rest)) => format!("{} or {last}", rest.join(", ")),
        None => String::new(),
    }
}

/// Advice on how to write the value of a key. Lists on the command line need shell quotes.
pub(crate) fn write_value(key: &StyleKey, on_command_line: bool) -> String {
    let words = key.words.join(", ");
    let range = match key.range {
        "" | "any" => String::new(),
        range if range.starts_with(|c: char| c.is_ascii_digit()) => format!(" from {range}"),
        range if range.starts_with("at least") => format!(" of {range}"),
        range => format!(" {range}"),
    };
    match key.kind {
        KeyType::Choice => format!("write one of {words}"),
        KeyType::Choices => {
            let some: Vec<String> = key.words.iter().take(2).map(|word| format!("\"{word}\"")).collect();
            let list = match (on_command_line, some.join(", ")) {
                (true, some) => format!("--set '{}=[{some}]'", key.path),
                (false, some) => format!("[{some}]"),
            };
            format!("write a list such as {list}; the words are {words}")
        }
        KeyType::Number => format!("write a number{range}"),
        KeyType::Whole => format!("write a whole number{range}"),
        KeyType::Numbers => format!("write a list of numbers{range}, such as [0.3, 0.7]"),
        KeyType::Factor => format!("write {}; numbers go{range}", key.kind.form()),
        kind if words.is_empty() || kind == KeyType::Brush => format!("write {}", kind.form()),
        kind => format!("write {}, or {words}", kind.form()),
    }
}
