//! Lists as people read them: a heading with the count, and an entry a line.

use std::fmt::Write;

use crate::cli::number::counted;

/// Entries of a list that are shown to people; programs get all.
pub(super) const SHOWN: usize = 20;

/// A name, or a stand-in for an empty one.
pub(super) fn named(name: &str) -> &str {
    if name.is_empty() { "(no name)" } else { name }
}

/// A heading with the count, and the entries below it; nothing for an empty list.
pub(super) fn list(text: &mut String, noun: &str, entries: impl ExactSizeIterator<Item = String>) {
    let n = entries.len();
    if n == 0 {
        return;
    }
    let _ = writeln!(text, "  {}:", counted(n as u64, noun));
    for entry in entries.take(SHOWN) {
        // A name may hold line ends or the codes of a terminal.
        let _ = writeln!(text, "    {}", entry.replace(char::is_control, " "));
    }
    if n > SHOWN {
        let _ = writeln!(text, "    and {} more (--json lists all)", n - SHOWN);
    }
}
