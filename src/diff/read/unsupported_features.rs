//! Contents of a file that the renderer does not support. They are reported in a note because they are not
//! compared.

use std::collections::BTreeSet;

use usvg::roxmltree::{Document, Node};

use crate::diff::markup::references;

/// Unsupported elements, with their names in reports.
const UNSUPPORTED_ELEMENTS: [(&str, &str); 9] = [
    ("foreignObject", "what is in a foreignObject"),
    ("animate animateMotion animateTransform animateColor set", "animations"),
    ("script", "scripts"),
    ("meshgradient mesh", "mesh gradients"),
    ("hatch", "hatches"),
    ("video", "videos"),
    ("audio", "sounds"),
    ("canvas", "a canvas"),
    ("iframe", "other pages"),
];
/// Unsupported functions in values.
const UNSUPPORTED_FUNCTIONS: &str =
    "var() calc() env() attr() color-mix() light-dark() oklch() oklab() lab() lch()";
/// Other unsupported values by a substring, with their names in reports.
const UNSUPPORTED_VALUES: [(&str, &str); 4] = [
    ("polygon(", "shapes of CSS"),
    ("inset(", "shapes of CSS"),
    ("BackgroundImage", "BackgroundImage in filters"),
    ("BackgroundAlpha", "BackgroundAlpha in filters"),
];
/// Unsupported rules and selectors of style sheets.
const UNSUPPORTED_RULES: &str =
    "@media @font-face @import @supports @container @layer :hover :not() :is() :where() :has()";
/// Other unsupported rules by a substring, with their names in reports.
const UNSUPPORTED_RULE_STARTS: [(&str, &str); 3] =
    [("@keyframes", "animations"), (":nth-", ":nth-child()"), (":last-", ":last-child")];
/// Properties that are supported with this value only.
const UNSUPPORTED_PROPERTIES: [(&str, &str); 12] = [
    ("pathLength", ""),
    ("vector-effect", "none"),
    ("transform-box", "view-box"),
    ("offset-path", "none"),
    ("animation", "none"),
    ("animation-name", "none"),
    ("transition", "none"),
    ("color-interpolation", "sRGB"),
    ("mask-image", "none"),
    ("mask-border", "none"),
    ("backdrop-filter", "none"),
    ("clip", "auto"),
];

/// Names of the unsupported contents of a file. `more`: whether its style sheets have rules that are not
/// applied.
pub(crate) fn unread(document: &Document, more: bool) -> BTreeSet<&'static str> {
    let mut found = BTreeSet::new();
    for node in document.descendants() {
        if node.is_element() {
            element(node, &mut found);
        } else if node.pi().is_some_and(|pi| pi.target == "xml-stylesheet") {
            found.insert("style sheets in other files");
        }
    }
    if more {
        let before = found.len();
        for sheet in document.descendants().filter(|node| node.has_tag_name("style")) {
            let text = sheet.text().unwrap_or_default();
            let rules = rows(UNSUPPORTED_RULES, &UNSUPPORTED_RULE_STARTS);
            found.extend(rules.filter(|(word, _)| text.contains(word)).map(|(_, name)| name));
        }
        if found.len() == before {
            found.insert("some style rules");
        }
    }
    found
}

/// Adds the unsupported contents of one element.
fn element(node: Node, found: &mut BTreeSet<&'static str>) {
    let name = node.tag_name().name();
    let is_named = |(names, _): &&(&str, &str)| names.split(' ').any(|known| known == name);
    found.extend(UNSUPPORTED_ELEMENTS.iter().filter(is_named).map(|(_, words)| *words));
    if name == "text" {
        found.insert("fonts (texts are compared by their words and properties)");
    }
    if name == "style" {
        let text = node.text().unwrap_or_default();
        let values = rows(UNSUPPORTED_FUNCTIONS, &UNSUPPORTED_VALUES);
        found.extend(values.filter(|(word, _)| text.contains(word)).map(|(_, name)| name));
        let properties =
            UNSUPPORTED_PROPERTIES.iter().filter(|(known, _)| known.contains('-') || *known == "animation");
        found.extend(properties.filter(|(known, _)| text.contains(known)).map(|(known, _)| *known));
    }
    for attribute in node.attributes() {
        let (name, value) = (attribute.name(), attribute.value());
        if name == "href" {
            let elsewhere = !value.trim().starts_with('#') && !value.trim().is_empty();
            if elsewhere
                && matches!(
                    node.tag_name().name(),
                    "use" | "feImage" | "linearGradient" | "radialGradient" | "pattern" | "textPath"
                )
            {
                found.insert("elements of other files");
            }
            continue;
        }
        if references(value).any(|id| id.is_none()) {
            found.insert("elements of other files");
        }
        // Skip the bulk of the file.
        if name == "d" || name == "points" || name.starts_with("data-") {
            continue;
        }
        if value.contains('(') || name.starts_with("in") {
            let values = rows(UNSUPPORTED_FUNCTIONS, &UNSUPPORTED_VALUES);
            found.extend(values.filter(|(word, _)| is_in(value, word)).map(|(_, name)| name));
        }
        let other = |(known, initial): &&(&str, &str)| *known == name && value.trim() != *initial;
        found.extend(UNSUPPORTED_PROPERTIES.iter().filter(other).map(|(known, _)| *known));
        if name == "style" {
            let said = |(known, initial): &&(&str, &str)| {
                let named = value.split(';').filter_map(|piece| piece.split_once(':'));
                named.clone().any(|(name, value)| name.trim() == *known && value.trim() != *initial)
            };
            found.extend(UNSUPPORTED_PROPERTIES.iter().filter(said).map(|(known, _)| *known));
        }
    }
}

/// Pairs of a substring and a name in reports: `var(` and `var()`.
fn rows(
    names: &'static str,
    others: &'static [(&'static str, &'static str)],
) -> impl Iterator<Item = (&'static str, &'static str)> {
    names.split(' ').map(|name| (name.trim_end_matches(')'), name)).chain(others.iter().copied())
}

/// Whether a value contains a function: `lab(` is not contained in `oklab(`.
fn is_in(value: &str, word: &str) -> bool {
    let start = |at: usize| {
        value.get(..at).is_none_or(|before| !before.ends_with(|c: char| c.is_ascii_alphanumeric()))
    };
    value.match_indices(word).any(|(at, _)| start(at))
}
