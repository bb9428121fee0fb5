//! Styles as presentation attributes: `style` attributes and style sheets are replaced by SVG attributes.

use std::fmt::Write as _;
use std::ops::Range;

use usvg::roxmltree::{Document, Node, NodeType};

use crate::diff::markup::cascade::Cascade;
use crate::diff::markup::css_sheet::{self, Declaration};
use crate::diff::markup::{input_limits, is_svg};
use crate::error::Error;

/// Properties that also exist as attributes with the same values.
const PRESENTATION_PROPERTIES: &str = "alignment-baseline baseline-shift clip-path clip-rule color color-interpolation \
     color-interpolation-filters color-rendering direction display dominant-baseline fill fill-opacity \
     fill-rule filter flood-color flood-opacity font-family font-size font-stretch font-style font-variant \
     font-weight image-rendering letter-spacing lighting-color marker-end marker-mid marker-start mask \
     opacity overflow paint-order pointer-events shape-rendering stop-color stop-opacity stroke \
     stroke-dasharray stroke-dashoffset stroke-linecap stroke-linejoin stroke-miterlimit stroke-opacity \
     stroke-width text-anchor text-decoration text-rendering visibility word-spacing";

/// Most declarations of one element.
const MAX_DECLARATIONS: usize = 512;

/// The file with its styles as attributes. `None` if it has no styles, or if they cannot all be expressed as
/// attributes: media rules, pointer states, scripts or entities.
pub(crate) fn plain(text: &str) -> Result<Option<String>, Error> {
    let document = input_limits::parse(text)?;
    if text.contains("<!ENTITY")
        || !document.descendants().any(|node| has_style(&node))
        || is_moving(&document)
    {
        return Ok(None);
    }
    let cascade = Cascade::of(&document);
    let mut edits = StyleEdits { text, list: Vec::new() };
    if cascade.has_more {
        return Ok(None);
    }
    for node in document.descendants().filter(Node::is_element) {
        let declared = cascade.declared(node)?;
        let is_fine = match is_svg(&node) {
            true if node.tag_name().name() == "style" => {
                edits.list.push((node.range(), String::new()));
                true
            }
            true => edits.element(node, &declared),
            false => declared.is_empty(),
        };
        if !is_fine {
            return Ok(None);
        }
    }
    Ok((!edits.list.is_empty()).then(|| edits.apply()))
}

fn is_presentation(name: &str) -> bool {
    PRESENTATION_PROPERTIES.split(' ').any(|known| known == name)
}

/// Escapes text for an attribute.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}

fn has_style(node: &Node) -> bool {
    node.is_element() && is_svg(node) && (node.has_attribute("style") || node.tag_name().name() == "style")
}

/// Whether scripts or animations may query styles later.
fn is_moving(document: &Document) -> bool {
    document.descendants().any(|node| match node.node_type() {
        NodeType::PI => node.pi().is_some_and(|pi| pi.target == "xml-stylesheet"),
        NodeType::Element => {
            let name = node.tag_name().name();
            name == "script" || name == "set" || name.starts_with("animate") || name == "foreignObject"
        }
        _ => false,
    })
}

/// Edits of a file as byte ranges and their new text.
struct StyleEdits<'a> {
    text: &'a str,
    list: Vec<(Range<usize>, String)>,
}

impl StyleEdits<'_> {
    /// The edited text.
    fn apply(mut self) -> String {
        self.list.sort_by_key(|(range, _)| range.start);
        let mut out = String::with_capacity(self.text.len());
        let mut at = 0;
        for (range, new) in self.list {
            out.push_str(self.text.get(at..range.start).unwrap_or_default());
            out.push_str(&new);
            at = range.end;
        }
        out + self.text.get(at..).unwrap_or_default()
    }

    /// Collects the edits of one element; `false` if its style cannot be expressed as attributes.
    fn element(&mut self, node: Node, declared: &[Declaration]) -> bool {
        let own = node.attributes().find(|a| a.namespace().is_none() && a.name() == "style");
        let style = own.map(|own| own.value()).unwrap_or_default();
        let Some(own_list) = css_sheet::declarations(style) else { return false };
        if declared.is_empty() && own_list.is_empty() {
            return true;
        }
        if declared.len() + own_list.len() > MAX_DECLARATIONS {
            return false;
        }
        let mut won: Vec<Declaration> = Vec::new();
        for declaration in declared.iter().chain(&own_list) {
            match won.iter_mut().find(|other| other.name == declaration.name) {
                Some(other) if other.important && !declaration.important => {}
                Some(other) => *other = *declaration,
                None => won.push(*declaration),
            }
        }
        let is_plain = |declaration: &Declaration| {
            let words = ["initial", "unset", "revert", "revert-layer"];
            let value = declaration.value;
            let computed = value.contains("var(") || value.contains("calc(");
            is_presentation(declaration.name) && !words.contains(&value) && !computed
        };
        let (plain, rest): (Vec<Declaration>, Vec<Declaration>) = won.into_iter().partition(is_plain);
        // A shorthand property would be written after its longhands and override them. Values that exist in
        // style sheets only stay in the style.
        let several = |other: &Declaration| matches!(other.name, "font" | "marker" | "all" | "mask-image");
        let unsure = rest.iter().any(|other| several(other) || is_presentation(other.name));
        if unsure || plain.is_empty() {
            return declared.is_empty() || !unsure && own_list.is_empty() && rest.is_empty();
        }
        let mut new = String::new();
        for Declaration { name, value, .. } in &plain {
            let _ = write!(new, " {name}=\"{}\"", escaped(value));
        }
        if !rest.is_empty() {
            let said = |other: &Declaration| {
                format!("{}:{}{}", other.name, other.value, if other.important { " !important" } else { "" })
            };
            let said: Vec<String> = rest.iter().map(said).collect();
            let _ = write!(new, " style=\"{}\"", escaped(&said.join(";")));
        }
        // The end of the element's name.
        let start = node.range().start;
        let rest = self.text.get(start..).unwrap_or_default();
        let at = start + rest.find(|c: char| c.is_whitespace() || "/>".contains(c)).unwrap_or(rest.len());
        self.list.push((at..at, new));
        for attribute in node.attributes().filter(|a| a.namespace().is_none()) {
            let replaced = plain.iter().any(|declaration| declaration.name == attribute.name());
            if replaced || attribute.name() == "style" {
                let range = attribute.range();
                let before = self.text.get(..range.start).unwrap_or_default();
                let start = before.trim_end().len().max(at);
                self.list.push((start..range.end, String::new()));
            }
        }
        true
    }
}
