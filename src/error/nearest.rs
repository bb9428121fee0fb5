//! [`nearest`]: known word that a misspelt word most likely stands for, and [`suggestion`] as advice.

/// Nearest known word, if at most a third of its letters differ.
pub(crate) fn nearest<'a>(word: &str, known: &[&'a str]) -> Option<&'a str> {
    known
        .iter()
        .map(|candidate| (distance(word, candidate), *candidate))
        .min()
        .filter(|(distance, candidate)| *distance <= (candidate.chars().count().max(3)) / 3)
        .map(|(_, candidate)| candidate)
}

/// Advice about an unknown word: the known word that it most likely stands for, or another text.
pub(crate) fn suggestion(near: Option<&str>, otherwise: impl FnOnce() -> String) -> String {
    near.map_or_else(otherwise, |near| format!("did you mean `{near}`?"))
}

/// Edit distance of two words: insertions, deletions, replacements and swaps of neighbouring letters (optimal
/// string alignment).
pub(crate) fn distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    let mut rows: Vec<Vec<usize>> = vec![(0..=b.len()).collect()];
    for i in 1..=a.len() {
        let mut row = vec![i];
        for j in 1..=b.len() {
            let replaced = rows[i - 1][j - 1] + usize::from(a[i - 1] != b[j - 1]);
            let mut least = replaced.min(rows[i - 1][j] + 1).min(row[j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                least = least.min(rows[i - 2][j - 2] + 1);
            }
            row.push(least);
        }
        rows.push(row);
    }
    rows.last().and_then(|row| row.last()).copied().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distance_counts_edits_and_swaps() {
        assert_eq!(distance("crease_dg", "crease_deg"), 1);
        assert_eq!(distance("wdith", "width"), 1);
        assert_eq!(distance("", "abc"), 3);
        assert_eq!(distance("color", "colour"), 1);
    }

    #[test]
    fn nearest_returns_only_similar_words() {
        assert_eq!(nearest("colour", &["width", "colour"]), Some("colour"));
        assert_eq!(nearest("fills", &["lines", "chain", "pen"]), None);
        assert_eq!(nearest("x", &[]), None);
    }
}
