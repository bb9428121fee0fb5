//! Ranges of numbers, from start to end.

/// Sorted ranges, where ranges that overlap or are at most `gap` apart are merged.
pub(crate) fn joined(mut ranges: Vec<(f64, f64)>, gap: f64) -> Vec<(f64, f64)> {
    ranges.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut joined: Vec<(f64, f64)> = Vec::with_capacity(ranges.len());
    for (from, to) in ranges {
        match joined.last_mut() {
            Some(last) if from <= last.1 + gap => last.1 = last.1.max(to),
            _ => joined.push((from, to)),
        }
    }
    joined
}
