//! Text lists: a heading with the count, and one entry per line.

use std::fmt::Write;

use crate::cli::output::number_text::counted;

/// Maximum number of list entries without `--all`.
pub(crate) const MAX_SHOWN_ENTRIES: usize = 20;

/// A name, or a placeholder for an empty one.
pub(crate) fn named(name: &str) -> &str {
    if name.is_empty() { "(no name)" } else { name }
}

/// Writes a heading with the count and up to `most` entries. An empty list writes nothing.
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
        // Names may contain line breaks and terminal control codes.
        let _ = writeln!(text, "    {}", entry.replace(char::is_control, " "));
    }
    if n > most {
        let _ = writeln!(text, "    and {} more (--all lists them)", n - most);
    }
}
