//! [`merge`]: specks of colour go to what is around them.

use super::labels::Labels;

/// Paints what hangs together on fewer texels than this like the neighbour with which it shares most of its border, small ones
/// first.
pub(super) fn merge(labels: &mut Labels, least: f64) {
    // Specks may lie within specks.
    for _ in 0..3 {
        if !merge_once(labels, least) {
            break;
        }
    }
}

const UNKNOWN: u32 = u32::MAX;

fn merge_once(labels: &mut Labels, least: f64) -> bool {
    let texels = labels.texels;
    let count = texels.size[0] * texels.size[1];
    let mut set = vec![UNKNOWN; count];
    let mut small: Vec<Vec<usize>> = Vec::new();
    let mut sizes: Vec<usize> = Vec::new();
    let mut open = Vec::new();
    let mut own = Vec::new();
    for first in 0..count {
        if set[first] != UNKNOWN {
            continue;
        }
        let number = sizes.len() as u32;
        let colour = labels.winner(first);
        set[first] = number;
        open.push(first);
        own.clear();
        let mut size = 0;
        while let Some(texel) = open.pop() {
            size += 1;
            if (own.len() as f64) < least {
                own.push(texel);
            }
            for next in texels.beside(texel) {
                if set[next] == UNKNOWN && labels.winner(next) == colour {
                    set[next] = number;
                    open.push(next);
                }
            }
        }
        sizes.push(size);
        if (size as f64) < least {
            small.push(own.clone());
        }
    }
    small.sort_by_key(|speck| (speck.len(), speck[0]));
    let mut is_changed = false;
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
            is_changed = true;
        }
    }
    is_changed
}
