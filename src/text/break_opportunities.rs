//! Break opportunities: between words by the Unicode rules (UAX 14), and inside words by hyphenation
//! patterns.

use hypher::Lang;
use unicode_linebreak::{BreakOpportunity, linebreaks};

use crate::error::Error;

/// Minimum length of a word that is hyphenated, letters.
const MIN_HYPHENATED_LETTERS: usize = 5;

/// A break opportunity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct LineBreak {
    /// Position in the text, bytes.
    pub at: usize,
    /// Whether the line ends with a hyphen, because the break is inside a word.
    pub hyphen: bool,
    /// Whether the line must end here.
    pub must: bool,
}

/// Parses a language code of two letters.
pub(crate) fn language(code: &str) -> Result<Lang, Error> {
    let bytes = <[u8; 2]>::try_from(code.to_lowercase().as_bytes()).ok();
    bytes.and_then(Lang::from_iso).ok_or_else(|| {
        Error::new(format!("ligne cannot hyphenate the language `{code}`"))
            .remedy("give two letters of ISO 639-1, such as en, de, fr or pl, or none to keep words whole")
    })
}

/// All break opportunities of a text, including its start and its end.
pub(crate) fn line_breaks(text: &str, language: Option<Lang>) -> Vec<LineBreak> {
    let mut found = vec![LineBreak { at: 0, hyphen: false, must: true }];
    let mut from = 0;
    for (at, opportunity) in linebreaks(text) {
        if let Some(language) = language {
            hyphenate_words(text, from..at, language, &mut found);
        }
        let hyphen = text[..at].ends_with('\u{ad}');
        found.push(LineBreak { at, hyphen, must: opportunity == BreakOpportunity::Mandatory });
        from = at;
    }
    found
}

/// Adds the hyphenation points of the words in a range of the text.
fn hyphenate_words(text: &str, range: std::ops::Range<usize>, language: Lang, found: &mut Vec<LineBreak>) {
    let stretch = &text[range.clone()];
    let mut words = stretch.char_indices().peekable();
    while let Some((start, c)) = words.next() {
        if !c.is_alphabetic() {
            continue;
        }
        let mut end = start + c.len_utf8();
        while let Some((at, _)) = words.next_if(|(_, c)| c.is_alphabetic()) {
            end = at + stretch[at..].chars().next().map_or(0, char::len_utf8);
        }
        let word = &stretch[start..end];
        if word.chars().count() < MIN_HYPHENATED_LETTERS {
            continue;
        }
        let mut at = range.start + start;
        let syllables: Vec<&str> = hypher::hyphenate(word, language).collect();
        for syllable in syllables.iter().take(syllables.len().saturating_sub(1)) {
            at += syllable.len();
            found.push(LineBreak { at, hyphen: true, must: false });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text_with_marked_breaks(text: &str, code: Option<&str>) -> String {
        let mut out = text.to_owned();
        for LineBreak { at, hyphen, must } in
            line_breaks(text, code.map(|code| language(code).unwrap())).into_iter().rev()
        {
            out.insert(
                at,
                if hyphen {
                    '-'
                } else if must {
                    '!'
                } else {
                    '|'
                },
            );
        }
        out
    }

    #[test]
    fn lines_break_between_words_and_at_hyphenation_points() {
        assert_eq!(text_with_marked_breaks("a well-known fact.\nSo", None), "!a |well-|known |fact.\n!So!");
        assert_eq!(
            text_with_marked_breaks("Extensive hyphenation!", Some("en")),
            "!Ex-ten-sive |hy-phen-ation!!"
        );
        assert_eq!(text_with_marked_breaks("Kraftfahrzeug", Some("de")), "!Kraft-fahr-zeug!");
        assert!(language("xx").unwrap_err().to_string().contains("`xx`"));
        assert!(language("english").is_err());
    }
}
