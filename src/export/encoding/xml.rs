//! Escaped text for XML, and ids that are unique in a document.

use std::borrow::Cow;

use rustc_hash::FxHashSet;

/// Writes text for an attribute or an element. Markup is escaped, and characters that XML cannot contain are
/// replaced by U+FFFD.
pub(crate) fn escape(out: &mut Vec<u8>, text: &str) {
    let plain = |byte: u8| byte >= 0x20 && !matches!(byte, b'&' | b'<' | b'>' | b'"') && byte < 0xef;
    if text.bytes().all(plain) {
        out.extend_from_slice(text.as_bytes());
        return;
    }
    let mut buffer = [0u8; 4];
    for c in text.chars() {
        let replacement: &[u8] = match c {
            '&' => b"&amp;",
            '<' => b"&lt;",
            '>' => b"&gt;",
            '"' => b"&quot;",
            // Unescaped ones would be read as blanks in an attribute.
            '\t' => b"&#9;",
            '\n' => b"&#10;",
            '\r' => b"&#13;",
            '\u{0}'..='\u{1f}' | '\u{fffe}' | '\u{ffff}' => "\u{fffd}".as_bytes(),
            _ => c.encode_utf8(&mut buffer).as_bytes(),
        };
        out.extend_from_slice(replacement);
    }
}

/// Escaped text; see [`escape`].
#[cfg(feature = "cli")]
pub(crate) fn escaped(text: &str) -> String {
    let mut out = Vec::with_capacity(text.len());
    escape(&mut out, text);
    String::from_utf8_lossy(&out).into_owned()
}

/// The text that a reader gets from the output of [`escape`].
pub(crate) fn read_back(text: &str) -> Cow<'_, str> {
    let lost = |c: char| matches!(c, '\u{0}'..='\u{1f}' | '\u{fffe}' | '\u{ffff}') && !"\t\n\r".contains(c);
    if text.contains(lost) { Cow::Owned(text.replace(lost, "\u{fffd}")) } else { Cow::Borrowed(text) }
}

/// Generator of unique ids.
pub(crate) struct UniqueIds {
    /// Prefix of all ids of the document.
    base: String,
    /// Prefix of the ids generated now.
    prefix: String,
    used_ids: FxHashSet<String>,
}

impl UniqueIds {
    /// Creates a generator with a prefix, which may be empty.
    pub(crate) fn new(prefix: &str) -> Self {
        Self { base: safe(prefix), prefix: safe(prefix), used_ids: FxHashSet::default() }
    }

    /// Adds a name to the prefix of the following ids, or removes it if the name is empty.
    pub(crate) fn within(&mut self, name: &str) {
        let parted = if name.is_empty() { String::new() } else { format!("{}-", safe(name)) };
        self.prefix = format!("{}{parted}", self.base);
    }

    /// A unique id made from a name, with a number if the name is taken.
    pub(crate) fn take(&mut self, name: &str) -> String {
        let wished = format!("{}{}", self.prefix, safe(name));
        // An XML name must not start with a digit.
        let wished = if wished.starts_with(|c: char| !c.is_alphabetic() && c != '_') {
            format!("_{wished}")
        } else {
            wished
        };
        let mut id = wished.clone();
        let mut number = 1;
        while !self.used_ids.insert(id.clone()) {
            number += 1;
            id = format!("{wished}-{number}");
        }
        id
    }
}

/// The name with all characters replaced that are not allowed in ids or need escaping in selectors.
fn safe(name: &str) -> String {
    name.chars().map(|c| if c.is_ascii_alphanumeric() || c == '-' || c == '_' { c } else { '-' }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn escaped(text: &str) -> String {
        let mut out = Vec::new();
        escape(&mut out, text);
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn escape_replaces_markup_and_control_characters() {
        assert_eq!(escaped("plain büro"), "plain büro");
        assert_eq!(escaped("<a & \"b\">"), "&lt;a &amp; &quot;b&quot;&gt;");
        assert_eq!(read_back("a\nb\u{0}\u{ffff}"), "a\nb\u{fffd}\u{fffd}");
        assert_eq!(escaped("a\nb\u{0}\u{7}\u{ffff}日本"), "a&#10;b\u{fffd}\u{fffd}\u{fffd}日本");
    }

    #[test]
    fn unique_ids_are_unique_and_valid_names() {
        let mut ids = UniqueIds::new("");
        assert_eq!(ids.take("part-big bolt"), "part-big-bolt");
        assert_eq!(ids.take("part-big-bolt"), "part-big-bolt-2");
        assert_eq!(ids.take("part-big-bolt"), "part-big-bolt-3");
        assert_eq!(ids.take("1"), "_1");
        assert_eq!(UniqueIds::new("a<b.").take("lines"), "a-b-lines");
        let mut ids = UniqueIds::new("p-");
        ids.within("panel 1");
        assert_eq!(ids.take("lines"), "p-panel-1-lines");
        ids.within("");
        assert_eq!([ids.take("panel-1-lines"), ids.take("lines")], ["p-panel-1-lines-2", "p-lines"]);
    }
}
