//! British and American spelling of keys and options: `color` counts as `colour`.

/// A word in the spelling of the keys.
pub(crate) fn british(word: &str) -> String {
    word.replace("color", "colour").replace("center", "centre")
}

/// The known words without those that are only another spelling of one of them.
pub(crate) fn without_american<'a>(known: &[&'a str]) -> Vec<&'a str> {
    let is_other = |word: &str| british(word) != word && known.contains(&british(word).as_str());
    known.iter().copied().filter(|word| !is_other(word)).collect()
}
