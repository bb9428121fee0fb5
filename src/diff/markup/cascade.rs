//! CSS cascade of a document: the declarations that apply to an element, in order of precedence.
//!
//! Selectors are matched from right to left. If no ancestor matches a part of a selector, the search does not
//! start again from other ancestors. The tests and declarations for a whole file are counted, and files with
//! too many are refused.

use std::cell::Cell;

use rustc_hash::FxHashMap;
use usvg::roxmltree::{Document, Node};

use super::css_sheet::{AttributeTest, Combinator, CompoundSelector, CssRule, CssSheet, Declaration};
use super::input_limits::too_much;
use crate::error::Error;

/// Most work for the style sheets of a file: tests of elements, and bytes of declarations applied.
const MAX_STYLE_WORK: usize = 64_000_000;

/// Style sheets of a document.
pub(crate) struct Cascade<'a> {
    /// Rules in order of increasing precedence.
    rules: Vec<CssRule<'a>>,
    blocks: Vec<Vec<Declaration<'a>>>,
    /// Rules by the most selective condition on the element: its `id`, a word of its `class`, or its `name`.
    index: FxHashMap<(&'static str, &'a str), Vec<usize>>,
    work: Cell<usize>,
    /// Whether the sheets contain rules that are not applied.
    pub has_more: bool,
}

/// Result of matching a selector to an element.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum SelectorMatch {
    Yes,
    No,
    /// No other ancestor needs to be tried either.
    NoAncestor,
}

impl<'a> Cascade<'a> {
    /// Reads the style sheets inside a document.
    pub(crate) fn of(document: &'a Document) -> Self {
        let mut sheet = CssSheet::default();
        let mut has_more = false;
        for node in document.descendants().filter(|node| node.has_tag_name("style")) {
            match node.attribute("type") {
                None | Some("text/css" | "") => sheet.read(node.text().unwrap_or_default()),
                Some(_) => has_more = true,
            }
            has_more |= node.attribute("media").is_some_and(|media| !matches!(media, "all" | "screen"));
        }
        let CssSheet { mut rules, blocks, has_more: sheet_has_more } = sheet;
        rules.sort_by_cached_key(CssRule::weight);
        let mut index: FxHashMap<(&str, &str), Vec<usize>> = FxHashMap::default();
        for (number, rule) in rules.iter().enumerate() {
            let Some(last) = rule.selector.last() else { continue };
            let of = |wanted: &'static str| {
                last.tests.iter().find_map(|(name, test)| match test {
                    AttributeTest::Equals(value) | AttributeTest::Word(value) if *name == wanted => {
                        Some((wanted, *value))
                    }
                    _ => None,
                })
            };
            let key = of("id").or(of("class")).or(last.name.map(|name| ("name", name)));
            index.entry(key.unwrap_or(("", ""))).or_default().push(number);
        }
        Self { rules, blocks, index, work: Cell::new(0), has_more: has_more || sheet_has_more }
    }

    /// The declarations of an element from the sheets, in order of increasing precedence.
    ///
    /// # Errors
    /// If the work for the file exceeds its limit.
    pub(crate) fn declared(&self, node: Node) -> Result<Vec<Declaration<'a>>, Error> {
        if self.rules.is_empty() {
            return Ok(Vec::new());
        }
        let words = node.attribute("class").unwrap_or_default().split_ascii_whitespace();
        let keys = [("", ""), ("name", node.tag_name().name()), ("id", node.attribute("id").unwrap_or(""))];
        let keys = keys.into_iter().chain(words.map(|word| ("class", word)));
        let mut candidates: Vec<usize> =
            keys.filter_map(|key| self.index.get(&key)).flatten().copied().collect();
        candidates.sort_unstable();
        candidates.dedup();
        let mut found: Vec<Declaration> = Vec::new();
        for rule in candidates.into_iter().filter_map(|number| self.rules.get(number)) {
            if self.matches(&rule.selector, node) == SelectorMatch::Yes {
                let block = self.blocks.get(rule.block).map_or(&[][..], Vec::as_slice);
                self.add_work(block.iter().map(|d| d.name.len() + d.value.len() + 2).sum());
                found.extend_from_slice(block);
            }
            if self.work.get() > MAX_STYLE_WORK {
                let rules = self.rules.len();
                return Err(too_much(&format!("{rules} style rules for a drawing of this size")));
            }
        }
        Ok(found)
    }

    fn add_work(&self, work: usize) {
        self.work.set(self.work.get().saturating_add(work));
    }

    /// Matches a selector to an element, from its last part.
    fn matches<'n, 'i>(&self, selector: &[CompoundSelector], node: Node<'n, 'i>) -> SelectorMatch {
        let Some((last, before)) = selector.split_last() else { return SelectorMatch::Yes };
        // Tests of long attributes count more.
        let tests = last.tests.iter().map(|(name, _)| 1 + node.attribute(*name).map_or(0, str::len) / 64);
        self.add_work(1 + tests.sum::<usize>());
        if self.work.get() > MAX_STYLE_WORK || !fits(last, node) {
            return SelectorMatch::No;
        }
        type Step<'n, 'i> = fn(&Node<'n, 'i>) -> Option<Node<'n, 'i>>;
        let one = |node: Option<Node>| node.map_or(SelectorMatch::No, |node| self.matches(before, node));
        let any = |step: Step<'n, 'i>, none: SelectorMatch| {
            let mut found = std::iter::successors(step(&node), step).map(|node| self.matches(before, node));
            found.find(|found| *found != SelectorMatch::No).unwrap_or(none)
        };
        match last.relation {
            Combinator::First => SelectorMatch::Yes,
            Combinator::Child => one(node.parent_element()),
            Combinator::Next => one(node.prev_sibling_element()),
            Combinator::Inside => any(Node::parent_element, SelectorMatch::NoAncestor),
            Combinator::After => any(Node::prev_sibling_element, SelectorMatch::No),
        }
    }
}

/// Whether an element matches one compound selector.
fn fits(compound: &CompoundSelector, node: Node) -> bool {
    let named = compound.name.is_none_or(|name| name == node.tag_name().name());
    named
        && (!compound.first_child || node.prev_sibling_element().is_none())
        && compound.tests.iter().all(|(name, test)| {
            node.attribute(*name).is_some_and(|value| match *test {
                AttributeTest::Exists => true,
                AttributeTest::Equals(wanted) => value == wanted,
                AttributeTest::Word(wanted) => value.split_ascii_whitespace().any(|word| word == wanted),
                AttributeTest::Language(wanted) => {
                    value.strip_prefix(wanted).is_some_and(|rest| rest.is_empty() || rest.starts_with('-'))
                }
                AttributeTest::Begins(wanted) => !wanted.is_empty() && value.starts_with(wanted),
                AttributeTest::Ends(wanted) => !wanted.is_empty() && value.ends_with(wanted),
                AttributeTest::Contains(wanted) => !wanted.is_empty() && value.contains(wanted),
            })
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The declared values of each element, keyed by its attribute `n`.
    fn declared_values(svg: &str) -> Result<String, Error> {
        let document = Document::parse(svg).unwrap();
        let cascade = Cascade::of(&document);
        let mut out = String::new();
        for node in document.descendants().filter(Node::is_element) {
            let list = cascade.declared(node)?;
            let values: Vec<&str> = list.iter().map(|declaration| declaration.value).collect();
            if !values.is_empty() {
                out += &format!("{}={} ", node.attribute("n").unwrap_or("?"), values.join(","));
            }
        }
        Ok(out)
    }

    #[test]
    fn cascade_matches_css_selectors() {
        let body = "<g n='a' class='x y'><g n='b'><p n='c' id='i'/><p n='d' k='en-us'/><q n='e'/></g></g><p n='f' class='xy'/>";
        for (selector, wanted) in [
            ("p", "c d f"),
            ("g p", "c d"),
            ("g g p", "c d"),
            ("g g g p", ""),
            ("g > p", "c d"),
            (".x > p", ""),
            (".x p", "c d"),
            (".x > g p", "c d"),
            (".x.y > g > p + p", "d"),
            ("p ~ q", "e"),
            ("p + q", "e"),
            ("#i ~ q", "e"),
            ("q ~ p", ""),
            ("p:first-child", "c"),
            ("[k|=en]", "d"),
            ("[k^=en][k$='us'][k*=\"-\"]", "d"),
            ("* > * > p", "c d"),
            ("g * ", "b c d e"),
            ("p:hover", ""),
            ("g >> p", ""),
            ("> p", ""),
        ] {
            let svg = format!("<s><style>{}{{v:1}}</style>{body}</s>", selector.replace('>', "&gt;"));
            let found: Vec<String> = declared_values(&svg)
                .unwrap()
                .split_whitespace()
                .map(|word| word.replace("=1", ""))
                .collect();
            assert_eq!(found.join(" "), wanted, "{selector}");
        }
    }

    #[test]
    fn cascade_bounds_the_work_of_style_rules() {
        let refused = |sheet: &str, body: &str| {
            let told = declared_values(&format!("<s><style>{sheet}</style>{body}</s>"));
            told.err().map_or_else(|| "read".to_owned(), |error| error.to_string())
        };
        let many = "<g/>".repeat(20_000);
        assert!(refused(&"g{fill:red}".repeat(20_000), &many).contains("style rules"));
        assert!(refused(&format!("{}g{{fill:red}}", "g,".repeat(20_000)), &many).contains("style rules"));
        let long = format!("g{{{}}}", "a:b;".repeat(20_000));
        assert!(refused(&long, &many).contains("style rules"));
        // Selectors with names are only tried on elements with those names.
        let named: String = (0..20_000).map(|i| format!(".c{i} g.d{i}{{fill:red}}")).collect();
        assert_eq!(refused(&named, &many), "read");
        // A search that starts again from each ancestor would take (groups)^(names) steps.
        let nested = "<g>".repeat(200) + "<p/>" + &"</g>".repeat(200);
        assert_eq!(refused(&format!("x {}p{{fill:red}}", "g ".repeat(60)), &nested), "read");
        assert_eq!(refused(&format!("x {}p{{fill:red}}", "g ".repeat(60)).repeat(1000), &nested), "read");
        let mixed = format!("x &gt; {}p{{fill:red}}", "g ".repeat(60));
        assert!(["read", "style rules"].iter().any(|word| refused(&mixed, &nested).contains(word)));
    }

    #[test]
    fn cascade_orders_rules_by_specificity() {
        let sheet = "#i{v:4} p{v:1} .x{v:2} g .x{v:3}";
        assert_eq!(
            declared_values(&format!("<s><style>{sheet}</style><g><p n='a' id='i' class='x'/></g></s>"))
                .unwrap(),
            "a=1,2,3,4 "
        );
    }
}
