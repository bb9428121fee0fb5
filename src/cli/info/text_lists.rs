//! Lists as people read them: a heading with the count, and an entry a line.

use std::fmt::Write;

use crate::cli::output::number_text::counted;

/// Entries of a list that people see without `--all`.
pub(crate) const SHOWN: usize = 20;

/// A name, or a stand-in for an empty one.
pub(crate) fn named(name: &str) -> &str {
    if name.is_empty() { "(no name)" } else { name }
}

/// A heading with the count, and up to `most` entries below it; nothing for an empty list.
pub(crate) fn list(
    text: &mut String,
    noun: &str,
    most: usize,
    entries: impl ExactSizeIterator<Item = String>,
) {
    let n = entries.len();
    if n == 0 {
        return;
    }
    let _ = writeln!(text, "  {}:", counted(n as u64, noun));
    for entry in entries.take(most) {
        // A name may hold line ends or the codes of a terminal.
        let _ = writeln!(text, "    {}", entry.replace(char::is_control, " "));
    }
    if n > most {
        let _ = writeln!(text, "    and {} more (--all lists them)", n - most);
    }
}
