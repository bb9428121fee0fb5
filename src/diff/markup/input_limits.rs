//! Parsing of untrusted XML. Files that would take more time or memory than their length justifies are
//! refused before anything is expanded.

use rustc_hash::FxHashMap;
use usvg::roxmltree::{self, Document, Node, NodeId, ParsingOptions};

use super::tag_limits::{self, MAX_DEPTH, too_deep, too_much};
use crate::error::Error;

/// Most elements of a file.
const MAX_NODES: u32 = 8_000_000;
/// Most bytes drawn through references, in addition to four times the length of the file.
const MAX_REFERENCED_BYTES: u64 = 200_000_000;

/// Parses an SVG file after checking its limits.
pub(crate) fn parse(text: &str) -> Result<Document<'_>, Error> {
    before_parsing(text)?;
    let options = ParsingOptions { allow_dtd: true, nodes_limit: MAX_NODES, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options).map_err(in_words)?;
    let root = document.root_element();
    if root.tag_name().name() != "svg" {
        return Err(Error::new(format!("the root element is `{}`, not `svg`", root.tag_name().name()))
            .at("line 1")
            .remedy("give an SVG file"));
    }
    ElementWeights::new(&document).check(text.len())?;
    Ok(document)
}

/// The parser's error message with its position in the file.
fn in_words(error: roxmltree::Error) -> Error {
    let line = error.pos();
    let text = error.to_string();
    let message = text.split(" at ").next().unwrap_or("cannot be read").to_owned();
    Error::new(format!("the file is not well-formed XML: {message}"))
        .at(format!("line {}, column {}", line.row, line.col))
        .remedy("give a whole SVG file")
}

/// Checks that must happen before the parser runs.
fn before_parsing(text: &str) -> Result<(), Error> {
    let start = text.trim_start_matches('\u{feff}').trim_start();
    if start.is_empty() {
        return Err(Error::new("the file is empty").remedy("give an SVG file"));
    }
    if !start.starts_with('<') {
        return Err(Error::new("is not SVG").at("line 1").remedy("give an SVG file"));
    }
    tag_limits::check(text)
}

/// Size of each element with all its references expanded.
struct ElementWeights<'a, 'input> {
    ids: FxHashMap<&'a str, Node<'a, 'input>>,
    known: FxHashMap<NodeId, Option<ElementWeight>>,
    root: Node<'a, 'input>,
}

/// Expanded size of an element in bytes, and the height of its tree.
#[derive(Clone, Copy, Default)]
struct ElementWeight {
    bytes: u64,
    height: usize,
}

impl<'a, 'input> ElementWeights<'a, 'input> {
    fn new(document: &'a Document<'input>) -> Self {
        let named = document.descendants().filter_map(|node| Some((node.attribute("id")?, node)));
        Self { ids: named.collect(), known: FxHashMap::default(), root: document.root_element() }
    }

    /// Refuses a document whose references expand to too many bytes.
    fn check(mut self, length: usize) -> Result<(), Error> {
        let weight = self.of(self.root, 0)?;
        let limit = MAX_REFERENCED_BYTES.saturating_add(4 * length as u64);
        if weight.bytes > limit {
            return Err(too_much("the references in the file expand to hundreds of megabytes"));
        }
        Ok(())
    }

    /// Size of an element that is `depth` levels deep.
    fn of(&mut self, node: Node<'a, 'input>, depth: usize) -> Result<ElementWeight, Error> {
        match self.known.get(&node.id()) {
            Some(Some(known)) if depth + known.height <= MAX_DEPTH => return Ok(*known),
            Some(Some(_)) => return Err(too_deep()),
            Some(None) => {
                let name = node.attribute("id").unwrap_or_default();
                return Err(Error::new(format!("`{name}` refers to itself")).remedy("remove the reference"));
            }
            None if depth > MAX_DEPTH => return Err(too_deep()),
            None => {}
        }
        // Marks the element as in progress: reaching it again means that it refers to itself.
        self.known.insert(node.id(), None);
        let mut weight = ElementWeight { bytes: 64, height: 0 };
        let mut add = |inner: ElementWeight, times: u64| {
            weight.bytes = weight.bytes.saturating_add(inner.bytes.saturating_mul(times));
            weight.height = weight.height.max(inner.height + 1);
        };
        for attribute in node.attributes() {
            let value = attribute.value();
            // Embedded pictures are not decoded: a rectangle stands for them.
            let is_picture = node.tag_name().name() == "image" && attribute.name() == "href";
            let bytes = if is_picture { 0 } else { value.len() as u64 };
            add(ElementWeight { bytes, height: 0 }, 1);
            let href =
                value.strip_prefix('#').filter(|_| attribute.name() == "href" && draws_its_target(node));
            // A marker is drawn at every point of a path.
            let times = match value.contains("marker") || attribute.name().starts_with("marker") {
                true => {
                    node.attribute("d").or(node.attribute("points")).map_or(1, |d| 1 + d.len() as u64 / 2)
                }
                false => 1,
            };
            let references = value.split("url(").skip(1).filter_map(|rest| {
                rest.trim_start_matches(['"', '\'', ' '])
                    .strip_prefix('#')?
                    .split(['"', '\'', ')', ' '])
                    .next()
            });
            for id in references.chain(href) {
                if let Some(target) = self.ids.get(id).copied() {
                    add(self.of(target, depth + 1)?, times);
                }
            }
        }
        for child in node.children().filter(Node::is_element) {
            add(self.of(child, depth + 1)?, 1);
        }
        self.known.insert(node.id(), Some(weight));
        Ok(weight)
    }
}

/// Whether a link makes an element draw its target. Links of texts and animations do not.
fn draws_its_target(node: Node) -> bool {
    matches!(
        node.tag_name().name(),
        "use" | "linearGradient" | "radialGradient" | "pattern" | "filter" | "feImage" | "mask" | "clipPath"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse_result(svg: &str) -> String {
        parse(svg).err().map_or_else(|| "read".to_owned(), |error| error.to_string())
    }

    fn svg_with(text: &str) -> String {
        format!("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"9\" height=\"9\">{text}</svg>")
    }

    #[test]
    fn parse_refuses_svg_bombs() {
        let mut laughs = String::from("<g id=\"a0\"><path d=\"M0 0h1\"/></g>");
        for level in 1..40 {
            let below = level - 1;
            laughs += &format!("<g id=\"a{level}\"><use href=\"#a{below}\"/><use href=\"#a{below}\"/></g>");
        }
        assert!(parse_result(&svg_with(&laughs)).contains("multiply"));
        let deep = "<g>".repeat(400) + &"</g>".repeat(400);
        assert!(parse_result(&svg_with(&deep)).contains("256 deep"));
        let cycle = "<g id=\"a\"><use href=\"#b\"/></g><g id=\"b\"><use href=\"#a\"/></g>";
        assert!(parse_result(&svg_with(cycle)).contains("refers to itself"));
        let entities =
            "<!DOCTYPE svg [<!ENTITY a \"aaaa\"><!ENTITY b \"&a;&a;\">]>".to_owned() + &svg_with("&b;");
        assert!(parse_result(&entities).contains("made of entities"));
        let long =
            format!("<!DOCTYPE svg [<!ENTITY a \"{}\">]>{}", "a".repeat(9000), svg_with(&"&a;".repeat(9000)));
        assert!(parse_result(&long).contains("uses of entities"));
        let many: String = (0..600).map(|i| format!(" a{i}=\"\"")).collect();
        assert!(parse_result(&svg_with(&format!("<g{many}/>"))).contains("600 attributes"));
        let marked = format!("<marker id=\"m\">{}</marker>", "<path d=\"M0 0h1\"/>".repeat(900))
            + &format!("<path marker-mid=\"url(#m)\" d=\"M0 0{}\"/>", "h1".repeat(90_000));
        assert!(parse_result(&svg_with(&marked)).contains("multiply"));
    }

    #[test]
    fn parse_errors_explain_files_that_are_not_svg() {
        for (text, word) in [
            ("", "empty"),
            ("solid cube", "not SVG"),
            ("<html/>", "`html`"),
            ("<svg xmlns=\"http://www.w3.org/2000/svg\"><path d=\"M0", "well-formed"),
            ("\u{0}\u{1}", "not SVG"),
        ] {
            assert!(parse_result(text).contains(word), "{text}: {}", parse_result(text));
        }
    }

    #[test]
    fn parse_accepts_ordinary_svg_files() {
        let picture = format!("<image id=\"p\" href=\"data:image/png;base64,{}\"/>", "A".repeat(1 << 20));
        let used = "<use href=\"#p\"/>".repeat(2000);
        assert_eq!(parse_result(&svg_with(&format!("<defs>{picture}</defs>{used}"))), "read");
        let plain = "<defs><g id=\"a\"><path d=\"M0 0h1\"/></g></defs><use href=\"#a\"/><use href=\"#a\"/>";
        assert_eq!(parse_result(&svg_with(plain)), "read");
        let style = "g,h{fill:red;stroke:none}".repeat(20_000);
        assert_eq!(parse_result(&svg_with(&format!("<style>{style}</style>"))), "read");
        let entity = "<!DOCTYPE svg [<!ENTITY ns \"http://x\">]>".to_owned() + &svg_with("<g a=\"&ns;\"/>");
        assert_eq!(parse_result(&entity), "read");
    }
}
