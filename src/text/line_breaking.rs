//! Line breaking: greedy, or balanced by dynamic programming.
//!
//! Balanced breaking runs twice: first to minimise the largest cost of a line, then to minimise the sum of
//! squares among the breaks that reach this minimum.

/// Breaks lines greedily, each as full as possible. Returns the indices of the breaks that end lines, or the
/// break where nothing fits.
///
/// `fits` tests a line between two breaks, `may_end` whether a line may end at a break, `must_end` whether it
/// must.
pub(crate) fn greedy(
    last: usize,
    fits: &mut dyn FnMut(usize, usize) -> bool,
    may_end: &dyn Fn(usize) -> bool,
    must_end: &dyn Fn(usize) -> bool,
) -> Result<Vec<usize>, usize> {
    let mut ends = Vec::new();
    let mut begin = 0;
    while begin < last {
        let mut end = None;
        for next in begin + 1..=last {
            if may_end(next) {
                if !fits(begin, next) {
                    break;
                }
                end = Some(next);
            }
            if must_end(next) {
                break;
            }
        }
        begin = end.ok_or(begin)?;
        ends.push(begin);
    }
    Ok(ends)
}

/// Splits a text into exactly `lines` lines and minimises the largest cost of a line; ties go to the smallest
/// sum of squares. Returns the largest cost and the ends of lines.
///
/// `cost` gets the number of the line and its two breaks. `None` means that this line is impossible, and so
/// are longer lines with the same end.
pub(crate) fn choose_balanced(
    lines: usize,
    last: usize,
    cost: &mut dyn FnMut(usize, usize, usize) -> Option<f64>,
    may_end: &dyn Fn(usize) -> bool,
) -> Option<(f64, Vec<usize>)> {
    let worst = search_breaks(lines, last, cost, may_end, f64::max)?.0;
    let mut within = |line: usize, from: usize, to: usize| {
        cost(line, from, to).filter(|cost| *cost <= worst).map(|cost| cost * cost)
    };
    let (_, ends) = search_breaks(lines, last, &mut within, may_end, |a, b| a + b)?;
    Some((worst, ends))
}

/// Dynamic programming over breaks: the cheapest ends of `lines` lines, with costs combined by `together`.
fn search_breaks(
    lines: usize,
    last: usize,
    cost: &mut dyn FnMut(usize, usize, usize) -> Option<f64>,
    may_end: &dyn Fn(usize) -> bool,
    together: fn(f64, f64) -> f64,
) -> Option<(f64, Vec<usize>)> {
    // For each break the least cost up to it; per line, where the line that ends there begins.
    let mut costs: Vec<Option<f64>> = vec![None; last + 1];
    *costs.first_mut()? = Some(0.0);
    let mut begins: Vec<Vec<usize>> = Vec::with_capacity(lines);
    for line in 0..lines {
        let mut next: Vec<Option<f64>> = vec![None; last + 1];
        let mut begin = vec![0; last + 1];
        for to in (1..=last).filter(|to| may_end(*to)) {
            for from in (0..to).rev() {
                let own = if from == 0 || may_end(from) { cost(line, from, to) } else { continue };
                let Some(own) = own else { break };
                let Some(before) = costs[from] else { continue };
                let sum = together(before, own);
                if next[to].is_none_or(|best| sum < best) {
                    (next[to], begin[to]) = (Some(sum), from);
                }
            }
        }
        costs = next;
        begins.push(begin);
    }
    let total = costs[last]?;
    let mut ends = vec![last];
    for begin in begins.iter().skip(1).rev() {
        let end = ends.last().copied().unwrap_or(last);
        ends.push(begin[end]);
    }
    ends.reverse();
    Some((total, ends))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All possible ends of a number of lines.
    fn all_line_ends(lines: usize, last: usize) -> Vec<Vec<usize>> {
        if lines == 1 {
            return vec![vec![last]];
        }
        let ways = (1..last)
            .flat_map(|end| all_line_ends(lines - 1, last - end).into_iter().map(move |rest| (end, rest)));
        ways.map(|(end, rest)| std::iter::once(end).chain(rest.into_iter().map(|e| e + end)).collect())
            .collect()
    }

    #[test]
    fn balanced_breaks_match_brute_force() {
        let mut seed = 7_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 40) as f64 / 16_777_216.0
        };
        for round in 0..40 {
            let last = 3 + round % 8;
            let lines = 1 + round % 3;
            let widths: Vec<f64> = (0..last).map(|_| 1.0 + random() * 9.0).collect();
            let bonus: Vec<f64> = (0..lines).map(|_| random() * 5.0).collect();
            let own =
                |line: usize, from: usize, to: usize| widths[from..to].iter().sum::<f64>() + bonus[line];
            let of_all = all_line_ends(lines, last).into_iter().map(|ends| {
                let begins = std::iter::once(0).chain(ends.iter().copied());
                let costs = begins.zip(&ends).enumerate().map(|(line, (from, to))| own(line, from, *to));
                let costs: Vec<f64> = costs.collect();
                let worst = costs.iter().copied().fold(0.0, f64::max);
                (worst, costs.iter().map(|c| c * c).sum::<f64>(), ends)
            });
            let best = of_all.min_by(|a, b| (a.0, a.1).partial_cmp(&(b.0, b.1)).unwrap()).unwrap();
            let mut cost = |line: usize, from: usize, to: usize| Some(own(line, from, to));
            let (worst, ends) = choose_balanced(lines, last, &mut cost, &|_| true).unwrap();
            assert!((worst - best.0).abs() < 1e-9, "round {round}: {worst} is not {}", best.0);
            assert_eq!(ends, best.2, "round {round}");
        }
        assert!(
            choose_balanced(3, 2, &mut |_, _, _| Some(1.0), &|_| true).is_none(),
            "more lines than pieces"
        );
    }
}
