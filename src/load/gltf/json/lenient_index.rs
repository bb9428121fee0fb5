//! Lenient deserialisation of indices: some exporters write -1 for "none", which is read as an index out of
//! range.

use std::collections::BTreeMap;
use std::fmt;

use serde::{Deserialize, Deserializer};

/// An index as read. Negative values wrap around, so that they are out of range.
#[derive(Deserialize)]
#[serde(from = "i64")]
struct Index(usize);

impl From<i64> for Index {
    fn from(number: i64) -> Self {
        // No file has as many elements as there are addresses.
        let wide = isize::try_from(number).unwrap_or(if number < 0 { isize::MIN } else { isize::MAX });
        Self(wide as usize)
    }
}

/// An index for messages, formatted as in the file.
pub(crate) struct DisplayIndex(pub usize);

impl fmt::Display for DisplayIndex {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.0 as isize)
    }
}

pub(crate) fn one<'de, D: Deserializer<'de>>(deserializer: D) -> Result<usize, D::Error> {
    Ok(Index::deserialize(deserializer)?.0)
}

pub(crate) fn optional<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<usize>, D::Error> {
    Ok(Option::<Index>::deserialize(deserializer)?.map(|index| index.0))
}

pub(crate) fn named<'de, D: Deserializer<'de>>(deserializer: D) -> Result<BTreeMap<String, usize>, D::Error> {
    Ok(plain(BTreeMap::deserialize(deserializer)?))
}

pub(crate) fn all_named<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Vec<BTreeMap<String, usize>>, D::Error> {
    Ok(Vec::deserialize(deserializer)?.into_iter().map(plain).collect())
}

fn plain(indices: BTreeMap<String, Index>) -> BTreeMap<String, usize> {
    indices.into_iter().map(|(name, index)| (name, index.0)).collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn negative_indices_are_out_of_range_and_displayed_as_written() {
        for number in [-1_i64, 0, 7, i64::MIN, i64::MAX] {
            let Index(index) = serde_json::from_str(&number.to_string()).unwrap();
            assert_eq!(DisplayIndex(index).to_string(), number.to_string());
            assert_eq!((0..8).contains(&number), index < 8);
        }
        assert!(serde_json::from_str::<Index>("0.5").is_err());
    }
}
