//! Report of differences as text, JSON and Markdown.

use std::io::IsTerminal;

use serde_json::{Value, json};

use super::DiffArgs;
use super::comparison::FileComparison;
use super::input_pairs::InputPairs;
use crate::cli::json_files;
use crate::diff::Verdict;

/// Text for a terminal: the findings of one drawing, or a heading and findings for each drawing of a folder.
pub(crate) fn text(comparisons: &[(String, FileComparison)], pairing: &InputPairs, all: bool) -> String {
    let coloured = std::io::stdout().is_terminal() && std::env::var_os("NO_COLOR").is_none();
    let mut out = String::new();
    let mut push_line = |line: &str| {
        out.push_str(&if coloured { paint(line) } else { line.to_owned() });
        out.push('\n');
    };
    for (name, comparison) in comparisons {
        match comparison {
            FileComparison::Only(side) => {
                push_line(&format!("{:<10} {name}", if *side == 0 { "removed" } else { "added" }));
            }
            FileComparison::Both(diff) => {
                if pairing.folders {
                    push_line(&format!("{name}: {}", diff.summary()));
                }
                let lines = if all { diff.all_lines() } else { diff.lines() };
                lines.iter().for_each(|line| push_line(line));
                if !pairing.folders {
                    push_line(&diff.summary());
                }
            }
        }
    }
    if pairing.folders {
        let differ = comparisons.iter().filter(|(_, told)| !told.is_same()).count();
        push_line(&format!("{differ} of {} drawings differ", comparisons.len()));
    }
    out
}

/// Colours the verdict at the start of a line.
fn paint(line: &str) -> String {
    let verdict = Verdict::ALL.into_iter().find(|verdict| line.starts_with(verdict.name()));
    let code = match verdict {
        Some(Verdict::Removed) => "31",
        Some(Verdict::Added) => "32",
        Some(Verdict::Moved | Verdict::Reshaped) => "34",
        Some(Verdict::Restyled | Verdict::Restacked | Verdict::Page | Verdict::Picture) => "33",
        Some(Verdict::Relabelled) => "35",
        None => return line.to_owned(),
    };
    let (word, rest) = line.split_at(line.find(' ').unwrap_or(line.len()));
    format!("\x1b[{code}m{word}\x1b[0m{rest}")
}

/// JSON: one object for a single drawing, a list for folders.
pub(crate) fn json(comparisons: &[(String, FileComparison)], pairing: &InputPairs) -> String {
    let value = |comparison: &FileComparison| match comparison {
        FileComparison::Only(side) => {
            json!({ "same": false, "only": if *side == 0 { "before" } else { "after" } })
        }
        // The JSON comes from this crate, so parsing succeeds.
        FileComparison::Both(diff) => serde_json::from_str(&diff.to_json()).unwrap_or(Value::Null),
    };
    let document = if pairing.folders {
        let entry = |(name, comparison): &(String, FileComparison)| json!({ "name": name, "diff": value(comparison) });
        let same = comparisons.iter().all(|(_, told)| told.is_same());
        json!({ "same": same, "drawings": comparisons.iter().map(entry).collect::<Vec<_>>() })
    } else {
        comparisons.first().map_or(Value::Null, |(_, told)| value(told))
    };
    json_files::text(&document)
}

/// Markdown with a section for each drawing that differs.
pub(crate) fn markdown(comparisons: &[(String, FileComparison)], args: &DiffArgs) -> String {
    let differ = comparisons.iter().filter(|(_, told)| !told.is_same()).count();
    let (before, after) = (args.before.display(), args.after.display());
    let mut out = format!("## {before} → {after}\n\n");
    out += &match (comparisons.len(), differ) {
        (_, 0) => "Nothing differs.\n".to_owned(),
        (1, _) => String::new(),
        (all, differ) => format!("{differ} of {all} drawings differ.\n\n"),
    };
    for (name, comparison) in comparisons.iter().filter(|(_, told)| !told.is_same()) {
        match comparison {
            FileComparison::Only(side) => {
                out += &format!(
                    "### {name}\n\nThe drawing is {}.\n\n",
                    if *side == 0 { "removed" } else { "new" }
                );
            }
            FileComparison::Both(diff) => out += &(diff.to_markdown(name) + "\n"),
        }
    }
    out
}
