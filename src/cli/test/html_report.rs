//! Report of the test as an HTML page: each case before, after, and the difference.
//!
//! The page is a single file without scripts. Check boxes and keyboard focus are handled in CSS.

use std::fmt::Write;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::MAX_SHOWN_FINDINGS;
use super::case_outcome::{CaseOutcome, CaseTotals, CaseVerdict};
use crate::export::encoding::xml::escaped;

/// Style sheet of the page.
const PAGE_CSS: &str = include_str!("report.css");

/// Writes the page. Passing cases have pictures only if `all` is set.
pub(crate) fn page(folder: &str, outcomes: &[CaseOutcome<'_>], all: bool, blessed: bool) -> String {
    let (folder, totals) = (escaped(folder), escaped(&CaseTotals::of(outcomes).line(blessed)));
    let mut html = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n\
         <title>{folder}: {totals}</title>\n<style>\n{PAGE_CSS}</style>\n</head>\n<body>\n\
         <h1>{folder}</h1>\n<p>{totals}</p>\n\
         <input type=\"checkbox\" id=\"failed\"/> <label for=\"failed\">only what failed</label>\n<main>\n"
    );
    for outcome in outcomes {
        section(&mut html, outcome, all, blessed);
    }
    html.push_str("</main>\n</body>\n</html>\n");
    html
}

fn section(html: &mut String, outcome: &CaseOutcome<'_>, all: bool, blessed: bool) {
    let is_blessed = blessed && matches!(outcome.verdict, CaseVerdict::Differs(_) | CaseVerdict::New);
    let word = if is_blessed { "blessed" } else { outcome.verdict.word() };
    let name = escaped(&outcome.case.name);
    let _ = writeln!(html, "<section class=\"{word}\">\n<h2>{name} <span>{word}</span></h2>");
    let summary = outcome.summary(blessed);
    if !summary.is_empty() {
        // Some errors contain an excerpt with the wrong line.
        let tag = if summary.contains('\n') { "pre" } else { "p" };
        let _ = writeln!(html, "<{tag}>{}</{tag}>", text(&summary));
    }
    if all || !matches!(outcome.verdict, CaseVerdict::Passed) {
        html.push_str("<div>\n");
        picture(html, "before", outcome.before.as_deref());
        picture(html, "after", outcome.after.as_deref());
        picture(html, "difference", outcome.difference().as_deref());
        html.push_str("</div>\n");
    }
    let lines = outcome.lines();
    let (first, rest) = lines.split_at(lines.len().min(MAX_SHOWN_FINDINGS));
    list(html, first);
    if !rest.is_empty() {
        let _ = writeln!(html, "<details>\n<summary>and {} more</summary>", rest.len());
        list(html, rest);
        html.push_str("</details>\n");
    }
    html.push_str("</section>\n");
}

fn list(html: &mut String, lines: &[String]) {
    if lines.is_empty() {
        return;
    }
    html.push_str("<ul>\n");
    for line in lines {
        let _ = writeln!(html, "<li>{}</li>", escaped(line));
    }
    html.push_str("</ul>\n");
}

/// Escapes text and keeps its line breaks.
fn text(text: &str) -> String {
    text.lines().map(escaped).collect::<Vec<_>>().join("\n")
}

/// Adds a drawing as an embedded image, so that ids and classes of several drawings do not collide.
fn picture(html: &mut String, caption: &str, svg: Option<&str>) {
    let Some(svg) = svg else { return };
    let data = STANDARD.encode(svg);
    let _ = writeln!(
        html,
        "<figure><img tabindex=\"0\" alt=\"{caption}\" src=\"data:image/svg+xml;base64,{data}\"/>\
         <figcaption>{caption}</figcaption></figure>"
    );
}
