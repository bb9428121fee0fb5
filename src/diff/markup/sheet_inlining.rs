//! Style sheets replaced by `style` attributes.

use usvg::roxmltree::Node;

use super::cascade::Cascade;
use super::inline_style::{is_long, merged_declarations};
use super::input_limits;
use crate::error::Error;

/// The file with the declarations of its style sheets in `style` attributes, for readers that match selectors
/// slowly. `None` if the file has entities, because text positions are ambiguous then.
pub(crate) fn inline_sheets(text: &str) -> Result<Option<String>, Error> {
    let document = input_limits::parse(text)?;
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

/// Replaces non-overlapping ranges of a text.
pub(crate) fn edited(text: &str, mut edits: Vec<(std::ops::Range<usize>, String)>) -> String {
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

/// Collects the edits of an element and its children.
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
            let style =
                format!("style=\"{}\"", merged_declarations(&declared, own.map_or("", |own| own.value()))?);
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

/// Byte position after the name of an element.
pub(crate) fn after_name(text: &str, node: Node) -> usize {
    let start = node.range().start;
    let rest = text.get(start..).unwrap_or_default();
    start + rest.find(|c: char| c.is_whitespace() || matches!(c, '/' | '>')).unwrap_or(rest.len())
}
