//! [`merge`]: specks of colour go to what is around them.

use super::labels::Labels;

/// Paints what hangs together on fewer texels than this like the neighbour with which it shares most of its border, small ones
/// first. Gives the number of texels that were specks at first.
pub(super) fn merge(labels: &mut Labels, least: f64) -> usize {
    let first = merge_once(labels, least);
    // Specks may lie within specks.
    if first > 0 && merge_once(labels, least) > 0 {
        merge_once(labels, least);
    }
    first
}

/// Gives the number of texels that were painted anew.
fn merge_once(labels: &mut Labels, least: f64) -> usize {
    let texels = labels.texels;
    let count = texels.size[0] * texels.size[1];
    let mut is_known = vec![false; count];
    let mut small: Vec<Vec<usize>> = Vec::new();
    let mut open = Vec::new();
    let mut own = Vec::new();
    for first in 0..count {
        if std::mem::replace(&mut is_known[first], true) {
            continue;
        }
        let colour = labels.winner(first);
        open.push(first);
        own.clear();
        let mut size = 0;
        while let Some(texel) = open.pop() {
            size += 1;
            if (own.len() as f64) < least {
                own.push(texel);
            }
            for next in texels.beside(texel) {
                if !is_known[next] && labels.winner(next) == colour {
                    is_known[next] = true;
                    open.push(next);
                }
            }
        }
        if (size as f64) < least {
            small.push(own.clone());
        }
    }
    small.sort_by_key(|speck| (speck.len(), speck[0]));
    let mut changed = 0;
    for speck in small {
        let colour = labels.winner(speck[0]);
        let mut shared: Vec<(u8, usize)> = Vec::new();
        for next in speck.iter().flat_map(|texel| texels.beside(*texel)) {
            let other = labels.winner(next);
            if other == colour {
                continue;
            }
            match shared.iter_mut().find(|(known, _)| *known == other) {
                Some((_, length)) => *length += 1,
                None => shared.push((other, 1)),
            }
        }
        if let Some((other, _)) =
            shared.iter().max_by_key(|(other, length)| (*length, std::cmp::Reverse(*other)))
        {
            speck.iter().for_each(|texel| labels.repaint(*texel, *other));
            changed += speck.len();
        }
    }
    changed
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::material::Wrap;
    use crate::scene::texels::Texels;
    use crate::scene::texture::guess::Guess;

    #[test]
    fn specks_take_the_colour_around_them_over_seams_too() {
        // A speck of four on the corners of the picture, which hang together, one of two, and a patch of nine.
        let colour = |k: usize| match (k % 12, k / 12) {
            (0 | 11, 0 | 11) => 1,
            (5, 5 | 6) => 2,
            (8..=10, 2..=4) => 1,
            _ => 0,
        };
        let guesses: Vec<Guess> =
            (0..144).map(|k| Guess { nearest: colour(k), second: 0, way: 0.0 }).collect();
        let texels = Texels {
            size: [12, 12],
            wrap: [Wrap::Repeat; 2],
            upward: false,
            placing: crate::scene::material::Placing::default(),
        };
        let merged = |least: f64| {
            let mut labels = Labels::of(texels, &guesses, 0.0, 3);
            merge(&mut labels, least);
            [0, 5 * 12 + 5, 3 * 12 + 9].map(|texel| labels.winner(texel))
        };
        assert_eq!(merged(4.0), [1, 0, 1]);
        assert_eq!(merged(5.0), [0, 0, 1]);
        assert_eq!(merged(10.0), [0, 0, 0]);
    }
}
