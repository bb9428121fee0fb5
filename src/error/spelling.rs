//! British and American spelling of keys and options: `color` counts as `colour`.

/// A word in British spelling, as used by keys and options.
pub(crate) fn british(word: &str) -> String {
    word.replace("color", "colour").replace("center", "centre")
}

/// Known words without American variants of other known words.
pub(crate) fn without_american<'a>(known: &[&'a str]) -> Vec<&'a str> {
    let is_other = |word: &str| british(word) != word && known.contains(&british(word).as_str());
    known.iter().copied().filter(|word| !is_other(word)).collect()
}
