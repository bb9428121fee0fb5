//! Error messages about TOML files, with the line, a caret and advice.
//!
//! 1. The message of the parser is explained in plain words.
//! 2. For style sheets, the path of the wrong key is found in the text, and the table of keys suggests a key
//!    or a value.
//! 3. The line is printed with a caret below the wrong span.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::keys::StyleKey;
use super::toml_reader::TomlFault;
use crate::error::Error;
use crate::error::messages::{Explained, Mistake, explain};
use crate::error::nearest::distance;
use crate::error::spelling::british;
use crate::style::keys::advice::{alternatives, ending, listed, write_value};

/// Longest line that is shown in full, characters.
const MAX_SHOWN_CHARACTERS: usize = 120;

/// Longest value that is quoted in a message, bytes.
const MAX_QUOTED_BYTES: usize = 40;

/// An error in a TOML text, with its line and a caret.
#[cfg(feature = "page")]
pub(crate) fn in_sheet(text: &str, error: &TomlFault) -> Error {
    error_at(text, error, &explain_fault(text, error))
}

/// Explains the parser's message in plain words; quotes the value if the message does not name it.
fn explain_fault(text: &str, error: &TomlFault) -> Explained {
    let explained = explain(error.message());
    let value = error.span().and_then(|span| text.get(span)).unwrap_or_default().trim();
    match explained.message.strip_prefix("this does not") {
        Some(rest) if !value.is_empty() && value.len() <= MAX_QUOTED_BYTES && !value.contains('\n') => {
            Explained { message: format!("`{value}` does not{rest}"), ..explained }
        }
        _ => explained,
    }
}

/// An error in a style sheet, with its line, a caret, and advice from the table of keys.
pub(crate) fn in_style_sheet(text: &str, error: &TomlFault) -> Error {
    let path = error.span().and_then(|span| path_at(text, &span)).unwrap_or_default();
    error_at(text, error, &with_keys(explain_fault(text, error), &path, &path, false))
}

fn error_at(text: &str, error: &TomlFault, explained: &Explained) -> Error {
    let Explained { message, advice, .. } = explained;
    match error.span() {
        Some(span) => at_span(text, &span, message, advice.as_deref()),
        None => with_remedy(Error::new(message.as_str()), advice.as_deref(), None),
    }
}

/// An error at a position in a text, with its line and a caret.
pub(crate) fn at_span(text: &str, span: &Range<usize>, message: &str, advice: Option<&str>) -> Error {
    let (number, column, line, width) = locate(text, span);
    let (column, line, width) = excerpt(column, line, width);
    let gutter = number.to_string();
    let blank = " ".repeat(gutter.len());
    let picture = format!(" {gutter} | {line}\n {blank} | {}{}", " ".repeat(column), "^".repeat(width));
    with_remedy(Error::new(message).at(format!("line {number}")), advice, Some(&picture))
}

/// An error in a change of the command line, with a caret below the change.
pub(crate) fn in_change(set: &str, text: &str, error: &TomlFault) -> Error {
    let typed = set.split('=').next().unwrap_or_default().trim();
    let path = error.span().and_then(|span| path_at(text, &span)).unwrap_or_default();
    let Explained { message, advice, .. } = with_keys(explain_fault(text, error), &path, typed, true);
    let before = "--set ";
    let picture = error.span().map(|span| {
        let (_, column, _, width) = locate(text, &span);
        // The parsed text is `KEY = VALUE`; the value may have been quoted or replaced.
        let key = set.split('=').next().unwrap_or_default();
        let in_key = column < key.trim().chars().count();
        let (column, width) = if in_key {
            (column, width)
        } else {
            let start = key.chars().count() + 1;
            (start, set.chars().count().saturating_sub(start).max(1))
        };
        format!("   {before}{set}\n   {}{}", " ".repeat(before.len() + column), "^".repeat(width))
    });
    with_remedy(Error::new(message).at(format!("--set {set}")), advice.as_deref(), picture.as_deref())
}

/// `line N` of the value of a top-level key.
pub(crate) fn place_of_value(text: &str, key: &str) -> String {
    let number = text.lines().position(|line| {
        line.trim_start().strip_prefix(key).is_some_and(|rest| rest.trim_start().starts_with('='))
    });
    number.map_or_else(|| format!("key {key}"), |number| format!("line {}", number + 1))
}

/// Adds advice from the table of keys. `path` is the path of the wrong key, `typed` the path as the user
/// typed it.
fn with_keys(explained: Explained, path: &str, typed: &str, only_settable: bool) -> Explained {
    let advice = match &explained.mistake {
        Mistake::UnknownKey(word, known) => {
            // A known key that continues the word, such as `crease_deg` for `crease`.
            let start = format!("{word}_");
            let begun: Vec<String> =
                known.iter().filter(|known| known.starts_with(&start)).cloned().collect();
            if !begun.is_empty() {
                let advice = Some(format!("did you mean {}?", listed(&begun)));
                return Explained { advice, ..explained };
            }
            let near = known.iter().any(|known| distance(word, known) <= 1);
            let parts: Vec<&str> = typed.split('.').map(str::trim).collect();
            let at = parts.iter().position(|part| part == word);
            let tail = at.map_or_else(|| word.clone(), |at| parts[at..].join("."));
            let found = if near { Vec::new() } else { ending(&british(&tail), only_settable) };
            let is_near = explained.advice.as_deref().is_some_and(|advice| advice.starts_with("did you"));
            let found = if found.is_empty() && !is_near { alternatives(&tail, only_settable) } else { found };
            (!found.is_empty()).then(|| format!("did you mean {}?", listed(&found)))
        }
        Mistake::WrongType => StyleKey::find(path).map(|key| write_value(key, only_settable)),
        Mistake::Other => None,
    };
    match advice {
        Some(advice) => Explained { advice: Some(advice), ..explained },
        None => explained,
    }
}

/// The dotted path of the key or value at a position in a TOML text.
fn path_at(text: &str, span: &Range<usize>) -> Option<String> {
    let document = DeTable::parse(text).ok()?;
    let holds =
        |other: Range<usize>| other.start <= span.start && span.start < other.end.max(other.start + 1);
    fn in_table(table: &DeTable<'_>, above: &str, holds: &dyn Fn(Range<usize>) -> bool) -> Option<String> {
        table.iter().find_map(|(key, value)| {
            let word = key.get_ref();
            let path = if above.is_empty() { word.to_string() } else { format!("{above}.{word}") };
            if holds(key.span()) {
                return Some(path);
            }
            in_value(value, &path, holds)
        })
    }
    fn in_value(
        value: &Spanned<DeValue<'_>>,
        path: &str,
        holds: &dyn Fn(Range<usize>) -> bool,
    ) -> Option<String> {
        let inner = match value.get_ref() {
            DeValue::Table(table) => in_table(table, path, holds),
            DeValue::Array(list) => list.iter().find_map(|value| in_value(value, path, holds)),
            _ => None,
        };
        inner.or_else(|| holds(value.span()).then(|| path.to_owned()))
    }
    in_table(document.get_ref(), "", &holds)
}

fn with_remedy(error: Error, advice: Option<&str>, picture: Option<&str>) -> Error {
    match (advice, picture) {
        (Some(advice), Some(picture)) => error.remedy(format!("{advice}\n{picture}")),
        (Some(advice), None) => error.remedy(advice),
        (None, Some(picture)) => error.remedy(format!("check this line\n{picture}")),
        (None, None) => error,
    }
}

/// The position of a span: line number from 1, column from 0, the line, and the width. Columns count
/// characters.
fn locate(text: &str, span: &Range<usize>) -> (usize, usize, String, usize) {
    let start = floor_char_boundary(text, span.start);
    let end = floor_char_boundary(text, span.end).max(start);
    let before = text.get(..start).unwrap_or_default();
    let number = before.matches('\n').count() + 1;
    let line_start = before.rfind('\n').map_or(0, |at| at + 1);
    let line = text.get(line_start..).unwrap_or_default().lines().next().unwrap_or_default();
    let column = text.get(line_start..start).unwrap_or_default().chars().count();
    let marked = text.get(start..end).unwrap_or_default().lines().next().unwrap_or_default();
    // A tab becomes one blank, so that the caret stays below its place.
    (number, column, line.replace('\t', " "), marked.chars().count().max(1))
}

/// The section of a long line around a position, with the adjusted column and width.
fn excerpt(column: usize, line: String, width: usize) -> (usize, String, usize) {
    if line.chars().count() <= MAX_SHOWN_CHARACTERS {
        return (column, line, width);
    }
    let from = column.saturating_sub(MAX_SHOWN_CHARACTERS / 3);
    let shown: String = line.chars().skip(from).take(MAX_SHOWN_CHARACTERS).collect();
    let [before, after] =
        [from > 0, line.chars().count() > from + MAX_SHOWN_CHARACTERS].map(|cut| if cut { "…" } else { "" });
    let column = column - from + before.chars().count();
    (
        column,
        format!("{before}{shown}{after}"),
        width.min(MAX_SHOWN_CHARACTERS + 1 - column.min(MAX_SHOWN_CHARACTERS)),
    )
}

/// The last character boundary at or before a byte.
fn floor_char_boundary(text: &str, byte: usize) -> usize {
    (0..=byte.min(text.len())).rev().find(|at| text.is_char_boundary(*at)).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_sheet_lines_are_excerpted_in_errors() {
        let line = format!("{}x{}", "a".repeat(500), "b".repeat(500));
        let told = at_span(&line, &(500..501), "wrong", None).remedy.unwrap();
        let lines: Vec<&str> = told.lines().collect();
        let at = |line: &str, c: char| line.chars().position(|other| other == c);
        assert!(lines[1].chars().count() < 140 && at(lines[1], 'x') == at(lines[2], '^'), "{told}");
        let told = at_span(&line, &(10..900), "wrong", None).remedy.unwrap();
        assert!(told.lines().all(|line| line.chars().count() < 140), "{told}");
    }

    #[test]
    fn spans_are_located_by_line_and_column() {
        assert_eq!(locate("a\nbü = 1\n", &(2..5)), (2, 0, "bü = 1".into(), 2));
        assert_eq!(locate("", &(0..0)), (1, 0, String::new(), 1));
        assert_eq!(locate("ab", &(9..12)), (1, 2, "ab".into(), 1));
    }
}
