//! What is wrong in a TOML file, with its line, a caret under the place and the nearest known key.

use std::ops::Range;

use crate::error::Error;

/// Of longer lines a part is shown, characters.
const LONGEST: usize = 120;

/// An error of a file's text: at its line, with the line and a caret.
pub(crate) fn in_sheet(text: &str, error: &toml::de::Error) -> Error {
    let (message, advice) = explain(error.message());
    match error.span() {
        Some(span) => at_span(text, &span, &message, advice.as_deref()),
        None => with_remedy(Error::new(message), advice.as_deref(), None),
    }
}

/// An error about a place in a file's text: at its line, with the line and a caret.
pub(crate) fn at_span(text: &str, span: &Range<usize>, message: &str, advice: Option<&str>) -> Error {
    let (number, column, line, width) = locate(text, span);
    let (column, line, width) = excerpt(column, line, width);
    let gutter = number.to_string();
    let blank = " ".repeat(gutter.len());
    let picture = format!(" {gutter} | {line}\n {blank} | {}{}", " ".repeat(column), "^".repeat(width));
    with_remedy(Error::new(message).at(format!("line {number}")), advice, Some(&picture))
}

/// An error of a change on the command line: the place is the change itself.
pub(super) fn in_change(set: &str, text: &str, error: &toml::de::Error) -> Error {
    let (message, advice) = explain(error.message());
    let before = "--set ";
    let picture = error.span().map(|span| {
        let (_, column, _, width) = locate(text, &span);
        // The text that was read is `KEY = VALUE`, perhaps with the value in another form.
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
pub(super) fn place_of_value(text: &str, key: &str) -> String {
    let number = text.lines().position(|line| {
        line.trim_start().strip_prefix(key).is_some_and(|rest| rest.trim_start().starts_with('='))
    });
    number.map_or_else(|| format!("key {key}"), |number| format!("line {}", number + 1))
}

/// The known word that was most likely meant: at most a third of its letters differ.
pub(crate) fn nearest<'a>(word: &str, known: &[&'a str]) -> Option<&'a str> {
    known
        .iter()
        .map(|candidate| (distance(word, candidate), *candidate))
        .min()
        .filter(|(distance, candidate)| *distance <= (candidate.chars().count().max(3)) / 3)
        .map(|(_, candidate)| candidate)
}

fn with_remedy(error: Error, advice: Option<&str>, picture: Option<&str>) -> Error {
    match (advice, picture) {
        (Some(advice), Some(picture)) => error.remedy(format!("{advice}\n{picture}")),
        (Some(advice), None) => error.remedy(advice),
        (None, Some(picture)) => error.remedy(format!("check this line\n{picture}")),
        (None, None) => error,
    }
}

/// The parser's message in the words of this program, and advice.
fn explain(message: &str) -> (String, Option<String>) {
    let message = message.trim().replace('\n', ", ");
    for (theirs, ours, list) in [
        ("unknown field ", "unknown key", "known keys"),
        ("unknown variant ", "unknown value", "known values"),
    ] {
        if let Some(rest) = message.strip_prefix(theirs) {
            let words: Vec<&str> = rest.split('`').skip(1).step_by(2).collect();
            if let Some((word, known)) = words.split_first() {
                let advice = match nearest(word, known) {
                    Some(near) => format!("did you mean `{near}`?"),
                    None => format!("{list}: {}", known.join(", ")),
                };
                return (format!("{ours} `{word}`"), Some(advice));
            }
        }
    }
    if let Some((found, wanted)) =
        message.strip_prefix("invalid type: ").and_then(|rest| rest.split_once(", expected "))
    {
        return (format!("{} does not fit here", plain(found)), Some(format!("write {}", plain(wanted))));
    }
    match message.split_once("; ") {
        Some((what, advice)) => (what.to_owned(), Some(advice.to_owned())),
        None => (message, None),
    }
}

/// A type of value in plain words.
fn plain(text: &str) -> String {
    match text {
        "f64" => "a number".to_owned(),
        "u64" => "a whole number of at least 0".to_owned(),
        "a boolean" => "true or false".to_owned(),
        "a sequence" => "a list, such as [1, 2]".to_owned(),
        _ if text.starts_with("struct ") => "a table".to_owned(),
        _ => text
            .replace("floating point", "number")
            .replace("integer", "number")
            .replace("sequence", "a list")
            .replace("map", "a table"),
    }
}

/// Line number from 1, column from 0, the line, and the width of a place, in characters.
fn locate(text: &str, span: &Range<usize>) -> (usize, usize, String, usize) {
    let start = floor(text, span.start);
    let end = floor(text, span.end).max(start);
    let before = text.get(..start).unwrap_or_default();
    let number = before.matches('\n').count() + 1;
    let line_start = before.rfind('\n').map_or(0, |at| at + 1);
    let line = text.get(line_start..).unwrap_or_default().lines().next().unwrap_or_default();
    let column = text.get(line_start..start).unwrap_or_default().chars().count();
    let marked = text.get(start..end).unwrap_or_default().lines().next().unwrap_or_default();
    // A tab is shown as one blank so that the caret stays below its place.
    (number, column, line.replace('\t', " "), marked.chars().count().max(1))
}

/// Of a line that is too long to be shown what is around the place, with the place in it.
fn excerpt(column: usize, line: String, width: usize) -> (usize, String, usize) {
    if line.chars().count() <= LONGEST {
        return (column, line, width);
    }
    let from = column.saturating_sub(LONGEST / 3);
    let shown: String = line.chars().skip(from).take(LONGEST).collect();
    let [before, after] =
        [from > 0, line.chars().count() > from + LONGEST].map(|cut| if cut { "…" } else { "" });
    let column = column - from + before.chars().count();
    (column, format!("{before}{shown}{after}"), width.min(LONGEST + 1 - column.min(LONGEST)))
}

/// The nearest boundary of characters at or before a byte.
fn floor(text: &str, byte: usize) -> usize {
    (0..=byte.min(text.len())).rev().find(|at| text.is_char_boundary(*at)).unwrap_or(0)
}

/// Letters to insert, delete, replace or swap with the next to turn one word into another (optimal
/// string alignment).
fn distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    let mut rows: Vec<Vec<usize>> = vec![(0..=b.len()).collect()];
    for i in 1..=a.len() {
        let mut row = vec![i];
        for j in 1..=b.len() {
            let replaced = rows[i - 1][j - 1] + usize::from(a[i - 1] != b[j - 1]);
            let mut least = replaced.min(rows[i - 1][j] + 1).min(row[j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                least = least.min(rows[i - 2][j - 2] + 1);
            }
            row.push(least);
        }
        rows.push(row);
    }
    rows.last().and_then(|row| row.last()).copied().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances() {
        assert_eq!(distance("crease_dg", "crease_deg"), 1);
        assert_eq!(distance("wdith", "width"), 1);
        assert_eq!(distance("", "abc"), 3);
        assert_eq!(distance("color", "colour"), 1);
    }

    #[test]
    fn the_nearest_word_is_near() {
        assert_eq!(nearest("colour", &["width", "colour"]), Some("colour"));
        assert_eq!(nearest("fills", &["lines", "chain", "pen"]), None);
        assert_eq!(nearest("x", &[]), None);
    }

    #[test]
    fn of_long_lines_a_part_is_shown() {
        let line = format!("{}x{}", "a".repeat(500), "b".repeat(500));
        let told = at_span(&line, &(500..501), "wrong", None).remedy.unwrap();
        let lines: Vec<&str> = told.lines().collect();
        let at = |line: &str, c: char| line.chars().position(|other| other == c);
        assert!(lines[1].chars().count() < 140 && at(lines[1], 'x') == at(lines[2], '^'), "{told}");
        let told = at_span(&line, &(10..900), "wrong", None).remedy.unwrap();
        assert!(told.lines().all(|line| line.chars().count() < 140), "{told}");
    }

    #[test]
    fn places_inside_text() {
        assert_eq!(locate("a\nbü = 1\n", &(2..5)), (2, 0, "bü = 1".into(), 2));
        assert_eq!(locate("", &(0..0)), (1, 0, String::new(), 1));
        assert_eq!(locate("ab", &(9..12)), (1, 2, "ab".into(), 1));
    }
}
