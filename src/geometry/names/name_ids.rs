//! Stable numbers for named things, which do not change when other things are added or removed.

use rustc_hash::FxHashMap;

use crate::geometry::numbers::noise::hash;

/// Returns a number for each name, in their order: a hash of the name and its occurrence count among equal
/// names.
#[must_use]
pub(crate) fn stable_ids<'a>(names: impl IntoIterator<Item = &'a str>) -> Vec<u64> {
    let mut counts: FxHashMap<&str, u64> = FxHashMap::default();
    let of = |name: &'a str| {
        let count = counts.entry(name).or_default();
        *count += 1;
        let words = name
            .as_bytes()
            .chunks(8)
            .map(|bytes| bytes.iter().fold(0, |word: u64, byte| word << 8 | u64::from(*byte)));
        let mut words: Vec<u64> = words.collect();
        words.push(*count);
        hash(0, &words)
    };
    names.into_iter().map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stable_ids_do_not_depend_on_other_names() {
        let all = stable_ids(["bolt", "bolt", "wheel", "", "a name of many letters"]);
        let mut different = all.clone();
        different.sort_unstable();
        different.dedup();
        assert_eq!(different.len(), 5);
        assert_eq!(stable_ids(["wheel", "a name of many letters"]), [all[2], all[4]]);
    }
}
