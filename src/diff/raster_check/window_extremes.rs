//! Minimum or maximum over a square window around each pixel, in time independent of the window size
//! (grey-scale erosion and dilation).
//!
//! The pixel comparison calls a pixel different only if its value lies outside the range of values near it in
//! the other drawing. This file computes that range for one channel.

/// For each item of a list, the extreme of the items within `reach` of it. `pick` returns the extreme of two
/// values.
///
/// Source: van Herk 1992; Gil and Werman 1993. The list is divided into blocks as long as the window. A
/// window meets at most two blocks, so a running extreme from each end of the blocks is enough.
fn windowed_extremes(values: &[u8], reach: usize, pick: fn(u8, u8) -> u8) -> Vec<u8> {
    let window = 2 * reach + 1;
    let count = values.len();
    let mut forth = values.to_vec();
    let mut back = values.to_vec();
    for index in 1..count {
        if index % window != 0 {
            forth[index] = pick(forth[index - 1], values[index]);
        }
        let mirrored = count - 1 - index;
        if !(mirrored + 1).is_multiple_of(window) {
            back[mirrored] = pick(back[mirrored + 1], values[mirrored]);
        }
    }
    (0..count)
        .map(|index| {
            let (first, last) = (index.saturating_sub(reach), (index + reach).min(count - 1));
            if last - first + 1 == window {
                return pick(back[first], forth[last]);
            }
            // Near the ends of the list the window is shorter, and may lie in one block.
            match (first / window == last / window, first) {
                (true, 0) => forth[last],
                (true, _) => back[first],
                (false, _) => pick(back[first], forth[last]),
            }
        })
        .collect()
}

/// For each pixel, the extreme of the pixels within `reach` rows and columns of it. `pick` is `u8::min` or
/// `u8::max`.
///
/// `values` holds the image row by row, `columns` values per row. The result has the same layout. Rows are
/// filtered first, then columns.
pub(crate) fn square_extremes(
    values: &[u8],
    columns: usize,
    reach: usize,
    pick: fn(u8, u8) -> u8,
) -> Vec<u8> {
    if reach == 0 || columns == 0 {
        return values.to_vec();
    }
    let mut rows: Vec<u8> =
        values.chunks(columns).flat_map(|row| windowed_extremes(row, reach, pick)).collect();
    let count = rows.len() / columns;
    let mut column = vec![0; count];
    for x in 0..columns {
        for (y, value) in column.iter_mut().enumerate() {
            *value = rows[y * columns + x];
        }
        for (y, value) in windowed_extremes(&column, reach, pick).into_iter().enumerate() {
            rows[y * columns + x] = value;
        }
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn square_extremes_match_brute_force() {
        let (columns, rows) = (23, 17);
        let values: Vec<u8> = (0..columns * rows).map(|i| (i * 7919 % 251) as u8).collect();
        for reach in [0, 1, 2, 5, 11, 40] {
            let found = square_extremes(&values, columns, reach, u8::max);
            for y in 0..rows {
                for x in 0..columns {
                    let (ys, xs) = (
                        y.saturating_sub(reach)..=(y + reach).min(rows - 1),
                        x.saturating_sub(reach)..=(x + reach).min(columns - 1),
                    );
                    let all = ys.flat_map(|y| xs.clone().map(move |x| (x, y)));
                    let wanted = all.map(|(x, y)| values[y * columns + x]).max().unwrap_or(0);
                    assert_eq!(found[y * columns + x], wanted, "{x} {y} {reach}");
                }
            }
        }
    }
}
