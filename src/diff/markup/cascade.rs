//! CSS cascade of a document, in time linear in elements times matching selector parts.
//!
//! Elements are entered and left in document order. For each part of a selector, a counter stores how many
//! open elements match it and all parts before it. So each selector is tested once per element and part. A
//! search through the ancestors would start again at each element and grow exponentially with nested
//! selectors.

use rustc_hash::FxHashSet;
use usvg::roxmltree::{Document, Node};

use super::css_sheet::{
    AttributeTest, Combinator, CompoundSelector, CssSheet, Declaration, SelectorIndex, SelectorPart,
};
use super::tag_limits::too_much;
use crate::error::Error;

/// Most tests of selector parts against elements in a file.
const MAX_SELECTOR_TRIALS: usize = 40_000_000;
/// Most bytes of declarations applied to elements in a file.
const MAX_DECLARATION_BYTES: usize = 64_000_000;

/// Style sheets of a document, evaluated at the current element.
pub(crate) struct Cascade<'a> {
    sheet: CssSheet<'a>,
    index: SelectorIndex<'a>,
    /// Number of open elements that match each selector part.
    around: Vec<u32>,
    open: Vec<Level>,
    trials: usize,
    given: usize,
    /// Whether the sheets contain rules that are not applied.
    pub has_more: bool,
}

/// State of an open element.
#[derive(Default)]
struct Level {
    /// Selector parts that the element matches.
    fits: Vec<u32>,
    /// Parts matched by its last child, and parts matched by any earlier child that a `~` combinator may
    /// follow.
    last: Vec<u32>,
    earlier: FxHashSet<u32>,
    has_children: bool,
}

impl<'a> Cascade<'a> {
    /// Reads the style sheets inside a document.
    pub(crate) fn of(document: &'a Document) -> Self {
        let mut sheet = CssSheet::default();
        let mut has_more = false;
        for node in document.descendants() {
            if node.has_tag_name("style") {
                match node.attribute("type") {
                    None | Some("text/css" | "") => sheet.read(node.text().unwrap_or_default()),
                    Some(_) => has_more = true,
                }
                has_more |= node.attribute("media").is_some_and(|media| !matches!(media, "all" | "screen"));
            }
        }
        has_more |= sheet.has_more;
        let index = sheet.index();
        let around = vec![0; sheet.parts.len()];
        Self { sheet, index, around, open: vec![Level::default()], trials: 0, given: 0, has_more }
    }

    /// Whether there are no rules.
    pub(crate) fn is_empty(&self) -> bool {
        self.sheet.rules.is_empty()
    }

    /// Enters an element and returns its declarations from the sheets, in order of increasing precedence.
    ///
    /// # Errors
    /// If rules times elements exceed the limits.
    pub(crate) fn enter(&mut self, node: Node) -> Result<Vec<Declaration<'a>>, Error> {
        if self.is_empty() {
            return Ok(Vec::new());
        }
        let mut level = Level::default();
        let first = self.open.last().is_some_and(|parent| !parent.has_children);
        let class = node.attribute("class").unwrap_or_default();
        fn of(list: Option<&Vec<u32>>) -> &[u32] {
            list.map_or(&[], Vec::as_slice)
        }
        let mut lists = vec![
            self.index.any.as_slice(),
            of(self.index.names.get(node.tag_name().name())),
            of(node.attribute("id").and_then(|id| self.index.ids.get(id))),
        ];
        let mut words: Vec<&str> = class.split_ascii_whitespace().collect();
        words.sort_unstable();
        words.dedup();
        lists.extend(words.into_iter().map(|word| of(self.index.classes.get(word))));
        let mut won: Vec<usize> = Vec::new();
        for number in lists.into_iter().flatten() {
            let Some(part) = self.sheet.parts.get(*number as usize) else { continue };
            // Tests of long attributes count more.
            let tests = part.compound.tests.iter();
            let long = tests.map(|(name, _)| 1 + node.attribute(*name).map_or(0, str::len) / 64);
            self.trials += 1 + long.sum::<usize>();
            if self.trials > MAX_SELECTOR_TRIALS {
                let rules = self.sheet.rules.len();
                return Err(too_much(&format!("{rules} style rules for a drawing of this size")));
            }
            if self.is_in_place(*number, part) && fits(&part.compound, node, first) {
                level.fits.push(*number);
                won.extend(part.rule);
            }
        }
        level.fits.sort_unstable();
        for number in &level.fits {
            if let Some(count) = self.around.get_mut(*number as usize) {
                *count += 1;
            }
        }
        self.open.push(level);
        won.sort_unstable_by_key(|rule| (self.sheet.rules.get(*rule).map(|rule| rule.weight), *rule));
        let blocks = won.iter().filter_map(|rule| self.sheet.blocks.get(self.sheet.rules.get(*rule)?.block));
        let mut found: Vec<Declaration> = Vec::new();
        for block in blocks {
            self.given += block.iter().map(|d| d.name.len() + d.value.len() + 2).sum::<usize>();
            if self.given > MAX_DECLARATION_BYTES {
                return Err(too_much("declarations in style rules for a drawing of this size"));
            }
            found.extend_from_slice(block);
        }
        Ok(found)
    }

    /// Leaves the element entered last.
    pub(crate) fn leave(&mut self) {
        if self.is_empty() {
            return;
        }
        let Some(level) = self.open.pop() else { return };
        for number in &level.fits {
            if let Some(count) = self.around.get_mut(*number as usize) {
                *count -= 1;
            }
        }
        if let Some(parent) = self.open.last_mut() {
            let parts = &self.sheet.parts;
            let may_follow = |number: &&u32| {
                parts.get(**number as usize).is_some_and(|part| part.next == Some(Combinator::After))
            };
            parent.earlier.extend(level.fits.iter().filter(may_follow));
            parent.last = level.fits;
            parent.has_children = true;
        }
    }

    /// Whether the part before this one matched an element in the required relation.
    fn is_in_place(&self, number: u32, part: &SelectorPart) -> bool {
        let Some(before) = number.checked_sub(1) else { return part.relation == Combinator::First };
        let parent = self.open.last();
        match part.relation {
            Combinator::First => true,
            Combinator::Inside => self.around.get(before as usize).is_some_and(|count| *count > 0),
            Combinator::Child => parent.is_some_and(|parent| parent.fits.binary_search(&before).is_ok()),
            Combinator::Next => parent.is_some_and(|parent| parent.last.binary_search(&before).is_ok()),
            Combinator::After => parent.is_some_and(|parent| parent.earlier.contains(&before)),
        }
    }
}

/// Whether an element matches one compound selector.
fn fits(compound: &CompoundSelector, node: Node, first: bool) -> bool {
    let named = compound.name.is_none_or(|name| name == node.tag_name().name());
    named
        && (first || !compound.first_child)
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
    fn declared_values(svg: &str) -> String {
        fn inside(node: Node, cascade: &mut Cascade, out: &mut String) {
            let list = cascade.enter(node).unwrap();
            let values: Vec<&str> = list.iter().map(|declaration| declaration.value).collect();
            if !values.is_empty() {
                *out += &format!("{}={} ", node.attribute("n").unwrap_or("?"), values.join(","));
            }
            node.children().filter(Node::is_element).for_each(|child| inside(child, cascade, out));
            cascade.leave();
        }
        let document = Document::parse(svg).unwrap();
        let mut out = String::new();
        inside(document.root_element(), &mut Cascade::of(&document), &mut out);
        out
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
            let found: Vec<String> =
                declared_values(&svg).split_whitespace().map(|word| word.replace("=1", "")).collect();
            assert_eq!(found.join(" "), wanted, "{selector}");
        }
    }

    #[test]
    fn cascade_bounds_the_work_of_style_rules() {
        let refused = |sheet: &str, body: &str| {
            fn inside(node: Node, cascade: &mut Cascade) -> Result<(), Error> {
                cascade.enter(node)?;
                node.children().filter(Node::is_element).try_for_each(|child| inside(child, cascade))?;
                cascade.leave();
                Ok(())
            }
            let svg = format!("<s><style>{sheet}</style>{body}</s>");
            let document = Document::parse(&svg).unwrap();
            inside(document.root_element(), &mut Cascade::of(&document))
                .err()
                .map_or_else(|| "read".to_owned(), |error| error.to_string())
        };
        let many = "<g/>".repeat(20_000);
        assert!(refused(&"g{fill:red}".repeat(20_000), &many).contains("style rules"));
        assert!(refused(&format!("{}g{{fill:red}}", "g,".repeat(20_000)), &many).contains("style rules"));
        let long = format!("g{{{}}}", "a:b;".repeat(20_000));
        assert!(refused(&long, &many).contains("declarations"));
        // Selectors with names are only tried on elements with those names.
        let named: String = (0..20_000).map(|i| format!(".c{i} g.d{i}{{fill:red}}")).collect();
        assert_eq!(refused(&named, &many), "read");
        // A search through the ancestors would take (groups)^(names) steps.
        let nested = "<g>".repeat(200) + "<p/>" + &"</g>".repeat(200);
        assert_eq!(refused(&format!("x {}p{{fill:red}}", "g ".repeat(60)), &nested), "read");
        assert_eq!(refused(&format!("x {}p{{fill:red}}", "g ".repeat(60)).repeat(1000), &nested), "read");
    }

    #[test]
    fn cascade_orders_rules_by_specificity() {
        let sheet = "#i{v:4} p{v:1} .x{v:2} g .x{v:3}";
        assert_eq!(
            declared_values(&format!("<s><style>{sheet}</style><g><p n='a' id='i' class='x'/></g></s>")),
            "a=1,2,3,4 "
        );
    }
}
