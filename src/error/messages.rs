//! Messages of the TOML and JSON parsers in plain words, without names of types, structs or parsers.

use super::nearest::{nearest, suggestion};
use super::spelling::without_american;

/// Parser message in plain words, with advice.
#[derive(Debug, PartialEq)]
pub(crate) struct Explained {
    pub message: String,
    pub advice: Option<String>,
    /// Kind of the mistake.
    pub mistake: Mistake,
}

/// Kind of mistake that a message reports.
#[derive(Debug, PartialEq)]
pub(crate) enum Mistake {
    /// An unknown key, and the known keys.
    UnknownKey(String, Vec<String>),
    /// A value of the wrong type.
    WrongType,
    /// Any other mistake.
    Other,
}

/// Rewrites a parser message in plain words.
pub(crate) fn explain(message: &str) -> Explained {
    let message = message.trim().replace('\n', ", ");
    let other_mistake =
        |message: String, advice: Option<String>| Explained { message, advice, mistake: Mistake::Other };
    if let Some(words) = quoted(&message, "unknown field ") {
        let Some((word, listed)) = words.split_first() else { return other_mistake(message, None) };
        let british_keys = without_american(listed);
        let advice = did_you_mean(word, &british_keys, "known keys");
        let key_names = british_keys.into_iter().map(ToOwned::to_owned).collect();
        return Explained {
            message: format!("unknown key `{word}`"),
            advice: Some(advice),
            mistake: Mistake::UnknownKey((*word).to_owned(), key_names),
        };
    }
    if let Some(words) = quoted(&message, "unknown variant ") {
        let Some((word, known_values)) = words.split_first() else { return other_mistake(message, None) };
        return other_mistake(
            format!("unknown value `{word}`"),
            Some(did_you_mean(word, known_values, "known values")),
        );
    }
    if let Some(words) = quoted(&message, "missing field ") {
        let word = words.first().copied().unwrap_or_default();
        return other_mistake(format!("`{word}` is missing"), Some(format!("add {word} = …")));
    }
    if let Some(words) = quoted(&message, "duplicate field ") {
        let word = words.first().copied().unwrap_or_default();
        return other_mistake(format!("`{word}` is given twice"), Some("leave one out".to_owned()));
    }
    if message == "duplicate key" {
        return other_mistake("this key is given twice".to_owned(), Some("leave one out".to_owned()));
    }
    for start in ["invalid type: ", "invalid value: "] {
        let parts = message.strip_prefix(start).and_then(|rest| rest.split_once(", expected "));
        if let Some((actual_value, expected_type)) = parts {
            return Explained {
                message: format!("{} does not fit here", plain_value(actual_value)),
                advice: Some(format!("write {}", plain_type(expected_type))),
                mistake: Mistake::WrongType,
            };
        }
    }
    let counted = message.strip_prefix("invalid length ").and_then(|rest| rest.split_once(", expected "));
    if let Some((actual_count, expected_length)) = counted {
        let digits: String = expected_length.chars().filter(char::is_ascii_digit).collect();
        let message = match actual_count {
            "1" => "one value does not fit here".to_owned(),
            _ => format!("{actual_count} values do not fit here"),
        };
        let advice = format!("write {digits} values");
        return Explained { message, advice: Some(advice), mistake: Mistake::WrongType };
    }
    let is_word = message.starts_with("wanted string or table");
    if is_word || message.starts_with("data did not match any variant") {
        let advice = is_word.then(|| "write a word in quotes".to_owned());
        return Explained {
            message: "this does not fit here".to_owned(),
            advice,
            mistake: Mistake::WrongType,
        };
    }
    match message.split_once("; ") {
        Some((what, advice)) => other_mistake(what.to_owned(), Some(advice.to_owned())),
        None => other_mistake(message, None),
    }
}

/// Words in back quotes of a message with this start; none for other messages.
fn quoted<'a>(message: &'a str, start: &str) -> Option<Vec<&'a str>> {
    Some(message.strip_prefix(start)?.split('`').skip(1).step_by(2).collect())
}

fn did_you_mean(word: &str, known: &[&str], list: &str) -> String {
    suggestion(nearest(word, known), || format!("{list}: {}", known.join(", ")))
}

/// A found value as the user wrote it.
fn plain_value(text: &str) -> String {
    for kind in ["boolean ", "integer ", "floating point ", "character "] {
        if let Some(value) = text.strip_prefix(kind) {
            return value.to_owned();
        }
    }
    if let Some(value) = text.strip_prefix("string ") {
        return format!("`{value}`");
    }
    match text {
        "sequence" | "array" => "a list".to_owned(),
        "map" | "table" => "a table".to_owned(),
        "null" | "unit value" => "null".to_owned(),
        _ => text.to_owned(),
    }
}

/// An expected type in plain words.
fn plain_type(text: &str) -> String {
    let whole = |low: &str, high: &str| format!("a whole number from {low} to {high}");
    match text {
        "f64" | "f32" => "a number".to_owned(),
        "u64" | "u32" | "usize" => "a whole number of at least 0".to_owned(),
        "i64" | "i32" | "isize" => "a whole number".to_owned(),
        "u8" => whole("0", "255"),
        "u16" => whole("0", "65535"),
        "i8" => whole("-128", "127"),
        "a boolean" => "true or false".to_owned(),
        "a sequence" => "a list in brackets, [ ]".to_owned(),
        "a map" => "a table".to_owned(),
        "a string" | "a borrowed string" | "string" | "str" => "text in quotes".to_owned(),
        "path string" => "a path in quotes".to_owned(),
        "string or table" => "a word in quotes".to_owned(),
        _ if ["struct ", "newtype struct ", "tuple struct "].iter().any(|start| text.starts_with(start)) => {
            "a table".to_owned()
        }
        _ if text.starts_with("enum ") || text.contains(" enum ") => "a word in quotes".to_owned(),
        _ if ["an array of length ", "a tuple of size "].iter().any(|start| text.starts_with(start)) => {
            let count: String = text.chars().filter(char::is_ascii_digit).collect();
            format!("a list of {count} values")
        }
        _ => text.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn explain_hides_rust_type_names() {
        for (serde_message, message, advice) in [
            (
                "invalid type: integer `-3`, expected usize",
                "`-3` does not fit here",
                "write a whole number of at least 0",
            ),
            ("invalid type: string \"a\", expected f64", "`\"a\"` does not fit here", "write a number"),
            (
                "invalid value: integer `300`, expected u8",
                "`300` does not fit here",
                "write a whole number from 0 to 255",
            ),
            (
                "invalid type: sequence, expected struct Perspective",
                "a list does not fit here",
                "write a table",
            ),
            ("invalid length 2, expected an array of length 3", "2 values do not fit here", "write 3 values"),
            ("missing field `name`", "`name` is missing", "add name = …"),
            ("duplicate field `colour`", "`colour` is given twice", "leave one out"),
            ("unknown field `x`, expected one of `color`, `colour`", "unknown key `x`", "known keys: colour"),
        ] {
            let explained = explain(serde_message);
            assert_eq!(
                (&*explained.message, explained.advice.as_deref()),
                (message, Some(advice)),
                "{serde_message}"
            );
        }
        let explained = explain("data did not match any variant of untagged enum Spots");
        assert_eq!((&*explained.message, explained.advice), ("this does not fit here", None));
    }
}
