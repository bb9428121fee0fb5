//! [`RankBitset`]: a bit set that returns the rank of a number, the count of smaller members, in constant time.

/// Set of numbers below a bound, with constant-time rank queries.
#[derive(Debug, Clone, Default)]
pub(crate) struct RankBitset {
    /// One bit per number: whether it is a member.
    words: Vec<u64>,
    /// Number of members before each word of `words`, and in total.
    before: Vec<u32>,
}

impl RankBitset {
    /// Builds the set of the `listed` numbers, all below `bound`. They may be in any order and repeat.
    #[must_use]
    pub(crate) fn new(bound: usize, listed: impl IntoIterator<Item = usize>) -> Self {
        let mut words = vec![0_u64; bound.div_ceil(64)];
        listed.into_iter().for_each(|number| words[number / 64] |= 1 << (number % 64));
        let mut before = Vec::with_capacity(words.len() + 1);
        before.push(0);
        let mut sum = 0;
        before.extend(words.iter().map(|word| {
            sum += word.count_ones();
            sum
        }));
        Self { words, before }
    }

    /// Number of members.
    #[inline]
    #[must_use]
    pub(crate) fn count(&self) -> usize {
        self.before.last().copied().unwrap_or_default() as usize
    }

    /// Whether a number below the bound is a member.
    #[inline]
    #[must_use]
    pub(crate) fn contains(&self, number: usize) -> bool {
        self.words[number / 64] >> (number % 64) & 1 == 1
    }

    /// Rank of a number below the bound: how many members are smaller.
    #[inline]
    #[must_use]
    pub(crate) fn of(&self, number: usize) -> u32 {
        let word = number / 64;
        self.before[word] + (self.words[word] & ((1 << (number % 64)) - 1)).count_ones()
    }

    /// Whether any number in `first..=last` is a member. Both are below the bound, and `first <= last`.
    #[inline]
    #[must_use]
    pub(crate) fn any_within(&self, first: usize, last: usize) -> bool {
        let (from, to) = (first / 64, last / 64);
        let (head, tail) = (u64::MAX << (first % 64), u64::MAX >> (63 - last % 64));
        if from == to {
            return self.words[from] & head & tail != 0;
        }
        self.words[from] & head != 0
            || self.words[to] & tail != 0
            || self.words[from + 1..to].iter().any(|word| *word != 0)
    }

    /// All members, ascending.
    pub(crate) fn iter(&self) -> impl Iterator<Item = usize> + '_ {
        self.words.iter().enumerate().filter(|(_, word)| **word != 0).flat_map(|(k, word)| {
            let mut rest = *word;
            std::iter::from_fn(move || {
                let bit = (rest != 0).then(|| rest.trailing_zeros() as usize)?;
                rest &= rest - 1;
                Some(64 * k + bit)
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::numbers::noise::hash;

    #[test]
    fn rank_bitset_matches_a_sorted_list() {
        for (bound, of) in [(1, 1), (64, 3), (65, 2), (1000, 17), (1000, 400), (300, 1)] {
            let is_held = |number: &usize| hash(1, &[*number as u64]).is_multiple_of(of);
            let plain: Vec<usize> = (0..bound).filter(is_held).collect();
            // Reversed and doubled: order and repetition must not matter.
            let ranks = RankBitset::new(bound, plain.iter().rev().chain(&plain).copied());
            assert_eq!(ranks.iter().collect::<Vec<_>>(), plain);
            assert_eq!(ranks.count(), plain.len());
            for number in 0..bound {
                assert_eq!(ranks.contains(number), is_held(&number));
                assert_eq!(ranks.of(number) as usize, plain.partition_point(|held| *held < number));
                for last in (number..bound).step_by(1 + number % 7) {
                    let any = plain.iter().any(|held| (number..=last).contains(held));
                    assert_eq!(ranks.any_within(number, last), any, "{number} to {last} of {bound}");
                }
            }
        }
        assert_eq!(RankBitset::default().count(), 0);
    }
}
