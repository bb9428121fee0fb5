//! [`Glob`]: a pattern for names, where `*` matches any text and `?` any one character.

use serde::Deserialize;

/// Pattern for the names of parts and materials, such as `bolt*`. Letter case matters.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(transparent)]
pub struct Glob(String);

impl Glob {
    /// Makes a pattern from its text.
    #[must_use]
    pub fn new(pattern: impl Into<String>) -> Self {
        Self(pattern.into())
    }

    /// Text of the pattern.
    #[must_use]
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// Whether the pattern matches the whole name.
    #[must_use]
    pub fn matches(&self, name: &str) -> bool {
        glob_matches(&self.0, name)
    }
}

/// Whether a pattern matches the whole name.
pub(crate) fn glob_matches<'a>(mut pattern: &'a str, mut name: &'a str) -> bool {
    // Position to continue from if the text matched by the last star proves too short.
    let mut retry: Option<(&str, &str)> = None;
    loop {
        let (mut pattern_rest, mut name_rest) = (pattern.chars(), name.chars());
        match (pattern_rest.next(), name_rest.next()) {
            (Some('*'), _) => {
                pattern = pattern_rest.as_str();
                retry = Some((pattern, name));
            }
            (None, None) => return true,
            (Some(p), Some(n)) if p == '?' || p == n => {
                (pattern, name) = (pattern_rest.as_str(), name_rest.as_str());
            }
            _ => {
                let Some((after_star, taken)) = retry else { return false };
                let mut longer = taken.chars();
                if longer.next().is_none() {
                    return false;
                }
                (pattern, name) = (after_star, longer.as_str());
                retry = Some((pattern, name));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Glob;

    #[test]
    fn glob_matches_stars_and_question_marks() {
        for (pattern, name, fits) in [
            ("bolt", "bolt", true),
            ("bolt", "bolt2", false),
            ("bolt*", "bolt", true),
            ("bolt*", "bolt-12", true),
            ("*bolt", "big bolt", true),
            ("*b*b*", "abcb", true),
            ("*ab", "aab", true),
            ("b?lt", "bült", true),
            ("?", "", false),
            ("", "", true),
            ("*", "", true),
            ("a*c*e", "abcde", true),
            ("a*c*e", "abcdf", false),
            ("*c", "abcc", true),
            ("?é?", "aéb", true),
            ("**a", "a", true),
            ("", "a", false),
            ("a", "A", false),
            ("a?", "a", false),
            ("*a*b", "ba", false),
        ] {
            assert_eq!(Glob::new(pattern).matches(name), fits, "{pattern} {name}");
        }
        assert!(!Glob::new("*a".repeat(40)).matches(&"a".repeat(39)));
    }
}
