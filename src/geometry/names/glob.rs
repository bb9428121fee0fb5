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
        let (mut pattern, mut name) = (self.0.as_str(), name);
        // Position to continue from if the text matched by the last star proves too short.
        let mut retry: Option<(&str, &str)> = None;
        loop {
            let mut pattern_rest = pattern.chars();
            let mut name_rest = name.chars();
            match (pattern_rest.next(), name_rest.next()) {
                (Some('*'), _) => {
                    pattern = pattern_rest.as_str();
                    retry = Some((pattern, name));
                    continue;
                }
                (None, None) => return true,
                (Some(p), Some(n)) if p == '?' || p == n => {
                    pattern = pattern_rest.as_str();
                    name = name_rest.as_str();
                    continue;
                }
                _ => {}
            }
            let Some((after_star, taken)) = retry else { return false };
            let mut longer = taken.chars();
            if longer.next().is_none() {
                return false;
            }
            pattern = after_star;
            name = longer.as_str();
            retry = Some((pattern, name));
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
        ] {
            assert_eq!(Glob::new(pattern).matches(name), fits, "{pattern} {name}");
        }
    }
}
