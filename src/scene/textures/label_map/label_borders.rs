//! [`trace_label_borders`]: traces the borders between the colour labels of a picture, in the texel plane.

use glam::DVec2;
use rustc_hash::FxHashMap;

use super::colour_labels::{CellBorders, ColourLabels, LabelCell};
use crate::scene::textures::texel_plane::TracedBorders;

/// Maximum number of border pieces in a picture.
const MAX_BORDER_PIECES: usize = 1 << 22;

/// End of a border piece in a cell.
///
/// A side is between adjacent texels: column and row of the first, and whether the second is below it.
/// Otherwise the end is in the middle of the cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
enum BorderEnd {
    Side(u32, u32, bool),
    Middle(u32, u32),
}

/// Traces the borders between labels; `None` if there are too many.
pub(crate) fn trace_label_borders(labels: &ColourLabels) -> Option<TracedBorders> {
    let (reach, periods) = (labels.texels.reach(), labels.texels.periods());
    let mut pieces: Vec<LabelBorderPiece> = Vec::new();
    let columns: Vec<usize> = (0..=reach[0] as i64).map(|i| labels.texels.index(i, 0)).collect();
    for j in 0..reach[1] as u32 {
        let rows = [0, 1].map(|down| labels.texels.index(0, i64::from(j) + down));
        for i in 0..reach[0] as u32 {
            let colour = |row: usize, right: usize| labels.winner(rows[row] + columns[i as usize + right]);
            let own = colour(0, 0);
            if [(0, 1), (1, 0), (1, 1)].iter().all(|(row, right)| colour(*row, *right) == own) {
                continue;
            }
            let cell = LabelCell::new(labels, i.into(), j.into());
            let at = DVec2::new(f64::from(i), f64::from(j));
            let place = |side: usize| match side {
                0 => BorderEnd::Side(i, j, false),
                1 => BorderEnd::Side(i + 1, j, true),
                2 => BorderEnd::Side(i, j + 1, false),
                _ => BorderEnd::Side(i, j, true),
            };
            let end = |side: usize| Some((place(side), at + cell.crossing(side)?));
            let parted = |side: usize| {
                let [a, b] = [cell.colours[side], cell.colours[(side + 1) % 4]];
                [a.min(b), a.max(b)]
            };
            match cell.parting() {
                CellBorders::Uniform => {}
                CellBorders::Across(ways) => {
                    pieces.extend(ways.iter().filter_map(|way| {
                        Some(LabelBorderPiece { ends: [end(way[0])?, end(way[1])?], parted: parted(way[0]) })
                    }));
                }
                CellBorders::Meeting(middle) => {
                    let middle = (BorderEnd::Middle(i, j), at + middle);
                    pieces.extend((0..4).filter_map(|side| {
                        Some(LabelBorderPiece { ends: [end(side)?, middle], parted: parted(side) })
                    }));
                }
            }
        }
        if pieces.len() > MAX_BORDER_PIECES {
            return None;
        }
    }
    let (lines, parted) = link_pieces(&pieces);
    Some(TracedBorders { lines, parted, reach, periods })
}

/// Piece of a border within a cell.
struct LabelBorderPiece {
    ends: [(BorderEnd, DVec2); 2],
    /// The two colours on its sides.
    parted: [u8; 2],
}

/// Links pieces to lines that end where three borders meet or where a border ends, with the two colours of
/// each line.
fn link_pieces(pieces: &[LabelBorderPiece]) -> (Vec<Vec<DVec2>>, Vec<[u8; 2]>) {
    let mut at: FxHashMap<BorderEnd, Vec<u32>> = FxHashMap::default();
    for (number, piece) in pieces.iter().enumerate() {
        for (place, _) in piece.ends {
            at.entry(place).or_default().push(number as u32);
        }
    }
    let mut used = vec![false; pieces.len()];
    let (mut lines, mut parted) = (Vec::new(), Vec::new());
    let mut follow = |first: usize, backward: bool| {
        let mut line = Vec::new();
        let (mut number, mut backward) = (first, backward);
        while !std::mem::replace(&mut used[number], true) {
            let piece = pieces[number].ends;
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
            backward = pieces[number].ends[0].0 != to.0;
        }
        if line.len() > 1 {
            lines.push(line);
            parted.push(pieces[first].parted);
        }
    };
    // Open lines first, then rings.
    for (number, piece) in pieces.iter().enumerate() {
        for (end, (place, _)) in piece.ends.iter().enumerate() {
            if at.get(place).is_some_and(|there| there.len() != 2) {
                follow(number, end == 1);
            }
        }
    }
    (0..pieces.len()).for_each(|number| follow(number, false));
    (lines, parted)
}

#[cfg(test)]
mod tests {
    use super::super::soft_assignment::SoftAssignment;
    use super::super::texel_assignments::TexelAssignments;
    use super::*;
    use crate::scene::material::Wrap;
    use crate::scene::textures::texel_plane::TexelPlane;

    fn labels(size: [usize; 2], wrap: Wrap, blur: f64, of: impl Fn(DVec2) -> (u8, u8, f32)) -> ColourLabels {
        let at = |k: usize| DVec2::new((k % size[0]) as f64, (k / size[0]) as f64);
        let guess = |k: usize| {
            let (nearest, second, way) = of(at(k));
            SoftAssignment { nearest, second, way }
        };
        let guesses: Vec<SoftAssignment> = (0..size[0] * size[1]).map(guess).collect();
        let texels = TexelPlane {
            size,
            wrap: [wrap; 2],
            upward: false,
            placing: crate::scene::material::Placing::default(),
        };
        ColourLabels::of(&TexelAssignments::new(texels, guesses), blur, 3)
    }

    /// Disc of colour 1 on colour 0 in the middle of 48 texels, with an edge one texel soft.
    fn disc(p: DVec2) -> (u8, u8, f32) {
        let share = (p.distance(DVec2::splat(23.5)) - 15.2 + 0.5).clamp(0.0, 1.0) as f32;
        if share < 0.5 { (1, 0, share) } else { (0, 1, 1.0 - share) }
    }

    #[test]
    fn label_border_of_a_disc_is_one_ring_at_its_edge() {
        for blur in [0.0, 0.8] {
            let traced = trace_label_borders(&labels([48, 48], Wrap::Repeat, blur, disc)).unwrap();
            assert_eq!(traced.lines.len(), 1);
            let ring = &traced.lines[0];
            assert_eq!(ring.first(), ring.last());
            let off = ring.iter().map(|p| (p.distance(DVec2::splat(23.5)) - 15.2).abs()).fold(0.0, f64::max);
            assert!(off < 0.12, "{off} texels off, blurred by {blur}");
        }
    }

    #[test]
    fn label_borders_of_three_colours_meet_in_one_point() {
        let third = |p: DVec2| match (p.x < 4.0, p.y < 4.0) {
            (true, _) => (0, 0, 0.0),
            (false, true) => (1, 1, 0.0),
            (false, false) => (2, 2, 0.0),
        };
        let traced = trace_label_borders(&labels([8, 8], Wrap::Clamp, 0.0, third)).unwrap();
        assert_eq!(traced.lines.len(), 3);
        let meeting = DVec2::new(3.5, 3.5);
        let ends = |line: &Vec<DVec2>| [line[0], line[line.len() - 1]];
        assert!(traced.lines.iter().all(|line| ends(line).iter().any(|end| end.distance(meeting) < 0.2)));
    }

    #[test]
    fn labels_differ_across_label_borders_and_nowhere_else() {
        // Irregular patches of three colours, also across the seams.
        let patch = |p: DVec2| {
            let dice =
                (p.x as u64 / 3 * 7919 + p.y as u64 / 3 * 104_729).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 33;
            ((dice % 3) as u8, 0, 0.0)
        };
        for wrap in [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp] {
            let labels = labels([21, 18], wrap, 0.6, patch);
            let traced = trace_label_borders(&labels).unwrap();
            assert!(traced.lines.len() > 5, "{}", traced.lines.len());
            let beside = |a: DVec2, b: DVec2| {
                let across = (b - a).perp().normalize_or_zero() * 1e-4;
                [(a + b) / 2.0 + across, (a + b) / 2.0 - across].map(|p| labels.at(p))
            };
            let pieces = || traced.lines.iter().flat_map(|line| line.windows(2));
            // Every line has the two colours that it separates.
            for (line, parted) in traced.lines.iter().zip(&traced.parted) {
                let long = line.windows(2).find(|pair| pair[0].distance(pair[1]) > 0.05);
                let mut seen = long.map_or(*parted, |pair| beside(pair[0], pair[1]));
                seen.sort_unstable();
                assert_eq!(seen, *parted);
            }
            let wrong = pieces().filter(|pair| {
                let [left, right] = beside(pair[0], pair[1]);
                pair[0].distance(pair[1]) > 0.05 && left == right
            });
            assert_eq!(wrong.count(), 0, "{wrap:?}");
            // Along a scan line, the parity of colour changes equals that of border crossings.
            for row in 0..170 {
                let y = f64::from(row) * 0.1 + 0.043;
                let at = |k: u32| DVec2::new(f64::from(k) * 0.002 + 0.0007, y);
                let changes = (0..10_000).filter(|k| labels.at(at(*k)) != labels.at(at(*k + 1))).count();
                let crossed = pieces()
                    .filter(|pair| {
                        let part = (y - pair[0].y) / (pair[1].y - pair[0].y);
                        let x = pair[0].x + (pair[1].x - pair[0].x) * part;
                        (pair[0].y > y) != (pair[1].y > y) && x > at(0).x && x < at(10_000).x
                    })
                    .count();
                assert_eq!(changes % 2, crossed % 2, "along y = {y}, {wrap:?}");
            }
        }
    }
}
