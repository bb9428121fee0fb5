//! [`Noded`]: straight pieces of borders on a fine grid, cut so that they meet in shared points only.
//!
//! Points lie on a grid and all tests are exact in integers. Pieces are cut where they cross or where
//! a point lies on them, the new points go to the grid, and that is repeated until nothing crosses:
//! rounding may bring new crossings, though seldom. Source: the idea of iterated snap rounding
//! (Halperin and Packer, "Iterated snap rounding", Computational Geometry 23, 2002), here with points
//! that draw pieces near them in place of hot pixels.

use rayon::prelude::*;
use rustc_hash::FxHashMap;

use crate::math::grouped::{Grouped, grouped};

/// A point of the grid.
pub(super) type GridPoint = [i64; 2];

/// What a piece of border lies on and parts. Stronger ones first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) enum Border {
    /// Parts two surfaces, along straight edges.
    Hard,
    /// Parts two surfaces, where one of them is smooth.
    Soft,
    /// Parts two tones of one surface, along straight edges.
    HardTone,
    /// Parts two tones of a smooth surface.
    SoftTone,
}

impl Border {
    /// Whether it lies on a smooth surface.
    pub const fn is_soft(self) -> bool {
        matches!(self, Self::Soft | Self::SoftTone)
    }

    /// Whether the same surface goes on beyond it.
    pub const fn is_tone(self) -> bool {
        matches!(self, Self::HardTone | Self::SoftTone)
    }
}

/// A piece of a border between two points, by their numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct NodedPiece {
    /// The lesser number first.
    pub ends: [u32; 2],
    /// What it parts.
    pub border: Border,
}

/// Pieces that meet in shared points only.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Noded {
    pub points: Vec<GridPoint>,
    /// In order of their ends, no two alike.
    pub pieces: Vec<NodedPiece>,
}

/// Rounds of cutting at most. What still crosses then is left to the triangulation, which leaves
/// one of both out.
const MOST_ROUNDS: u32 = 16;

/// Pieces in a tile, on average over the page, much of which is empty.
const PIECES_A_TILE: usize = 1;

/// Most tiles across.
const MOST_TILES: usize = 1000;

/// A point this near to a piece (steps of the grid, squared) lies on it.
const ON_PIECE: f64 = 0.5;

/// Cuts segments of a grid. Ends that hang free, but no farther than `reach` from another piece, are
/// led on to it: tone borders end at the faces' own contour, which lies a little inside or outside of
/// the smooth one.
pub(super) fn node(segments: &[([GridPoint; 2], Border)], reach: f64) -> Noded {
    let mut noded = Noder::default();
    for ([a, b], border) in segments {
        let ends = [noded.point(*a), noded.point(*b)];
        noded.add(ends, *border);
    }
    noded.cut_all();
    if noded.bridge(reach) {
        noded.cut_all();
    }
    // Points are numbered by where they are, so that what follows does not depend on what else there is.
    let mut points = noded.points.clone();
    points.sort_unstable();
    let number = |old: u32| points.binary_search(&noded.points[old as usize]).unwrap_or_default() as u32;
    let numbers: Vec<u32> = (0..noded.points.len() as u32).map(number).collect();
    let mut pieces: Vec<NodedPiece> = noded.pieces;
    for piece in &mut pieces {
        piece.ends = piece.ends.map(|end| numbers[end as usize]);
        piece.ends.sort_unstable();
    }
    // Where two pieces coincide, the stronger border stays.
    pieces.sort_unstable();
    pieces.dedup_by_key(|piece| piece.ends);
    Noded { points, pieces }
}

#[derive(Default)]
struct Noder {
    points: Vec<GridPoint>,
    number: FxHashMap<GridPoint, u32>,
    pieces: Vec<NodedPiece>,
    /// Whether each piece is new since the last round; the others are known not to meet.
    fresh: Vec<bool>,
}

impl Noder {
    fn point(&mut self, p: GridPoint) -> u32 {
        let next = self.points.len() as u32;
        let number = *self.number.entry(p).or_insert(next);
        if number == next {
            self.points.push(p);
        }
        number
    }

    fn add(&mut self, [a, b]: [u32; 2], border: Border) {
        if a != b {
            self.pieces.push(NodedPiece { ends: [a.min(b), a.max(b)], border });
            self.fresh.push(true);
        }
    }

    fn cut_all(&mut self) {
        for _ in 0..MOST_ROUNDS {
            if !self.cut() {
                break;
            }
        }
    }

    /// Leads free ends on to the nearest piece; whether there were any.
    fn bridge(&mut self, reach: f64) -> bool {
        let mut uses = vec![(0u32, Border::Hard); self.points.len()];
        for piece in &self.pieces {
            for end in piece.ends {
                let (count, border) = &mut uses[end as usize];
                *count += 1;
                *border = piece.border;
            }
        }
        let free = (0..uses.len() as u32).filter(|p| uses[*p as usize].0 == 1);
        let asked: Vec<(u32, GridPoint)> = free.map(|p| (p, self.points[p as usize])).collect();
        if asked.is_empty() || reach <= 0.0 {
            return false;
        }
        let tiles = Tiles::new(&self.points, &self.pieces);
        let found: Vec<Option<GridPoint>> = asked
            .par_iter()
            .map(|(end, p)| {
                let mut nearest: Option<(f64, GridPoint)> = None;
                for k in tiles.around(*p, reach).flatten() {
                    let piece = self.pieces[*k as usize];
                    let [a, b] = piece.ends.map(|end| self.points[end as usize]);
                    let most = nearest.map_or(reach * reach, |(distance2, _)| distance2);
                    // Its box is no farther away than the piece.
                    if piece.ends.contains(end) || beside(a, b, *p) > most {
                        continue;
                    }
                    let found = foot(a, b, *p);
                    let is_nearer =
                        |old: (f64, GridPoint)| found.0 < old.0 || (found.0 == old.0 && found.1 < old.1);
                    if found.0 <= most && nearest.is_none_or(is_nearer) {
                        nearest = Some(found);
                    }
                }
                nearest.map(|(_, foot)| foot)
            })
            .collect();
        let before = self.pieces.len();
        for ((end, _), foot) in asked.iter().zip(found) {
            if let Some(foot) = foot {
                let foot = self.point(foot);
                let is_tone = uses[*end as usize].1.is_tone();
                self.add([*end, foot], if is_tone { Border::SoftTone } else { Border::Soft });
            }
        }
        self.pieces.len() > before
    }

    /// One round; whether anything was cut.
    fn cut(&mut self) -> bool {
        let tiles = Tiles::new(&self.points, &self.pieces);
        let is_fresh = |piece: &u32| self.fresh[*piece as usize];
        let found: Vec<Vec<(u32, GridPoint)>> = (0..tiles.pieces.count())
            .into_par_iter()
            .with_min_len(256)
            .map(|tile| {
                let tile = tiles.pieces.of(tile);
                let mut cuts = Vec::new();
                if !tile.iter().any(is_fresh) {
                    return cuts;
                }
                for (k, i) in tile.iter().enumerate() {
                    for j in &tile[k + 1..] {
                        if is_fresh(i) || is_fresh(j) {
                            self.meet(*i, *j, &mut cuts);
                        }
                    }
                }
                cuts
            })
            .collect();
        let mut cuts: Vec<(u32, GridPoint)> = found.into_iter().flatten().collect();
        cuts.sort_unstable();
        cuts.dedup();
        self.fresh.fill(false);
        if cuts.is_empty() {
            return false;
        }
        let before = std::mem::take(&mut self.pieces);
        let was_fresh = std::mem::take(&mut self.fresh);
        let mut at = 0;
        for (i, piece) in before.iter().enumerate() {
            let own = cuts[at..].iter().take_while(|cut| cut.0 as usize == i).count();
            if own == 0 {
                self.pieces.push(*piece);
                self.fresh.push(was_fresh[i]);
                continue;
            }
            let [a, b] = piece.ends.map(|end| self.points[end as usize]);
            let mut inner: Vec<GridPoint> = cuts[at..at + own].iter().map(|cut| cut.1).collect();
            at += own;
            inner.sort_by_key(|p| (dot(a, b, *p), *p));
            let mut from = piece.ends[0];
            for p in inner {
                let to = self.point(p);
                self.add([from, to], piece.border);
                from = to;
            }
            self.add([from, piece.ends[1]], piece.border);
        }
        true
    }

    /// Where two pieces must be cut.
    fn meet(&self, i: u32, j: u32, cuts: &mut Vec<(u32, GridPoint)>) {
        let ends = |k: u32| self.pieces[k as usize].ends.map(|end| self.points[end as usize]);
        let ([a, b], [c, d]) = (ends(i), ends(j));
        for axis in 0..2 {
            if a[axis].max(b[axis]) + 1 < c[axis].min(d[axis])
                || c[axis].max(d[axis]) + 1 < a[axis].min(b[axis])
            {
                return;
            }
        }
        let before = cuts.len();
        for (piece, [a, b], p) in [(i, [a, b], c), (i, [a, b], d), (j, [c, d], a), (j, [c, d], b)] {
            if lies_on(a, b, p) {
                cuts.push((piece, p));
            }
        }
        if cuts.len() > before {
            return;
        }
        let sides = [orient(a, b, c), orient(a, b, d), orient(c, d, a), orient(c, d, b)];
        if sides[0].signum() * sides[1].signum() < 0 && sides[2].signum() * sides[3].signum() < 0 {
            let t = sides[2] as f64 / (sides[2] - sides[3]) as f64;
            let at = |k: usize| a[k] + ((b[k] - a[k]) as f64 * t).round() as i64;
            let p = [at(0), at(1)];
            for (piece, [a, b]) in [(i, [a, b]), (j, [c, d])] {
                if p != a && p != b {
                    cuts.push((piece, p));
                }
            }
        }
    }
}

/// Twice the area of a triangle, positive where it turns from x to y.
fn orient(a: GridPoint, b: GridPoint, c: GridPoint) -> i64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// How far along a piece a point lies, times the piece's length.
fn dot(a: GridPoint, b: GridPoint, p: GridPoint) -> i64 {
    (b[0] - a[0]) * (p[0] - a[0]) + (b[1] - a[1]) * (p[1] - a[1])
}

/// Whether a point lies on a piece, and is none of its ends.
fn lies_on(a: GridPoint, b: GridPoint, p: GridPoint) -> bool {
    if p == a || p == b {
        return false;
    }
    let length2 = dot(a, b, b);
    let along = dot(a, b, p);
    let off = orient(a, b, p) as f64;
    along > 0 && along < length2 && off * off <= ON_PIECE * length2 as f64
}

/// The point of a piece that is nearest to a point, on the grid, and its distance squared.
fn foot(a: GridPoint, b: GridPoint, p: GridPoint) -> (f64, GridPoint) {
    let t = (dot(a, b, p) as f64 / (dot(a, b, b) as f64).max(1.0)).clamp(0.0, 1.0);
    let at = |k: usize| a[k] + ((b[k] - a[k]) as f64 * t).round() as i64;
    let foot = [at(0), at(1)];
    let (x, y) = ((foot[0] - p[0]) as f64, (foot[1] - p[1]) as f64);
    (x * x + y * y, foot)
}

/// The distance squared of a point from the box around a piece.
fn beside(a: GridPoint, b: GridPoint, p: GridPoint) -> f64 {
    let gap = |k: usize| (a[k].min(b[k]) - p[k]).max(p[k] - a[k].max(b[k])).max(0) as f64;
    gap(0) * gap(0) + gap(1) * gap(1)
}

/// Pieces by the tiles of the page that they pass.
struct Tiles {
    pieces: Grouped<u32>,
    low: GridPoint,
    size: GridPoint,
    across: i64,
}

impl Tiles {
    fn new(points: &[GridPoint], pieces: &[NodedPiece]) -> Self {
        let low = [0, 1].map(|k| points.iter().map(|p| p[k]).min().unwrap_or_default());
        let high = [0, 1].map(|k| points.iter().map(|p| p[k]).max().unwrap_or_default());
        let across = ((pieces.len() / PIECES_A_TILE) as f64).sqrt() as usize;
        let across = across.clamp(1, MOST_TILES) as i64;
        let size = [0, 1].map(|k| ((high[k] - low[k]) / across + 1).max(1));
        let tile = |x: i64, k: usize| ((x - low[k]) / size[k]).clamp(0, across - 1);
        let each_tile = |piece: &NodedPiece, call: &mut dyn FnMut(usize)| {
            let [mut a, mut b] = piece.ends.map(|end| points[end as usize]);
            if a[1] > b[1] {
                std::mem::swap(&mut a, &mut b);
            }
            for row in tile(a[1] - 1, 1)..=tile(b[1] + 1, 1) {
                // The part of the piece within this row, and a step more.
                let (top, bottom) = (low[1] + row * size[1] - 2, low[1] + (row + 1) * size[1] + 2);
                let at = |y: i64| {
                    let rise = (b[1] - a[1]) as f64;
                    let t = if rise > 0.0 { ((y - a[1]) as f64 / rise).clamp(0.0, 1.0) } else { 0.0 };
                    a[0] as f64 + (b[0] - a[0]) as f64 * t
                };
                let (x, y) = if a[1] == b[1] { (a[0] as f64, b[0] as f64) } else { (at(top), at(bottom)) };
                let from = tile(x.min(y).floor() as i64 - 2, 0);
                for column in from..=tile(x.max(y).ceil() as i64 + 2, 0) {
                    call((row * across + column) as usize);
                }
            }
        };
        let pieces = grouped((across * across) as usize, |put| {
            for (number, piece) in pieces.iter().enumerate() {
                each_tile(piece, &mut |tile| put(tile, number as u32));
            }
        });
        Self { pieces, low, size, across }
    }

    /// The tiles within `reach` of a point.
    fn around(&self, p: GridPoint, reach: f64) -> impl Iterator<Item = &[u32]> {
        let reach = reach.ceil() as i64;
        let tile = |x: i64, k: usize| ((x - self.low[k]) / self.size[k]).clamp(0, self.across - 1);
        let range = |k: usize| tile(p[k] - reach, k)..=tile(p[k] + reach, k);
        let columns = range(0);
        let tiles =
            range(1).flat_map(move |row| columns.clone().map(move |column| row * self.across + column));
        tiles.map(|tile| self.pieces.of(tile as usize))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points anywhere in a square, always the same.
    fn scattered(count: usize, size: i64) -> Vec<GridPoint> {
        let mut state = 12_345_u64;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as i64 % size
        };
        (0..count).map(|_| [next(), next()]).collect()
    }

    fn meets_in_points_only(noded: &Noded) {
        for (k, first) in noded.pieces.iter().enumerate() {
            for second in &noded.pieces[k + 1..] {
                let [a, b] = first.ends.map(|end| noded.points[end as usize]);
                let [c, d] = second.ends.map(|end| noded.points[end as usize]);
                let crosses = orient(a, b, c).signum() * orient(a, b, d).signum() < 0
                    && orient(c, d, a).signum() * orient(c, d, b).signum() < 0;
                assert!(!crosses, "{a:?} {b:?} cross {c:?} {d:?}");
                assert!(!lies_on(a, b, c) && !lies_on(a, b, d) && !lies_on(c, d, a) && !lies_on(c, d, b));
            }
        }
    }

    #[test]
    fn a_crossing_becomes_a_point() {
        let noded = node(&[([[0, 0], [10, 10]], Border::Soft), ([[0, 10], [10, 0]], Border::Soft)], 0.0);
        assert_eq!(noded.pieces.len(), 4);
        assert!(noded.points.contains(&[5, 5]));
    }

    #[test]
    fn a_point_on_a_piece_cuts_it_and_what_lies_twice_stays_once() {
        let noded = node(
            &[
                ([[0, 0], [10, 0]], Border::Soft),
                ([[4, 0], [20, 0]], Border::Hard),
                ([[5, 7], [5, 0]], Border::Soft),
            ],
            0.0,
        );
        let sorted: Vec<[GridPoint; 2]> =
            noded.pieces.iter().map(|piece| piece.ends.map(|end| noded.points[end as usize])).collect();
        assert_eq!(sorted.len(), 5, "{sorted:?}");
        let hard = noded.pieces.iter().filter(|piece| piece.border == Border::Hard).count();
        assert_eq!(hard, 3, "from 4 to 5 to 10 to 20");
    }

    #[test]
    fn a_free_end_is_led_on_to_what_is_near() {
        let segments = [([[0, 0], [100, 0]], Border::Hard), ([[50, 4], [50, 90]], Border::Soft)];
        assert_eq!(node(&segments, 3.0).pieces.len(), 2);
        let noded = node(&segments, 5.0);
        assert_eq!(noded.pieces.len(), 4, "{noded:?}");
        assert!(noded.points.contains(&[50, 0]));
    }

    #[test]
    fn crowds_meet_in_shared_points_only() {
        for (count, size) in [(60, 400), (120, 1000), (200, 100_000)] {
            let points = scattered(count, size);
            let segments: Vec<([GridPoint; 2], Border)> =
                points.chunks_exact(2).map(|pair| ([pair[0], pair[1]], Border::Soft)).collect();
            meets_in_points_only(&node(&segments, 0.0));
        }
    }
}
