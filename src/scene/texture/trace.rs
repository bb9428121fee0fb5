//! [`trace`]: the borders between the colours of a picture, in the plane of its texels.

use glam::DVec2;
use rustc_hash::FxHashMap;

use super::labels::{Cell, Labels, Parting};
use crate::scene::texels::Traced;

/// A picture with more pieces of border than this has none.
const MOST_PIECES: usize = 1 << 22;

/// Where borders end in a cell: on a side between neighbouring texels (the column and row of the first, and whether the second
/// lies below it), or in the middle of the cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
enum Place {
    Side(u32, u32, bool),
    Middle(u32, u32),
}

/// Traces the borders between colours; none if there are too many.
pub(crate) fn trace(labels: &Labels) -> Option<Traced> {
    let (reach, periods) = (labels.texels.reach(), labels.texels.periods());
    let mut pieces: Vec<[(Place, DVec2); 2]> = Vec::new();
    let columns: Vec<usize> = (0..=reach[0] as i64).map(|i| labels.texels.index(i, 0)).collect();
    for j in 0..reach[1] as u32 {
        let rows = [0, 1].map(|down| labels.texels.index(0, i64::from(j) + down));
        for i in 0..reach[0] as u32 {
            let colour = |row: usize, right: usize| labels.winner(rows[row] + columns[i as usize + right]);
            let own = colour(0, 0);
            if [(0, 1), (1, 0), (1, 1)].iter().all(|(row, right)| colour(*row, *right) == own) {
                continue;
            }
            let cell = Cell::new(labels, i.into(), j.into());
            let at = DVec2::new(f64::from(i), f64::from(j));
            let place = |side: usize| match side {
                0 => Place::Side(i, j, false),
                1 => Place::Side(i + 1, j, true),
                2 => Place::Side(i, j + 1, false),
                _ => Place::Side(i, j, true),
            };
            let end = |side: usize| Some((place(side), at + cell.crossing(side)?));
            match cell.parting() {
                Parting::Not => {}
                Parting::Across(ways) => {
                    pieces.extend(ways.iter().filter_map(|way| Some([end(way[0])?, end(way[1])?])));
                }
                Parting::Meeting(middle) => {
                    let middle = (Place::Middle(i, j), at + middle);
                    pieces.extend((0..4).filter_map(|side| Some([end(side)?, middle])));
                }
            }
        }
        if pieces.len() > MOST_PIECES {
            return None;
        }
    }
    Some(Traced { lines: linked(&pieces), reach, periods })
}

/// Pieces end to end, from where three meet, or none goes on, to the next such place.
fn linked(pieces: &[[(Place, DVec2); 2]]) -> Vec<Vec<DVec2>> {
    let mut at: FxHashMap<Place, Vec<u32>> = FxHashMap::default();
    for (number, piece) in pieces.iter().enumerate() {
        for (place, _) in piece {
            at.entry(*place).or_default().push(number as u32);
        }
    }
    let mut used = vec![false; pieces.len()];
    let mut lines = Vec::new();
    let mut follow = |first: usize, backward: bool| {
        let mut line = Vec::new();
        let (mut number, mut backward) = (first, backward);
        while !std::mem::replace(&mut used[number], true) {
            let piece = pieces[number];
            let [from, to] = if backward { [piece[1], piece[0]] } else { piece };
            if line.is_empty() {
                line.push(from.1);
            }
            line.push(to.1);
            let next = match at.get(&to.0).map(Vec::as_slice) {
                Some([a, b]) => Some(if *a as usize == number { *b } else { *a }),
                _ => None,
            };
            let Some(next) = next else { break };
            number = next as usize;
            backward = pieces[number][0].0 != to.0;
        }
        if line.len() > 1 {
            lines.push(line);
        }
    };
    // Lines that end anywhere first, then rings.
    for (number, piece) in pieces.iter().enumerate() {
        for (end, (place, _)) in piece.iter().enumerate() {
            if at.get(place).is_some_and(|there| there.len() != 2) {
                follow(number, end == 1);
            }
        }
    }
    (0..pieces.len()).for_each(|number| follow(number, false));
    lines
}
