//! CSS style sheets of a file, parsed in one pass into selectors and declarations.

use super::css_reader::CssReader;

/// Most compound selectors of one selector.
const MAX_COMPOUNDS: usize = 64;

/// A CSS declaration such as `fill: red !important`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Declaration<'a> {
    pub name: &'a str,
    pub value: &'a str,
    pub important: bool,
}

/// Relation of a compound selector to the one before it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Combinator {
    /// The first one of its selector.
    First,
    /// The one before matches an ancestor (descendant combinator).
    Inside,
    /// The one before matches the parent (`>`).
    Child,
    /// The one before matches the preceding sibling (`+`).
    Next,
    /// The one before matches any earlier sibling (`~`).
    After,
}

/// Condition on an attribute.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum AttributeTest<'a> {
    Exists,
    Equals(&'a str),
    Word(&'a str),
    Language(&'a str),
    Begins(&'a str),
    Ends(&'a str),
    Contains(&'a str),
}

/// A compound selector such as `path.crease#lid`.
#[derive(Debug, Clone)]
pub(crate) struct CompoundSelector<'a> {
    /// Relation to the compound selector before it.
    pub relation: Combinator,
    pub name: Option<&'a str>,
    pub tests: Vec<(&'a str, AttributeTest<'a>)>,
    pub first_child: bool,
}

/// A selector with its declarations.
#[derive(Debug, Clone)]
pub(crate) struct CssRule<'a> {
    pub selector: Vec<CompoundSelector<'a>>,
    /// Index of the declarations in [`CssSheet::blocks`].
    pub block: usize,
}

impl CssRule<'_> {
    /// Specificity: numbers of ids, of classes and attributes, and of element names.
    pub(crate) fn weight(&self) -> [usize; 3] {
        let mut weight = [0; 3];
        for compound in &self.selector {
            let ids = compound.tests.iter().filter(|(name, _)| *name == "id").count();
            weight[0] += ids;
            weight[1] += compound.tests.len() - ids + usize::from(compound.first_child);
            weight[2] += usize::from(compound.name.is_some());
        }
        weight
    }
}

/// All style sheets of a file.
#[derive(Debug, Default)]
pub(crate) struct CssSheet<'a> {
    pub rules: Vec<CssRule<'a>>,
    pub blocks: Vec<Vec<Declaration<'a>>>,
    /// Whether the sheets contain rules that are not applied: at-rules, pseudo-classes or errors.
    pub has_more: bool,
}

impl<'a> CssSheet<'a> {
    /// Parses one more sheet.
    pub(crate) fn read(&mut self, text: &'a str) {
        let mut reader = CssReader { text, at: 0 };
        loop {
            reader.blanks();
            match reader.peek() {
                None => return,
                Some(b'@') => {
                    self.has_more = true;
                    reader.until(b";{");
                    if reader.peek() == Some(b'{') {
                        reader.block();
                    }
                    reader.at += 1;
                }
                // A stray brace, or the comment markers that some editors put around a sheet.
                Some(b'}' | b';') => reader.at += 1,
                Some(_) if reader.rest().starts_with("<!--") => reader.at += 4,
                Some(_) if reader.rest().starts_with("-->") => reader.at += 3,
                Some(_) => self.rule(&mut reader),
            }
        }
    }

    /// Parses a rule with its selectors and declarations.
    fn rule(&mut self, reader: &mut CssReader<'a>) {
        let selectors = reader.until(b"{");
        let body = reader.block();
        reader.at += 1;
        let found = declarations(body);
        self.has_more |= found.is_none();
        let block = self.blocks.len();
        self.blocks.push(found.unwrap_or_default());
        for selector in split(selectors, b',') {
            match parse_selector(selector) {
                Some(selector) => self.rules.push(CssRule { selector, block }),
                None => self.has_more = true,
            }
        }
    }
}

/// Declarations of a block or of a `style` attribute; `None` if any part of it is not a plain declaration.
pub(crate) fn declarations(text: &str) -> Option<Vec<Declaration<'_>>> {
    let mut found = Vec::new();
    for piece in split(text, b';') {
        let piece = trimmed(piece)?;
        if piece.is_empty() {
            continue;
        }
        let (name, value) = piece.split_once(':')?;
        let (value, important) = match value.trim_end().rsplit_once('!') {
            Some((value, word)) if word.trim().eq_ignore_ascii_case("important") => (value, true),
            Some(_) => return None,
            None => (value, false),
        };
        let (name, value) = (trimmed(name)?, trimmed(value)?);
        let plain = |b: u8| b.is_ascii_alphanumeric() || matches!(b, b'-' | b'_');
        let whole = !value.is_empty() && !value.contains(['{', '}', '<', '\\']) && !value.contains("/*");
        if name.is_empty() || !name.bytes().all(plain) || !whole {
            return None;
        }
        found.push(Declaration { name, value, important });
    }
    Some(found)
}

/// Text without surrounding white space and comments.
fn trimmed(mut text: &str) -> Option<&str> {
    loop {
        text = text.trim();
        if let Some(rest) = text.strip_prefix("/*") {
            text = rest.split_once("*/")?.1;
        } else if text.ends_with("*/") {
            text = &text[..text.rfind("/*")?];
        } else {
            return Some(text);
        }
    }
}

/// Pieces of a text between separators outside strings, comments and brackets.
fn split(text: &str, separator: u8) -> impl Iterator<Item = &str> {
    let mut reader = CssReader { text, at: 0 };
    std::iter::from_fn(move || {
        (reader.at <= text.len()).then(|| {
            let piece = reader.until(&[separator]);
            reader.at += 1;
            piece
        })
    })
}

/// Compound selectors of one selector; `None` if it is invalid, not supported, or too long.
fn parse_selector(text: &str) -> Option<Vec<CompoundSelector<'_>>> {
    let mut reader = CssReader { text, at: 0 };
    let mut found: Vec<CompoundSelector> = Vec::new();
    let mut relation = Combinator::First;
    loop {
        let before = reader.at;
        reader.blanks();
        let apart = reader.at > before;
        let Some(next) = reader.peek() else { break };
        let sign = match next {
            b'>' => Some(Combinator::Child),
            b'+' => Some(Combinator::Next),
            b'~' => Some(Combinator::After),
            _ => None,
        };
        if let Some(sign) = sign {
            if found.is_empty() || relation != Combinator::First {
                return None;
            }
            reader.at += 1;
            relation = sign;
            continue;
        }
        if found.is_empty() || apart || relation != Combinator::First {
            let relation = match (found.is_empty(), relation) {
                (false, Combinator::First) => Combinator::Inside,
                _ => relation,
            };
            found.push(CompoundSelector { relation, name: None, tests: Vec::new(), first_child: false });
        }
        relation = Combinator::First;
        let compound = found.last_mut()?;
        match next {
            b'*' => reader.at += 1,
            b'.' => {
                reader.at += 1;
                compound.tests.push(("class", AttributeTest::Word(reader.word()?)));
            }
            b'#' => {
                reader.at += 1;
                compound.tests.push(("id", AttributeTest::Equals(reader.word()?)));
            }
            b'[' => {
                let inside = reader.until(b"]").strip_prefix('[')?;
                reader.peek()?;
                reader.at += 1;
                compound.tests.push(attribute(inside)?);
            }
            b':' => {
                reader.at += 1;
                compound.first_child = reader.word()? == "first-child" && reader.peek() != Some(b'(');
                if !compound.first_child {
                    return None;
                }
            }
            // A name must come first.
            _ if compound.name.is_none() && compound.tests.is_empty() => {
                compound.name = Some(reader.word()?);
            }
            _ => return None,
        }
    }
    let is_whole = relation == Combinator::First && !found.is_empty();
    (is_whole && found.len() <= MAX_COMPOUNDS).then_some(found)
}

/// Condition between `[` and `]`.
fn attribute(text: &str) -> Option<(&str, AttributeTest<'_>)> {
    let Some((left, value)) = text.split_once('=') else { return Some((text.trim(), AttributeTest::Exists)) };
    let value = value.trim().trim_matches(['"', '\'']);
    let left = left.trim_end();
    let test = match left.as_bytes().last()? {
        b'~' => AttributeTest::Word(value),
        b'|' => AttributeTest::Language(value),
        b'^' => AttributeTest::Begins(value),
        b'$' => AttributeTest::Ends(value),
        b'*' => AttributeTest::Contains(value),
        _ => AttributeTest::Equals(value),
    };
    let name = left.trim_end_matches(['~', '|', '^', '$', '*']).trim();
    (!name.is_empty()).then_some((name, test))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn css_sheet_parses_selectors_and_declarations() {
        let mut sheet = CssSheet::default();
        sheet.read(
            "/* a{} */ @media print { path{fill:red} } g > path.a.b , #c rect + [d|='x,}'] { fill : url(a;b) ; stroke:#000!important }\
             text:hover{fill:blue} ;x{stroke:none}",
        );
        let told: Vec<([usize; 3], usize)> =
            sheet.rules.iter().map(|rule| (rule.weight(), rule.block)).collect();
        assert_eq!(told, [([0, 2, 2], 0), ([1, 1, 1], 0), ([0, 0, 1], 2)]);
        let compounds = sheet.rules.iter().flat_map(|rule| &rule.selector);
        let relations: Vec<Combinator> = compounds.map(|compound| compound.relation).collect();
        use Combinator::{Child, First, Inside, Next};
        assert_eq!(relations, [First, Child, First, Inside, Next, First]);
        assert!(sheet.has_more);
        assert_eq!(
            sheet.blocks[0],
            [
                Declaration { name: "fill", value: "url(a;b)", important: false },
                Declaration { name: "stroke", value: "#000", important: true }
            ]
        );
    }

    #[test]
    fn css_parser_terminates_on_malformed_input() {
        for piece in
            ["{", "}", "a{", "/*", "\"", "'", "@", "@a{", "a,", "[", "(", ":", "a b>", ".", "\u{e9}", "\\"]
        {
            for count in [1, 2, 3, 200_000] {
                let text = piece.repeat(count);
                CssSheet::default().read(&text);
                _ = declarations(&text);
            }
        }
        assert_eq!(declarations("fill:red;stroke"), None);
        assert_eq!(declarations(" ; fill:red; ").map(|list| list.len()), Some(1));
    }
}
