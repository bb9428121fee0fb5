//! Limits on the tags of a file, checked before it is parsed.
//!
//! The tokenizer uses the same grammar as the parser, and anything it does not accept is refused. So no
//! content can be counted as one thing and parsed as another.

use xmlparser::{ElementEnd, EntityDefinition, StrSpan, Token, Tokenizer};

use crate::error::Error;

/// Greatest nesting depth of elements, including references.
pub(crate) const MAX_DEPTH: usize = 256;
/// Most attributes of one element. The parser compares each pair.
const MAX_ATTRIBUTES: usize = 512;
/// Most comparisons of names with namespaces in scope.
const MAX_NAMESPACE_LOOKUPS: usize = 200_000_000;
/// Most bytes of expanded entities.
const MAX_ENTITY_BYTES: usize = 16_000_000;

/// Character references that need no declaration.
const PREDEFINED_ENTITIES: [&str; 6] = ["#", "amp;", "lt;", "gt;", "quot;", "apos;"];

/// Refuses files that the parser would take too long for.
pub(crate) fn check(text: &str) -> Result<(), Error> {
    let mut tags = TagCounts::default();
    tags.read(text, Tokenizer::from(text))?;
    tags.entities.check(tags.widest)
}

/// Work that the tags of a file or of an entity cause in the parser.
#[derive(Default)]
struct TagCounts {
    /// Number of namespaces in scope in each open element.
    open: Vec<usize>,
    /// Largest number of namespaces in scope.
    widest: usize,
    /// Counts of the current element.
    attributes: usize,
    declared: usize,
    names: usize,
    /// Counts of all elements.
    all_declared: usize,
    all_names: usize,
    lookups: usize,
    entities: EntityUsage,
}

impl TagCounts {
    /// Counts the tags of a text.
    fn read(&mut self, text: &str, tokens: Tokenizer) -> Result<(), Error> {
        for token in tokens {
            match token.map_err(in_words)? {
                Token::ElementStart { .. } => (self.attributes, self.declared, self.names) = (0, 0, 1),
                Token::Attribute { prefix, local, value, .. } => {
                    self.attributes += 1;
                    if prefix == "xmlns" || local == "xmlns" {
                        self.declared += 1;
                    } else if !prefix.is_empty() {
                        self.names += 1;
                    }
                    self.entities.count_uses(value);
                }
                Token::ElementEnd { end: ElementEnd::Close(..), .. } => drop(self.open.pop()),
                Token::ElementEnd { end, .. } => self.element(end == ElementEnd::Open)?,
                Token::Text { text } => self.entities.count_uses(text),
                Token::EntityDeclaration { definition, span, .. } => {
                    self.entities.declare(text, definition, span)?;
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// Adds the counts of an element after its attributes.
    fn element(&mut self, is_open: bool) -> Result<(), Error> {
        if self.attributes > MAX_ATTRIBUTES {
            return Err(too_much(&format!("{} attributes of one element", self.attributes)));
        }
        if self.open.len() > MAX_DEPTH {
            return Err(too_deep());
        }
        let inherited = self.open.last().copied().unwrap_or(1);
        let scope = inherited.saturating_add(self.declared);
        self.widest = self.widest.max(scope);
        self.all_declared += self.declared;
        self.all_names += self.names;
        // Each name is looked up in the scope. An element that declares namespaces copies the scope and
        // compares all pairs.
        let copied = if self.declared > 0 { scope.saturating_mul(scope) } else { 0 };
        let sought = self.names.saturating_mul(scope);
        self.lookups = self.lookups.saturating_add(copied).saturating_add(sought);
        if self.lookups > MAX_NAMESPACE_LOOKUPS {
            return Err(too_much(&format!(
                "{} namespaces in scope at once, for all the names here,",
                self.widest
            )));
        }
        if is_open {
            self.open.push(scope);
        }
        Ok(())
    }
}

/// Declared entities and their uses.
#[derive(Default)]
struct EntityUsage {
    /// Bytes of all declarations.
    bytes: usize,
    /// Number of references.
    uses: usize,
    /// Names of elements and attributes inside entities.
    names: usize,
    /// The reason why entities may not be used.
    unusable: Option<Error>,
}

impl EntityUsage {
    /// Adds an entity declaration.
    fn declare(&mut self, text: &str, definition: EntityDefinition, whole: StrSpan) -> Result<(), Error> {
        self.bytes += whole.len();
        let EntityDefinition::EntityValue(value) = definition else { return Ok(()) };
        if references(&value) > 0 {
            return Err(too_much("entities that are made of entities"));
        }
        if !value.contains('<') {
            return Ok(());
        }
        let mut inside = TagCounts::default();
        match inside.read(text, Tokenizer::from_fragment(text, value.range())) {
            Ok(()) if inside.all_declared == 0 => self.names += inside.all_names,
            Ok(()) => self.unusable = Some(too_much("namespaces that entities declare")),
            // An unused entity for another program may contain anything.
            Err(error) => self.unusable = Some(error),
        }
        Ok(())
    }

    /// Counts the references in a text, once entities are declared.
    fn count_uses(&mut self, text: StrSpan) {
        if self.bytes > 0 {
            self.uses += references(&text);
        }
    }

    /// Refuses entities that multiply; `widest` is the largest number of namespaces in scope.
    fn check(&self, widest: usize) -> Result<(), Error> {
        if self.uses == 0 {
            return Ok(());
        }
        if let Some(error) = &self.unusable {
            return Err(error.clone());
        }
        let lookups = self.uses.saturating_mul(self.names).saturating_mul(widest);
        if self.uses.saturating_mul(self.bytes) > MAX_ENTITY_BYTES || lookups > MAX_NAMESPACE_LOOKUPS {
            return Err(too_much(&format!("{} uses of entities", self.uses)));
        }
        Ok(())
    }
}

/// Number of references to entities that must be declared.
fn references(text: &str) -> usize {
    let rests = text.split('&').skip(1);
    rests.filter(|rest| !PREDEFINED_ENTITIES.iter().any(|known| rest.starts_with(known))).count()
}

/// The tokenizer's message with its position, from text such as `invalid element at 1:2 cause expected '='
/// not '/' at 1:9`.
fn in_words(error: xmlparser::Error) -> Error {
    let place = error.pos();
    let text = error.to_string();
    let cause = text.split_once(" cause ").map_or(&*text, |(_, cause)| cause);
    let message = cause.split(" at ").next().unwrap_or("cannot be read").to_owned();
    Error::new(format!("the file is not well-formed XML: {message}"))
        .at(format!("line {}, column {}", place.row, place.col))
        .remedy("give a whole SVG file")
}

pub(crate) fn too_much(what: &str) -> Error {
    Error::new(format!("the file has too many {what}"))
        .remedy("save the drawing as plain SVG, without references that multiply")
}

pub(crate) fn too_deep() -> Error {
    Error::new(format!("elements are nested more than {MAX_DEPTH} deep"))
        .remedy("ungroup the drawing, or save it as plain SVG")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check_result(svg: &str) -> String {
        check(svg).err().map_or_else(|| "passed".to_owned(), |error| error.to_string())
    }

    fn attributes(count: usize) -> String {
        (0..count).map(|i| format!(" a{i}=\"\"")).collect()
    }

    #[test]
    fn tag_check_counts_tags_after_comments_cdata_and_quotes() {
        let many = format!("<g{}/>", attributes(600));
        for before in [
            "<!-- it's -->",
            "<!-- \" ' > = -->",
            "<!-- <g a=' -->",
            "<![CDATA[ it's <g a=\" ]]>",
            "<![CDATA[]]]]>'",
            "<?php echo '<g a=\"'; ?>",
            "it's",
            "<g a=\"'\"/><g a='\"'/>",
            "<g a='>'/>",
            "<g></g >",
        ] {
            assert!(
                check_result(&format!("<svg>{before}{many}</svg>")).contains("600 attributes"),
                "{before}"
            );
        }
        for prolog in [
            "<!-- it's -->",
            "<?pi it's?>",
            "<!DOCTYPE svg SYSTEM \"it's\">",
            "<!DOCTYPE svg PUBLIC \"-//W3C//DTD SVG 1.1//EN\" 'a\"b' [<!-- it's ]> --><?x '?><!ENTITY a '\"'>]>",
            "<!DOCTYPE svg [<!ELEMENT g (a|b)><!ATTLIST g a CDATA \"'\"><!ENTITY % p \"<!ATTLIST\">]>",
        ] {
            assert!(
                check_result(&format!("{prolog}<svg>{many}</svg>")).contains("600 attributes"),
                "{prolog}"
            );
            assert_eq!(check_result(&format!("{prolog}<svg><g/></svg>")), "passed", "{prolog}");
        }
    }

    #[test]
    fn tag_check_ignores_tags_inside_comments_cdata_and_values() {
        let many = attributes(600);
        for inside in [
            format!("<!-- <g{many}> -->"),
            format!("<![CDATA[<g{many}>]]>"),
            format!("<?pi <g{many}> ?>"),
            format!("<g a='{}'/>", many.replace('<', "")),
            "<!-- <!ENTITY a 'b'> &a; -->".repeat(9000),
            "&amp;&#60;".repeat(9000),
        ] {
            let svg = format!(
                "<!DOCTYPE svg [<!ENTITY ns \"{}\">]><svg a=\"&ns;\">{inside}</svg>",
                "x".repeat(2000)
            );
            assert_eq!(check_result(&svg), "passed");
        }
    }

    #[test]
    fn tag_check_counts_tags_inside_used_entities() {
        let with =
            |value: &str, text: &str| format!("<!DOCTYPE svg [<!ENTITY e '{value}'>]><svg>{text}</svg>");
        let many = format!("<g{}/>", attributes(600));
        assert!(check_result(&with(&many, "&e;")).contains("600 attributes"));
        assert_eq!(check_result(&with(&many, "")), "passed");
        let deep = "<g>".repeat(300) + &"</g>".repeat(300);
        assert!(check_result(&with(&deep, "&e;")).contains("256 deep"));
        assert_eq!(check_result(&with("<g/>text<g a=\"1\"/>", "&e;<g a=\"&e;\"/>")), "passed");
        assert!(check_result(&with("<g xmlns:a=\"b\"/>", "&e;")).contains("namespaces"));
        assert!(check_result(&with("<g/>", &"&e;".repeat(900_000))).contains("uses of entities"));
        let late = with(&"x".repeat(9000), &"&e;".repeat(9000)) + "<!-- <!ENTITY f ''> -->";
        assert!(check_result(&late).contains("uses of entities"));
        let decoy = "<!-- <!ENTITY f '&e;'> -->".to_owned() + &with("x", "&e;");
        assert_eq!(check_result(&decoy), "passed");
    }

    #[test]
    fn tag_check_limits_namespaces_in_scope() {
        let names: String = (0..500).map(|i| format!(" xmlns:n{i}=\"u\"")).collect();
        let copies = "<g xmlns:a=\"b\"/>".repeat(20_000);
        assert!(check_result(&format!("<svg{names}>{copies}</svg>")).contains("namespaces in scope"));
        let sought = "<n0:g n0:a=\"\"/>".repeat(1_000_000);
        assert!(check_result(&format!("<svg{names}>{sought}</svg>")).contains("namespaces in scope"));
        let nested: String = (0..200)
            .map(|i| format!("<g xmlns:n{i}=\"u\"{}>", names.replace(":n", &format!(":m{i}x"))))
            .collect();
        assert!(check_result(&format!("<svg>{nested}")).contains("namespaces"));
        let usual =
            "<g xmlns=\"http://www.w3.org/2000/svg\" xmlns:i=\"u\" i:label=\"a\"><path i:x=\"\"/></g>";
        assert_eq!(check_result(&format!("<svg>{}</svg>", usual.repeat(100_000))), "passed");
    }

    #[test]
    fn tag_check_errors_report_line_and_column() {
        let told = check_result("<svg>\n<g a/></svg>");
        assert!(
            told.contains("line 2, column 3: the file is not well-formed XML: expected '=' not '/'"),
            "{told}"
        );
        for broken in ["<svg><!-- ", "<svg><![CDATA[", "<svg a='", "<svg><?x", "<!DOCTYPE svg [", "<svg><"] {
            _ = check_result(broken);
        }
    }

    #[test]
    fn tag_check_terminates_on_millions_of_repetitions() {
        for piece in [
            "<g a='1'>",
            "<!--",
            "<!-- - -->",
            "<![CDATA[",
            "]]",
            "<?a ",
            "<!DOCTYPE svg [<!ENTITY a 'b'>",
            "<g ",
            "&",
            "'",
            "\n",
        ] {
            for start in ["<svg>", "<!DOCTYPE svg [", ""] {
                let text = start.to_owned() + &piece.repeat(4_000_000 / piece.len());
                // Work that grows faster than the text would not finish here.
                _ = check_result(&text);
            }
        }
    }
}
