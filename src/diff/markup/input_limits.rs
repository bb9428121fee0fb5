//! Parsing of untrusted XML. Files above plain limits on size, depth and number of elements are refused.
//!
//! 1. The tags are counted before the file is parsed. The tokenizer has the grammar of the parser, and files
//!    that it does not accept are refused.
//! 2. The elements of the parsed file are counted with each reference replaced by its target.

use rustc_hash::{FxHashMap, FxHashSet};
use usvg::roxmltree::{self, Document, Node, NodeId, ParsingOptions};
use xmlparser::{ElementEnd, EntityDefinition, Token, Tokenizer};

use super::url_references::references;
use crate::error::Error;

/// Most nodes of a file.
const MAX_NODES: u32 = 8_000_000;
/// Most elements with each reference replaced by its target.
const MAX_EXPANDED_ELEMENTS: u64 = 4_000_000;
/// Greatest nesting depth of elements, including references.
const MAX_DEPTH: usize = 256;
/// Most attributes of one element. The parser compares each pair.
const MAX_ATTRIBUTES: usize = 512;
/// Most namespace prefixes of a file. The parser copies them for each element that declares one.
const MAX_NAMESPACES: usize = 64;
/// Most bytes of expanded entities.
const MAX_ENTITY_BYTES: usize = 16_000_000;
/// Character references that need no declaration.
const PREDEFINED_ENTITIES: [&str; 6] = ["#", "amp;", "lt;", "gt;", "quot;", "apos;"];

/// Parses an SVG file after checking its limits.
pub(crate) fn parse(text: &str) -> Result<Document<'_>, Error> {
    let start = text.trim_start_matches('\u{feff}').trim_start();
    if start.is_empty() {
        return Err(Error::new("the file is empty").remedy("give an SVG file"));
    }
    if !start.starts_with('<') {
        return Err(Error::new("is not SVG").at("line 1").remedy("give an SVG file"));
    }
    check_tags(text)?;
    let options = ParsingOptions { allow_dtd: true, nodes_limit: MAX_NODES, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options).map_err(|error: roxmltree::Error| {
        malformed(error.to_string().split(" at ").next(), error.pos().row, error.pos().col)
    })?;
    let root = document.root_element();
    if root.tag_name().name() != "svg" {
        return Err(Error::new(format!("the root element is `{}`, not `svg`", root.tag_name().name()))
            .at("line 1")
            .remedy("give an SVG file"));
    }
    let named = document.descendants().filter_map(|node| Some((node.attribute("id")?, node)));
    let mut expansion = Expansion { ids: named.collect(), known: FxHashMap::default() };
    if expansion.of(root, 0)?.elements > MAX_EXPANDED_ELEMENTS {
        return Err(too_much("elements, with each reference replaced by its target"));
    }
    Ok(document)
}

fn malformed(message: Option<&str>, row: u32, column: u32) -> Error {
    Error::new(format!("the file is not well-formed XML: {}", message.unwrap_or("cannot be read")))
        .at(format!("line {row}, column {column}"))
        .remedy("give a whole SVG file")
}

pub(super) fn too_much(what: &str) -> Error {
    Error::new(format!("the file has too many {what}"))
        .remedy("save the drawing as plain SVG, without references that multiply")
}

fn too_deep() -> Error {
    Error::new(format!("elements are nested more than {MAX_DEPTH} deep"))
        .remedy("ungroup the drawing, or save it as plain SVG")
}

/// Refuses files that the parser would take too long for.
fn check_tags(text: &str) -> Result<(), Error> {
    let (mut depth, mut attributes, mut entity_bytes, mut entity_uses) = (0usize, 0usize, 0usize, 0usize);
    let mut prefixes: FxHashSet<&str> = FxHashSet::default();
    for token in Tokenizer::from(text) {
        // Errors such as `invalid element at 1:2 cause expected '=' not '/' at 1:9`.
        let token = token.map_err(|error| {
            let text = error.to_string();
            let cause = text.split_once(" cause ").map_or(&*text, |(_, cause)| cause);
            malformed(cause.split(" at ").next(), error.pos().row, error.pos().col)
        })?;
        match token {
            Token::ElementStart { .. } => attributes = 0,
            Token::Attribute { prefix, local, value, .. } => {
                attributes += 1;
                entity_uses += entity_references(&value);
                if prefix == "xmlns" {
                    prefixes.insert(local.as_str());
                }
            }
            Token::ElementEnd { end: ElementEnd::Open, .. } => depth += 1,
            Token::ElementEnd { end: ElementEnd::Close(..), .. } => depth = depth.saturating_sub(1),
            Token::Text { text } => entity_uses += entity_references(&text),
            Token::EntityDeclaration { definition: EntityDefinition::EntityValue(value), .. } => {
                entity_bytes += value.len();
                if entity_references(&value) > 0 {
                    return Err(too_much("entities that are made of entities"));
                }
                if value.matches('=').count() > MAX_ATTRIBUTES || value.contains("xmlns") {
                    return Err(too_much("attributes or namespaces in an entity"));
                }
            }
            _ => {}
        }
        if attributes > MAX_ATTRIBUTES {
            return Err(too_much("attributes of one element"));
        }
        if prefixes.len() > MAX_NAMESPACES {
            return Err(too_much("namespaces"));
        }
        if depth > MAX_DEPTH {
            return Err(too_deep());
        }
    }
    match entity_uses.saturating_mul(entity_bytes) > MAX_ENTITY_BYTES {
        true => Err(too_much(&format!("uses of entities ({entity_uses})"))),
        false => Ok(()),
    }
}

/// Number of references to entities that must be declared.
fn entity_references(text: &str) -> usize {
    let rests = text.split('&').skip(1);
    rests.filter(|rest| !PREDEFINED_ENTITIES.iter().any(|known| rest.starts_with(known))).count()
}

/// Counts of each element with its references replaced by their targets.
struct Expansion<'a, 'input> {
    ids: FxHashMap<&'a str, Node<'a, 'input>>,
    /// Counts by element; `None` while an element is being counted.
    known: FxHashMap<NodeId, Option<ExpandedCount>>,
}

/// Number of elements, and height of their tree.
#[derive(Clone, Copy)]
struct ExpandedCount {
    elements: u64,
    height: usize,
}

impl<'a, 'input> Expansion<'a, 'input> {
    /// Counts an element that is `depth` levels deep.
    fn of(&mut self, node: Node<'a, 'input>, depth: usize) -> Result<ExpandedCount, Error> {
        match self.known.get(&node.id()) {
            Some(Some(known)) if depth + known.height <= MAX_DEPTH => return Ok(*known),
            Some(Some(_)) => return Err(too_deep()),
            Some(None) => {
                let name = node.attribute("id").unwrap_or_default();
                return Err(Error::new(format!("`{name}` refers to itself")).remedy("remove the reference"));
            }
            None if depth > MAX_DEPTH => return Err(too_deep()),
            None => drop(self.known.insert(node.id(), None)),
        }
        let mut count = ExpandedCount { elements: 1, height: 0 };
        let mut add = |inner: ExpandedCount, times: u64| {
            count.elements = count.elements.saturating_add(inner.elements.saturating_mul(times));
            count.height = count.height.max(inner.height + 1);
        };
        for attribute in node.attributes() {
            let value = attribute.value();
            let href =
                value.strip_prefix('#').filter(|_| attribute.name() == "href" && draws_its_target(node));
            // A marker is drawn at every point of a path.
            let is_marker = attribute.name().starts_with("marker") || value.contains("marker");
            let course = node.attribute("d").or(node.attribute("points")).filter(|_| is_marker);
            let times = course.map_or(1, |points| 1 + points.len() as u64 / 2);
            for id in references(value).flatten().chain(href) {
                if let Some(target) = self.ids.get(id).copied() {
                    add(self.of(target, depth + 1)?, times);
                }
            }
        }
        for child in node.children().filter(Node::is_element) {
            add(self.of(child, depth + 1)?, 1);
        }
        self.known.insert(node.id(), Some(count));
        Ok(count)
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

    fn attributes(count: usize) -> String {
        (0..count).map(|i| format!(" a{i}=\"\"")).collect()
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
        assert!(parse_result(&svg_with(&format!("<g{}/>", attributes(600)))).contains("attributes"));
        let marked = format!("<marker id=\"m\">{}</marker>", "<path d=\"M0 0h1\"/>".repeat(900))
            + &format!("<path marker-mid=\"url(#m)\" d=\"M0 0{}\"/>", "h1".repeat(90_000));
        assert!(parse_result(&svg_with(&marked)).contains("multiply"));
        let names: String = (0..500).map(|i| format!(" xmlns:n{i}=\"u\"")).collect();
        let copies = "<g xmlns:a=\"b\"/>".repeat(20_000);
        assert!(parse_result(&svg_with(&format!("<g{names}>{copies}</g>"))).contains("namespaces"));
    }

    #[test]
    fn parse_refuses_entities_that_multiply() {
        let with = |value: &str, text: &str| {
            parse_result(&format!("<!DOCTYPE svg [<!ENTITY e '{value}'>]>{}", svg_with(text)))
        };
        assert!(with("a'><!ENTITY b '&e;&e;", "&b;").contains("made of entities"));
        assert!(with(&"a".repeat(9000), &"&e;".repeat(9000)).contains("uses of entities"));
        assert!(with("<g/>", &"&e;".repeat(5_000_000)).contains("uses of entities"));
        assert!(with(&format!("<g{}/>", attributes(600)), "&e;").contains("attributes"));
        assert!(with(&("<g>".repeat(300) + &"</g>".repeat(300)), "&e;").contains("256 deep"));
        assert!(with("<g xmlns:a=\"b\"/>", "&e;").contains("namespaces"));
        assert_eq!(with("<g/>text<g a=\"1\"/>", "&e;<g/>"), "read");
        assert_eq!(with(&"x".repeat(2000), &"<!-- &e; -->&amp;&#60;".repeat(9000)), "read");
    }

    #[test]
    fn parse_errors_explain_files_that_are_not_svg() {
        for (text, word) in [
            ("", "empty"),
            ("solid cube", "not SVG"),
            ("<html/>", "`html`"),
            ("<svg xmlns=\"http://www.w3.org/2000/svg\"><path d=\"M0", "well-formed"),
            (
                "<svg>\n<g a/></svg>",
                "line 2, column 3: the file is not well-formed XML: expected '=' not '/'",
            ),
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
        let usual =
            "<g xmlns=\"http://www.w3.org/2000/svg\" xmlns:i=\"u\" i:label=\"a\"><path i:x=\"\"/></g>";
        assert_eq!(parse_result(&svg_with(&usual.repeat(100_000))), "read");
        let many = attributes(600);
        assert_eq!(parse_result(&svg_with(&format!("<!-- <g{many}> --><![CDATA[<g{many}>]]>"))), "read");
    }

    /// Work that grows faster than the text would not finish here.
    #[test]
    fn parse_terminates_on_millions_of_repetitions() {
        let doctype = "<!DOCTYPE svg [<!ENTITY a 'b'>";
        for piece in
            ["<g a='1'>", "<!--", "<!-- - -->", "<![CDATA[", "]]", "<?a ", doctype, "<g ", "&", "'", "\n"]
        {
            for start in ["<svg>", "<!DOCTYPE svg [", ""] {
                _ = parse(&(start.to_owned() + &piece.repeat(4_000_000 / piece.len())));
            }
        }
    }
}
