//! [`Sheet`]: the style sheets of a file, read in one pass: rules with selectors in parts, and what they declare.

use rustc_hash::FxHashMap;

/// What a style sheet says of an element: `fill: red !important`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Declaration<'a> {
    pub name: &'a str,
    pub value: &'a str,
    pub important: bool,
}

/// How a part of a selector relates to the part before it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Relation {
    /// It has none before it.
    First,
    /// The one before is somewhere around.
    Inside,
    /// The one before is the parent.
    Child,
    /// The one before is the element just before.
    Next,
    /// The one before comes somewhere before, in the same parent.
    After,
}

/// What an attribute has to be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Test<'a> {
    Exists,
    Equals(&'a str),
    Word(&'a str),
    Language(&'a str),
    Begins(&'a str),
    Ends(&'a str),
    Contains(&'a str),
}

/// One part of a selector: `path.crease#lid`.
#[derive(Debug, Clone, Default)]
pub(crate) struct Compound<'a> {
    pub name: Option<&'a str>,
    pub tests: Vec<(&'a str, Test<'a>)>,
    pub first_child: bool,
}

/// A part of a selector in its place.
#[derive(Debug, Clone)]
pub(crate) struct Part<'a> {
    pub compound: Compound<'a>,
    pub relation: Relation,
    /// The rule, if the selector ends here.
    pub rule: Option<usize>,
    /// How the next part relates to this one.
    pub next: Option<Relation>,
}

/// What a selector applies.
#[derive(Debug, Clone)]
pub(crate) struct Rule {
    /// Ids, classes and names, for which of two rules wins.
    pub weight: [u32; 3],
    /// Declarations in [`Sheet::blocks`].
    pub block: usize,
}

/// The style sheets of a file.
#[derive(Debug, Default)]
pub(crate) struct Sheet<'a> {
    /// The parts of all selectors; each selector's are neighbours.
    pub parts: Vec<Part<'a>>,
    pub rules: Vec<Rule>,
    pub blocks: Vec<Vec<Declaration<'a>>>,
    /// Whether something stands in it that is not applied: rules for media, states of a pointer, mistakes.
    pub has_more: bool,
}

impl<'a> Sheet<'a> {
    /// Reads one more sheet.
    pub(crate) fn read(&mut self, text: &'a str) {
        let mut reader = Reader { text, at: 0 };
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
                // A brace too many, or what some editors put round a sheet.
                Some(b'}' | b';') => reader.at += 1,
                Some(_) if reader.rest().starts_with("<!--") => reader.at += 4,
                Some(_) if reader.rest().starts_with("-->") => reader.at += 3,
                Some(_) => self.rule(&mut reader),
            }
        }
    }

    fn rule(&mut self, reader: &mut Reader<'a>) {
        let selectors = reader.until(b"{");
        let body = reader.block();
        reader.at += 1;
        let found = declarations(body);
        self.has_more |= found.is_none();
        let block = self.blocks.len();
        self.blocks.push(found.unwrap_or_default());
        for selector in split(selectors, b',') {
            match parts(selector) {
                Some(parts) => {
                    let mut weight = [0u32; 3];
                    for (compound, _) in &parts {
                        let ids = compound.tests.iter().filter(|(name, _)| *name == "id").count() as u32;
                        weight[0] += ids;
                        weight[1] += compound.tests.len() as u32 - ids + u32::from(compound.first_child);
                        weight[2] += u32::from(compound.name.is_some());
                    }
                    let last = parts.len() - 1;
                    let nexts: Vec<Option<Relation>> =
                        (0..parts.len()).map(|index| parts.get(index + 1).map(|(_, next)| *next)).collect();
                    for (index, ((compound, relation), next)) in parts.into_iter().zip(nexts).enumerate() {
                        let rule = (index == last).then_some(self.rules.len());
                        self.parts.push(Part { compound, relation, rule, next });
                    }
                    self.rules.push(Rule { weight, block });
                }
                None => self.has_more = true,
            }
        }
    }

    /// The parts that an element may fit, by the most telling of what they ask for.
    pub(crate) fn index(&self) -> Index<'a> {
        let mut index = Index::default();
        for (number, part) in self.parts.iter().enumerate() {
            let of = |wanted: &str| {
                part.compound.tests.iter().find_map(|(name, test)| match test {
                    Test::Equals(value) | Test::Word(value) if *name == wanted => Some(*value),
                    _ => None,
                })
            };
            let list = match (of("id"), of("class"), part.compound.name) {
                (Some(id), ..) => index.ids.entry(id).or_default(),
                (_, Some(class), _) => index.classes.entry(class).or_default(),
                (.., Some(name)) => index.names.entry(name).or_default(),
                _ => &mut index.any,
            };
            list.push(number as u32);
        }
        index
    }
}

/// The parts of selectors by what they ask for.
#[derive(Debug, Default)]
pub(crate) struct Index<'a> {
    pub ids: FxHashMap<&'a str, Vec<u32>>,
    pub classes: FxHashMap<&'a str, Vec<u32>>,
    pub names: FxHashMap<&'a str, Vec<u32>>,
    pub any: Vec<u32>,
}

/// The declarations of a block or of an attribute `style`; `None` where it is more than a list of names and values. What stands before
/// a mistake is lost with it.
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

/// A text without blanks and comments round it.
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

/// The pieces of a text between separators that stand in no string, comment or bracket.
fn split(text: &str, separator: u8) -> impl Iterator<Item = &str> {
    let mut reader = Reader { text, at: 0 };
    std::iter::from_fn(move || {
        (reader.at <= text.len()).then(|| {
            let piece = reader.until(&[separator]);
            reader.at += 1;
            piece
        })
    })
}

/// The parts of one selector; `None` where it asks for what is not known here, or is wrong.
fn parts(text: &str) -> Option<Vec<(Compound<'_>, Relation)>> {
    let mut reader = Reader { text, at: 0 };
    let mut found: Vec<(Compound, Relation)> = Vec::new();
    let mut relation = Relation::First;
    loop {
        let before = reader.at;
        reader.blanks();
        let apart = reader.at > before;
        let Some(next) = reader.peek() else { break };
        let sign = match next {
            b'>' => Some(Relation::Child),
            b'+' => Some(Relation::Next),
            b'~' => Some(Relation::After),
            _ => None,
        };
        if let Some(sign) = sign {
            let may = !found.is_empty() && relation == Relation::First;
            if !may {
                return None;
            }
            reader.at += 1;
            relation = sign;
            continue;
        }
        if found.is_empty() || apart || relation != Relation::First {
            let relation = match (found.is_empty(), relation) {
                (false, Relation::First) => Relation::Inside,
                _ => relation,
            };
            found.push((Compound::default(), relation));
        }
        relation = Relation::First;
        let (compound, _) = found.last_mut()?;
        match next {
            b'*' => reader.at += 1,
            b'.' => {
                reader.at += 1;
                compound.tests.push(("class", Test::Word(reader.word()?)));
            }
            b'#' => {
                reader.at += 1;
                compound.tests.push(("id", Test::Equals(reader.word()?)));
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
            // A name comes first in its part.
            _ if compound.name.is_none() && compound.tests.is_empty() => {
                compound.name = Some(reader.word()?);
            }
            _ => return None,
        }
    }
    (relation == Relation::First && !found.is_empty()).then_some(found)
}

/// What stands between `[` and `]`.
fn attribute(text: &str) -> Option<(&str, Test<'_>)> {
    let Some((left, value)) = text.split_once('=') else { return Some((text.trim(), Test::Exists)) };
    let value = value.trim().trim_matches(['"', '\'']);
    let left = left.trim_end();
    let test = match left.as_bytes().last()? {
        b'~' => Test::Word(value),
        b'|' => Test::Language(value),
        b'^' => Test::Begins(value),
        b'$' => Test::Ends(value),
        b'*' => Test::Contains(value),
        _ => Test::Equals(value),
    };
    let name = left.trim_end_matches(['~', '|', '^', '$', '*']).trim();
    (!name.is_empty()).then_some((name, test))
}

struct Reader<'a> {
    text: &'a str,
    at: usize,
}

impl<'a> Reader<'a> {
    fn rest(&self) -> &'a str {
        self.text.get(self.at..).unwrap_or_default()
    }

    fn peek(&self) -> Option<u8> {
        self.text.as_bytes().get(self.at).copied()
    }

    /// Goes past blanks and comments.
    fn blanks(&mut self) {
        while let Some(next) = self.peek() {
            if next.is_ascii_whitespace() {
                self.at += 1;
            } else if self.rest().starts_with("/*") {
                self.comment();
            } else {
                return;
            }
        }
    }

    fn comment(&mut self) {
        let length = self.rest().get(2..).and_then(|rest| rest.find("*/")).map(|at| at + 4);
        self.at = length.map_or(self.text.len(), |length| self.at + length);
    }

    /// What comes before any of these bytes, which stand in no string, comment or bracket; the reader stops there.
    fn until(&mut self, ends: &[u8]) -> &'a str {
        let start = self.at.min(self.text.len());
        let mut depth = 0usize;
        while let Some(next) = self.peek() {
            match next {
                _ if depth == 0 && ends.contains(&next) => break,
                b'"' | b'\'' => self.string(next),
                b'/' if self.rest().starts_with("/*") => {
                    self.comment();
                    continue;
                }
                b'(' => depth += 1,
                b')' => depth = depth.saturating_sub(1),
                _ => {}
            }
            self.at += 1;
        }
        self.text.get(start..self.at).unwrap_or_default()
    }

    /// Goes to the quote that ends a string.
    fn string(&mut self, quote: u8) {
        self.at += 1;
        while self.peek().is_some_and(|next| next != quote) {
            self.at += 1 + usize::from(self.peek() == Some(b'\\'));
        }
    }

    /// What stands in braces, which may be nested; the reader stops at the last one.
    fn block(&mut self) -> &'a str {
        self.at += 1;
        let start = self.at.min(self.text.len());
        let mut depth = 0usize;
        loop {
            self.until(b"{}");
            match self.peek() {
                Some(b'{') => depth += 1,
                Some(_) if depth > 0 => depth -= 1,
                _ => break,
            }
            self.at += 1;
        }
        self.text.get(start..self.at.min(self.text.len())).unwrap_or_default()
    }

    fn word(&mut self) -> Option<&'a str> {
        let is_of_word = |b: &u8| b.is_ascii_alphanumeric() || matches!(b, b'-' | b'_') || *b >= 0x80;
        let length = self.rest().bytes().take_while(is_of_word).count();
        let word = self.rest().get(..length).filter(|word| !word.is_empty())?;
        self.at += length;
        Some(word)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rules_are_read() {
        let mut sheet = Sheet::default();
        sheet.read(
            "/* a{} */ @media print { path{fill:red} } g > path.a.b , #c rect + [d|='x,}'] { fill : url(a;b) ; stroke:#000!important }\
             text:hover{fill:blue} ;x{stroke:none}",
        );
        let told: Vec<([u32; 3], usize)> = sheet.rules.iter().map(|rule| (rule.weight, rule.block)).collect();
        assert_eq!(told, [([0, 2, 2], 0), ([1, 1, 1], 0), ([0, 0, 1], 2)]);
        let relations: Vec<Relation> = sheet.parts.iter().map(|part| part.relation).collect();
        use Relation::{Child, First, Inside, Next};
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
    fn mistakes_come_to_an_end() {
        for piece in
            ["{", "}", "a{", "/*", "\"", "'", "@", "@a{", "a,", "[", "(", ":", "a b>", ".", "\u{e9}", "\\"]
        {
            for count in [1, 2, 3, 200_000] {
                let text = piece.repeat(count);
                Sheet::default().read(&text);
                _ = declarations(&text);
            }
        }
        assert_eq!(declarations("fill:red;stroke"), None);
        assert_eq!(declarations(" ; fill:red; ").map(|list| list.len()), Some(1));
    }
}
