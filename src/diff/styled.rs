//! A file without style sheets: what they say of each element is written at it.

use std::fmt::Write as _;

use rustc_hash::FxHashSet;
use usvg::roxmltree::Node;

use super::cascade::Cascade;
use super::guard;
use super::sheet::{self, Declaration};
use super::tags::too_much;
use crate::error::Error;

/// Bytes of a style that are looked through before readers get it.
const LONG: usize = 4096;
/// Declarations of which only the last of each property is kept, and properties that an element may have.
const MANY: usize = 64;
const MOST_PROPERTIES: usize = 1000;

/// The file with what its style sheets say in attributes `style`, for readers that would search long for what a selector
/// means; `None` where entities make it unsure which text is whose.
pub(super) fn without_sheets(text: &str) -> Result<Option<String>, Error> {
    let document = guard::parse(text)?;
    let mut cascade = Cascade::of(&document);
    let styles = || document.descendants().filter_map(|node| node.attribute("style"));
    if cascade.is_empty() && !styles().any(is_long) {
        return Ok(Some(text.to_owned()));
    }
    if text.contains("<!ENTITY") {
        return Ok(None);
    }
    let mut edits = Vec::new();
    collect(text, document.root_element(), &mut cascade, &mut edits)?;
    Ok(Some(edited(text, edits)))
}

/// Replaces ranges of a text, none of which overlap.
pub(super) fn edited(text: &str, mut edits: Vec<(std::ops::Range<usize>, String)>) -> String {
    edits.sort_by_key(|(range, _)| range.start);
    let mut out = String::with_capacity(text.len());
    let mut at = 0;
    for (range, new) in edits {
        out.push_str(text.get(at..range.start).unwrap_or_default());
        out.push_str(&new);
        at = range.end;
    }
    out.push_str(text.get(at..).unwrap_or_default());
    out
}

fn collect(
    text: &str,
    node: Node,
    cascade: &mut Cascade,
    edits: &mut Vec<(std::ops::Range<usize>, String)>,
) -> Result<(), Error> {
    let declared = cascade.enter(node)?;
    if node.has_tag_name("style") {
        edits.push((node.range(), String::new()));
    } else {
        let own_is_long = node.attribute("style").is_some_and(is_long);
        if !declared.is_empty() || own_is_long {
            let own = node.attributes().find(|a| a.namespace().is_none() && a.name() == "style");
            let style = style(declared, own.map(|own| own.value()).unwrap_or_default())?;
            match own {
                Some(own) => edits.push((own.range(), style)),
                None => {
                    let at = after_name(text, node);
                    edits.push((at..at, format!(" {style}")));
                }
            }
        }
        for child in node.children().filter(Node::is_element) {
            collect(text, child, cascade, edits)?;
        }
    }
    cascade.leave();
    Ok(())
}

/// Where the name of an element ends.
pub(super) fn after_name(text: &str, node: Node) -> usize {
    let start = node.range().start;
    let rest = text.get(start..).unwrap_or_default();
    start + rest.find(|c: char| c.is_whitespace() || matches!(c, '/' | '>')).unwrap_or(rest.len())
}

/// Whether a style is longer than any that is written by hand or program.
fn is_long(style: &str) -> bool {
    style.len() > LONG
}

/// The attribute that says what sheets declare and the element's own style does.
fn style<'a>(mut declared: Vec<Declaration<'a>>, own: &'a str) -> Result<String, Error> {
    let mut rest = "";
    match sheet::declarations(own) {
        Some(list) => declared.extend(list),
        None => rest = own,
    }
    // Readers take time in proportion to the square of this. What is said of one thing several times may be meant for programs
    // that do not know the last of it; said so often it is not.
    if declared.len() > MANY {
        let mut said: FxHashSet<(&str, bool)> = FxHashSet::default();
        declared = declared.into_iter().rev().filter(|d| said.insert((d.name, d.important))).collect();
        declared.reverse();
    }
    if declared.len() > MOST_PROPERTIES || is_long(rest) {
        return Err(too_much("declarations in a style"));
    }
    let mut out = String::from("style=\"");
    for Declaration { name, value, important } in declared {
        let _ = write!(out, "{name}:{}{};", escaped(value), if important { " !important" } else { "" });
    }
    Ok(out + &escaped(rest) + "\"")
}

pub(super) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}
