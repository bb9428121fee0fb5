//! Comparison results as Markdown, for the summary of a pull request.

use std::fmt::Write as _;

use crate::diff::findings::finding::Diff;
use crate::diff::findings::ink_totals::Measure;

/// Most rows of a table.
const MAX_TABLE_ROWS: usize = 40;

impl Diff {
    /// The comparison as Markdown with a heading.
    #[must_use]
    pub fn to_markdown(&self, title: &str) -> String {
        let mut out = format!("### {}\n\n{}\n", escape(title), escape(&self.summary()));
        let told = self.report_lines();
        if !told.is_empty() {
            out.push_str("\n| | marks | |\n| --- | ---: | --- |\n");
            for row in told.iter().take(MAX_TABLE_ROWS) {
                let detail = row.line.split_once(' ').map_or("", |(_, rest)| rest.trim_start());
                let _ = writeln!(out, "| {} | {} | {} |", row.verdict.name(), row.count, escape(detail));
            }
            if told.len() > MAX_TABLE_ROWS {
                let _ = writeln!(out, "| | | and {} more |", told.len() - MAX_TABLE_ROWS);
            }
        }
        let changed: Vec<(&String, &Measure)> =
            self.totals.parts.iter().filter(|(_, measure)| is_changed(measure)).collect();
        if !self.is_same() && !changed.is_empty() {
            out.push_str("\n| part | marks | length | area |\n| --- | ---: | ---: | ---: |\n");
            let unit = self.unit();
            for (part, measure) in changed.iter().take(MAX_TABLE_ROWS) {
                let name = if part.is_empty() { "no part" } else { part };
                let _ = writeln!(
                    out,
                    "| {} | {} → {} | {} → {} | {} → {} |",
                    escape(name),
                    measure.marks[0],
                    measure.marks[1],
                    unit.length(measure.length[0]),
                    unit.length(measure.length[1]),
                    unit.area(measure.area[0]),
                    unit.area(measure.area[1]),
                );
            }
        }
        out
    }
}

/// Whether the ink of a part changed noticeably.
fn is_changed(measure: &Measure) -> bool {
    let differs = |[a, b]: [f64; 2]| (a - b).abs() > 0.5;
    measure.marks[0] != measure.marks[1] || differs(measure.length) || differs(measure.area)
}

/// Escapes text for Markdown. Names between backticks stay readable.
fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\n' | '\r' => out.push(' '),
            '|' | '*' | '_' | '<' | '[' | ']' | '\\' => out.extend(['\\', c]),
            _ => out.push(c),
        }
    }
    out
}
