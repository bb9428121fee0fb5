//! [`Noded`]: border pieces on a fine grid that meet in shared points only (snap rounding).
//!
//! 1. Points lie on an integer grid, so all tests are exact.
//! 2. Pieces are cut where they cross or where a point lies on them. New points are rounded to the grid.
//! 3. Rounding may cause new crossings, though rarely. The step is repeated until nothing crosses.
//! 4. Free ends are extended to the nearest piece within reach.
//!
//! Source: iterated snap rounding (Halperin and Packer, "Iterated snap rounding", Computational Geometry 23,
//! 2002). Deviation: points attract the pieces near them, in place of hot pixels.

use crate::parallel::prelude::*;
use rustc_hash::FxHashMap;

use super::grid_tiles::GridPoint;
use super::grid_tiles::GridTiles;
use super::segment_crossing::{TilePiece, box_distance2, dot, foot};

/// Kind of a border: the things it separates, and whether its line is smooth. Stronger kinds come first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum Border {
    /// Separates two surfaces, along a sharp line.
    Hard,
    /// Separates two surfaces, one of them smooth.
    Soft,
    /// Separates two tones of one surface, along a sharp line.
    HardTone,
    /// Separates two tones of a smooth surface.
    SoftTone,
}

impl Border {
    /// Whether it lies on a smooth surface.
    pub(crate) const fn is_soft(self) -> bool {
        matches!(self, Self::Soft | Self::SoftTone)
    }

    /// Whether the same surface continues on its other side.
    pub(crate) const fn is_tone(self) -> bool {
        matches!(self, Self::HardTone | Self::SoftTone)
    }
}

/// Border piece between two points, by their ids.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct NodedPiece {
    /// Smaller id first.
    pub ends: [u32; 2],
    /// Kind of border.
    pub border: Border,
}

/// Border pieces that meet in shared points only.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Noded {
    pub points: Vec<GridPoint>,
    /// Sorted by their ends, without duplicates.
    pub pieces: Vec<NodedPiece>,
}

/// Maximum number of rounds. The triangulation leaves out one of two pieces that still cross.
const MAX_ROUNDS: u32 = 16;

/// Cuts segments on the grid until they meet in shared points only.
///
/// Free ends within `reach` of another piece are extended to it. Tone borders end at the contour of the
/// faces, which lies slightly off the smooth contour.
pub(crate) fn node(segments: &[([GridPoint; 2], Border)], reach: f64) -> Noded {
    let mut noded = Noder::with_capacity(segments.len());
    for ([a, b], border) in segments {
        let ends = [noded.point(*a), noded.point(*b)];
        noded.add(ends, *border, noded.pieces.len() as u32);
    }
    noded.tiles = GridTiles::new(&noded.points, noded.pieces.len(), |piece| noded.ends(piece));
    noded.cut_all((0..noded.tiles.count() as u32).collect());
    let touched = noded.bridge(reach);
    noded.cut_all(touched);
    // Point ids follow position, so the result does not depend on the order of the input.
    let mut sorted: Vec<(GridPoint, u32)> = noded.points.iter().copied().zip(0..).collect();
    sorted.par_sort_unstable();
    let mut numbers = vec![0; sorted.len()];
    for (number, (_, old)) in sorted.iter().enumerate() {
        numbers[*old as usize] = number as u32;
    }
    let points = sorted.into_iter().map(|(point, _)| point).collect();
    let mut pieces: Vec<NodedPiece> = noded.whole().map(|(_, piece)| *piece).collect();
    for piece in &mut pieces {
        piece.ends = piece.ends.map(|end| numbers[end as usize]);
        piece.ends.sort_unstable();
    }
    // Where two pieces coincide, the stronger border is kept.
    pieces.par_sort_unstable();
    pieces.dedup_by_key(|piece| piece.ends);
    Noded { points, pieces }
}

#[derive(Default)]
struct Noder {
    points: Vec<GridPoint>,
    number: FxHashMap<GridPoint, u32>,
    pieces: Vec<NodedPiece>,
    /// Original piece that each piece was cut from.
    origins: Vec<u32>,
    /// Whether each piece was cut into others.
    is_cut: Vec<bool>,
    /// First piece that is new since the last round. Older pieces do not meet each other.
    first_new: u32,
    tiles: GridTiles,
}

impl Noder {
    /// A noder with capacity for the given number of connected pieces.
    fn with_capacity(pieces: usize) -> Self {
        let mut noder = Self::default();
        noder.points.reserve(pieces);
        noder.number.reserve(pieces);
        noder.pieces.reserve(pieces);
        noder.origins.reserve(pieces);
        noder.is_cut.reserve(pieces);
        noder
    }

    fn point(&mut self, p: GridPoint) -> u32 {
        let next = self.points.len() as u32;
        let number = *self.number.entry(p).or_insert(next);
        if number == next {
            self.points.push(p);
        }
        number
    }

    fn add(&mut self, [a, b]: [u32; 2], border: Border, origin: u32) {
        if a != b {
            self.pieces.push(NodedPiece { ends: [a.min(b), a.max(b)], border });
            self.origins.push(origin);
            self.is_cut.push(false);
        }
    }

    fn ends(&self, piece: u32) -> [GridPoint; 2] {
        self.pieces[piece as usize].ends.map(|end| self.points[end as usize])
    }

    /// Pieces that were not cut, with their numbers.
    fn whole(&self) -> impl Iterator<Item = (u32, &NodedPiece)> {
        (0..).zip(&self.pieces).filter(|(number, _)| !self.is_cut[*number as usize])
    }

    /// Cuts pieces until none meet, starting with the given tiles.
    fn cut_all(&mut self, mut touched: Vec<u32>) {
        for _ in 0..MAX_ROUNDS {
            if touched.is_empty() {
                break;
            }
            touched = self.cut(&touched);
        }
        self.first_new = self.pieces.len() as u32;
    }

    /// Adds the pieces from `first` on to their tiles, and returns these tiles.
    fn touch(&mut self, first: u32) -> Vec<u32> {
        let mut touched = Vec::new();
        for piece in first..self.pieces.len() as u32 {
            let ends = self.ends(piece);
            self.tiles.add(piece, ends, |tile| touched.push(tile));
        }
        touched.sort_unstable();
        touched.dedup();
        touched
    }

    /// Extends free ends to the nearest piece. Returns the tiles of the new pieces.
    fn bridge(&mut self, reach: f64) -> Vec<u32> {
        let mut uses = vec![(0u32, Border::Hard); self.points.len()];
        for (_, piece) in self.whole() {
            for end in piece.ends {
                let (count, border) = &mut uses[end as usize];
                *count += 1;
                *border = piece.border;
            }
        }
        let free = (0..uses.len() as u32).filter(|p| uses[*p as usize].0 == 1);
        let free_ends: Vec<(u32, GridPoint)> = free.map(|p| (p, self.points[p as usize])).collect();
        if free_ends.is_empty() || reach <= 0.0 {
            return Vec::new();
        }
        let bridge_ends: Vec<Option<GridPoint>> = free_ends
            .par_iter()
            .map(|(end, p)| {
                let mut nearest: Option<(f64, GridPoint)> = None;
                for k in self.tiles.around(*p, reach).flat_map(|tile| self.tiles.of(tile)) {
                    let [a, b] = self.ends(k);
                    let max_distance2 = nearest.map_or(reach * reach, |(distance2, _)| distance2);
                    let is_own = self.pieces[k as usize].ends.contains(end);
                    // The bounding box is at least as near as the piece.
                    if self.is_cut[k as usize] || is_own || box_distance2(a, b, *p) > max_distance2 {
                        continue;
                    }
                    let candidate = foot(a, b, *p);
                    let is_nearer = |old: (f64, GridPoint)| {
                        candidate.0 < old.0 || (candidate.0 == old.0 && candidate.1 < old.1)
                    };
                    if candidate.0 <= max_distance2 && nearest.is_none_or(is_nearer) {
                        nearest = Some(candidate);
                    }
                }
                nearest.map(|(_, foot)| foot)
            })
            .collect();
        for ((end, _), foot) in free_ends.iter().zip(bridge_ends) {
            if let Some(foot) = foot {
                let foot = self.point(foot);
                let is_tone = uses[*end as usize].1.is_tone();
                let border = if is_tone { Border::SoftTone } else { Border::Soft };
                self.add([*end, foot], border, self.pieces.len() as u32);
            }
        }
        self.touch(self.first_new)
    }

    /// Runs one round in the given tiles: cuts new pieces and those that they meet. Returns the tiles of
    /// their parts.
    fn cut(&mut self, touched: &[u32]) -> Vec<u32> {
        const TILES_PER_TASK: usize = 256;
        let in_tiles = |tiles: &[u32]| {
            let (mut cuts, mut own) = (Vec::new(), Vec::new());
            for tile in tiles {
                own.clear();
                let whole = self.tiles.of(*tile).filter(|piece| !self.is_cut[*piece as usize]);
                own.extend(whole.map(|k| TilePiece::new(self.ends(k), k, self.origins[k as usize])));
                for (k, new) in own.iter().enumerate().filter(|(_, piece)| piece.number >= self.first_new) {
                    own[..k]
                        .iter()
                        .filter(|other| new.is_near(other))
                        .for_each(|other| new.meet(other, &mut cuts));
                }
            }
            cuts
        };
        let mut cuts: Vec<(u32, GridPoint)> =
            touched.par_chunks(TILES_PER_TASK).with_max_len(1).flat_map_iter(in_tiles).collect();
        cuts.par_sort_unstable();
        cuts.dedup();
        let first_new = self.pieces.len() as u32;
        for cuts in cuts.chunk_by(|one, other| one.0 == other.0) {
            let number = cuts[0].0 as usize;
            let (piece, origin) = (self.pieces[number], self.origins[number]);
            let [a, b] = self.ends(cuts[0].0);
            self.is_cut[number] = true;
            let mut inner: Vec<GridPoint> = cuts.iter().map(|cut| cut.1).collect();
            inner.sort_by_key(|p| (dot(a, b, *p), *p));
            let mut from = piece.ends[0];
            for p in inner {
                let to = self.point(p);
                self.add([from, to], piece.border, origin);
                from = to;
            }
            self.add([from, piece.ends[1]], piece.border, origin);
        }
        self.first_new = first_new;
        self.touch(first_new)
    }
}

#[cfg(test)]
mod tests {
    use super::super::segment_crossing::{lies_on, orient};
    use super::*;

    /// Pseudo-random points in a square.
    fn random_points(count: usize, size: i64) -> Vec<GridPoint> {
        let mut state = 12_345_u64;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as i64 % size
        };
        (0..count).map(|_| [next(), next()]).collect()
    }

    fn assert_meet_only_in_points(noded: &Noded) {
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
    fn snap_rounding_splits_segments_at_crossings() {
        let noded = node(&[([[0, 0], [10, 10]], Border::Soft), ([[0, 10], [10, 0]], Border::Soft)], 0.0);
        assert_eq!(noded.pieces.len(), 4);
        assert!(noded.points.contains(&[5, 5]));
    }

    #[test]
    fn snap_rounding_splits_at_touching_points_and_merges_overlaps() {
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
    fn snap_rounding_extends_free_ends_to_near_segments() {
        let segments = [([[0, 0], [100, 0]], Border::Hard), ([[50, 4], [50, 90]], Border::Soft)];
        assert_eq!(node(&segments, 3.0).pieces.len(), 2);
        let noded = node(&segments, 5.0);
        assert_eq!(noded.pieces.len(), 4, "{noded:?}");
        assert!(noded.points.contains(&[50, 0]));
    }

    #[test]
    fn snap_rounded_segments_meet_only_in_shared_points() {
        for (count, size) in [(60, 400), (120, 1000), (200, 100_000)] {
            let points = random_points(count, size);
            let segments: Vec<([GridPoint; 2], Border)> =
                points.chunks_exact(2).map(|pair| ([pair[0], pair[1]], Border::Soft)).collect();
            assert_meet_only_in_points(&node(&segments, 0.0));
        }
    }
}
