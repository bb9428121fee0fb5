//! How an element is painted, derived from its own attributes and those of its ancestors.

use rustc_hash::FxHashSet;
use usvg::roxmltree::{Attribute, Document, Node, NodeType};

use crate::export::paths::canonical_path::PathForm;

/// Elements whose content is drawn elsewhere or in another form.
const INDIRECT_ELEMENTS: [&str; 7] = ["defs", "symbol", "clipPath", "mask", "pattern", "marker", "glyph"];
/// Elements that only describe their parent.
const DESCRIPTIVE_ELEMENTS: [&str; 3] = ["title", "desc", "metadata"];
/// Prefixes of properties that affect neither the order nor the direction of a path.
const SAFE_PROPERTY_PREFIXES: [&str; 17] = [
    "fill",
    "stroke",
    "opacity",
    "color",
    "display",
    "visibility",
    "shape-rendering",
    "clip-rule",
    "paint-order",
    "vector-effect",
    "font",
    "text",
    "line-height",
    "letter-spacing",
    "word-spacing",
    "overflow",
    "solid-",
];
/// Attributes of editors that store how a path was made.
const EDITOR_ATTRIBUTES: [&str; 4] = ["nodetypes", "type", "original-d", "path-effect"];

/// Properties of a document that affect elements at a distance.
#[derive(Debug, Default)]
pub(crate) struct DocumentContext<'a> {
    /// Whether style sheets or scripts may change any paint.
    sheets: bool,
    /// Ids that are referenced.
    referred: FxHashSet<&'a str>,
}

impl<'a> DocumentContext<'a> {
    /// Collects style sheets, scripts and references of a document.
    pub fn of(document: &'a Document) -> Self {
        let mut afar = Self::default();
        for node in document.descendants() {
            let sheet = match node.node_type() {
                NodeType::PI => node.pi().is_some_and(|pi| pi.target == "xml-stylesheet"),
                NodeType::Element => matches!(node.tag_name().name(), "style" | "script"),
                _ => false,
            };
            afar.sheets |= sheet;
            for attribute in node.attributes() {
                let value = attribute.value();
                if attribute.name() == "href" {
                    afar.referred.extend(value.trim().strip_prefix('#'));
                }
                for rest in value.split("url(").skip(1) {
                    let rest = rest.trim_start_matches(['"', '\'', ' ']);
                    let id = rest.strip_prefix('#').and_then(|rest| rest.split(['"', '\'', ')', ' ']).next());
                    afar.referred.extend(id);
                }
            }
        }
        afar
    }
}

/// Rewrites of a path that keep the picture the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct PathRewrite {
    pub form: PathForm,
    /// Whether all points must stay, because markers or animations depend on them.
    pub all_points: bool,
}

/// How an element is painted.
#[derive(Debug, Clone)]
pub(crate) struct ComputedStyle<'a> {
    fill: &'a str,
    stroke: &'a str,
    dashed: bool,
    /// Whether the other fields may be wrong.
    unsure: bool,
    /// Whether the element is used elsewhere, animated, or has markers.
    used: bool,
    /// Whether the order and direction of the marks matter.
    ordered: bool,
}

impl<'a> ComputedStyle<'a> {
    /// Initial style at the root.
    pub fn new(afar: &DocumentContext) -> Self {
        Self {
            fill: "black",
            stroke: "none",
            dashed: false,
            unsure: afar.sheets,
            used: false,
            ordered: false,
        }
    }

    /// Style of a child element.
    pub fn inside(&self, node: Node<'a, '_>, afar: &DocumentContext) -> Self {
        let mut look = self.clone();
        look.used |= INDIRECT_ELEMENTS.contains(&node.tag_name().name());
        look.ordered |= node.attribute("data-order").is_some();
        for attribute in node.attributes() {
            match (attribute.namespace(), attribute.name()) {
                (None, "id") => look.used |= afar.referred.contains(attribute.value()),
                (None, "d" | "style") => {}
                (None, name) => look.set(name, attribute.value()),
                // The path is generated from another path, or the editor lists its corners.
                (Some(_), name) => look.used |= EDITOR_ATTRIBUTES.contains(&name),
            }
        }
        // The `style` attribute has precedence over attributes.
        match declarations(node.attribute("style").unwrap_or_default()) {
            Some(list) => list.iter().for_each(|(name, value)| look.set(name, value)),
            None => look.unsure = true,
        }
        let moves =
            |child: &Node| child.tag_name().name().starts_with("animate") || child.has_tag_name("set");
        look.used |= node.children().filter(Node::is_element).any(|child| moves(&child));
        look
    }

    /// Applies a property to the style.
    fn set(&mut self, name: &str, value: &'a str) {
        let value = value.trim();
        let painting = match name {
            "fill" | "stroke" | "stroke-dasharray" => true,
            "all" | "d" | "pathLength" => {
                self.unsure = true;
                false
            }
            _ => {
                // Markers are inherited from ancestors.
                self.used |= name.starts_with("marker") && name != "markerUnits" && value != "none";
                self.unsure |= name.starts_with("animation") || name.starts_with("transition");
                false
            }
        };
        if !painting || value == "inherit" {
            return;
        }
        // Variables, and keywords that exist in style sheets only.
        self.unsure |=
            value.is_empty() || value.contains("var(") || ["initial", "unset", "revert"].contains(&value);
        match name {
            "fill" => self.fill = value,
            "stroke" => self.stroke = value,
            _ => self.dashed = value != "none",
        }
    }

    /// Rewrites allowed for a path of this style.
    pub fn leave(&self, path: Node) -> PathRewrite {
        let bears = path.children().filter(Node::is_element).any(|child| !describes(&child));
        let all_points = self.used || bears;
        let (filled, stroked) = (self.fill != "none", self.stroke != "none");
        let form = match () {
            () if all_points || self.unsure || self.ordered => PathForm::Kept,
            () if stroked && self.dashed => PathForm::Kept,
            () if filled => PathForm::Filled,
            () if stroked => PathForm::Stroked,
            () => PathForm::Kept,
        };
        PathRewrite { form, all_points }
    }

    /// Whether a path of this style may change places with a neighbour of equal paint. It needs one flat
    /// colour and no property that depends on the order.
    pub fn may_be_exchanged(&self, path: Node) -> bool {
        let parent = path.parent_element().is_some_and(|p| matches!(p.tag_name().name(), "svg" | "g" | "a"));
        let one_colour = match (self.fill, self.stroke) {
            ("none", colour) | (colour, "none") => is_flat(colour),
            _ => false,
        };
        let knows = |attribute: Attribute| match (attribute.namespace(), attribute.name()) {
            (Some(_), _) | (None, "class" | "id" | "d" | "transform" | "role") => true,
            (None, "style") => declarations(attribute.value())
                .is_some_and(|list| list.iter().all(|(n, v)| is_harmless(n, v))),
            (None, name) => name.starts_with("data-") || is_harmless(name, attribute.value()),
        };
        let described = path.children().filter(Node::is_element).all(|child| describes(&child));
        let sure = !self.unsure && !self.used && !self.ordered;
        sure && parent && one_colour && described && path.attributes().all(knows)
    }
}

/// Whether two paths have equal attributes, except for geometry, identity and dashes.
pub(crate) fn painted_alike(a: Node, b: Node) -> bool {
    fn paints<'a>(node: Node<'a, '_>) -> Vec<(Option<&'a str>, &'a str, &'a str)> {
        let counts = |attribute: &Attribute| {
            let name = attribute.name();
            let told = matches!(name, "d" | "class" | "id" | "stroke-dasharray" | "stroke-dashoffset");
            attribute.namespace().is_some() || !(told || name.starts_with("data-"))
        };
        let mut found: Vec<_> = node
            .attributes()
            .filter(counts)
            .map(|attribute| (attribute.namespace(), attribute.name(), attribute.value()))
            .collect();
        found.sort_unstable();
        found
    }
    paints(a) == paints(b)
}

fn describes(child: &Node) -> bool {
    DESCRIPTIVE_ELEMENTS.contains(&child.tag_name().name())
}

fn is_harmless(name: &str, value: &str) -> bool {
    SAFE_PROPERTY_PREFIXES.iter().any(|known| name.starts_with(known))
        || matches!(value.trim(), "none" | "normal" | "auto")
}

/// Whether a paint is a single colour.
fn is_flat(paint: &str) -> bool {
    let word = !paint.is_empty() && paint.bytes().all(|b| b.is_ascii_alphabetic());
    word || paint.starts_with('#') || paint.starts_with("rgb")
}

/// Declarations of a `style` attribute; `None` if it is more than a plain list.
fn declarations(style: &str) -> Option<Vec<(&str, &str)>> {
    if style.contains("/*") || style.contains(['{', '}', '\\']) {
        return None;
    }
    let parts = style.split(';').map(str::trim).filter(|part| !part.is_empty());
    parts
        .map(|part| {
            let (name, value) = part.split_once(':')?;
            let name = name.trim();
            let value = value.split('!').next()?.trim();
            // A semicolon inside quotes or brackets would have split the value.
            let whole =
                !value.contains(['"', '\'']) && value.matches('(').count() == value.matches(')').count();
            (whole && !name.starts_with("--") && !name.contains(|c: char| c.is_ascii_uppercase()))
                .then_some((name, value))
        })
        .collect()
}
