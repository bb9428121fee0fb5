//! [`Ground`]: the page as hatching is laid on it: what is seen where, and where strokes end.
//!
//! Borders are those of the triangulation itself, exact to a hundredth of a px; they are not smoothed
//! again, and need no polygons: a stroke is cut where it crosses a piece of border, and the piece knows
//! what lies on its two sides.

use std::collections::BTreeMap;

use kurbo::{Point, Vec2};

use super::cells::{OUTSIDE, Triangulation};
use super::merge;
use super::seen::{Look, NOTHING, Seen};
use crate::drawing::{Length, Unit};

/// A part of the page that looks alike to hatching and hangs together.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cell {
    /// What is seen; tones of fills do not count, and are 0. Of no meaning in cell 0, which is paper.
    pub look: Look,
    /// The stretch of visible surface that it is part of: cells of one facet are parted by borders of
    /// light and shade only. 0 for paper.
    pub facet: u32,
    /// Its area, user units squared.
    pub area: f64,
}

/// A straight piece of border.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piece {
    /// Its ends.
    pub ends: [Point; 2],
    /// The cells on both sides: first that to the right of its way as the page is seen (y down).
    pub sides: [u32; 2],
    /// Whether it parts two surfaces, not only light from shade; strokes end there.
    pub parts_surfaces: bool,
}

/// What is seen where, and the borders between.
#[derive(Debug, Clone, Default)]
pub struct Ground {
    /// The cells; the first is paper.
    pub cells: Vec<Cell>,
    /// The borders: where the cells on both sides differ, or surfaces part.
    pub pieces: Vec<Piece>,
    /// Number of facets; facet 0 is paper.
    pub facets: u32,
    grid: Grid,
}

/// The cell of paper.
pub const PAPER: u32 = 0;

impl Ground {
    /// The ground of a page that is seen, moved on the page by `offset`. Cells of less area than a square
    /// of side `crumb` go to a neighbour.
    #[must_use]
    pub fn new(seen: &Seen, crumb: Length, unit: Unit, offset: Vec2) -> Self {
        let cut = &seen.cut;
        // Cast shadows are dark enough to be hatched as they are, and colours do not matter.
        let (looks, table) = seen.seen_as(|look| Look { tone: 0, cast: false, ..*look });
        let part = |triangle: usize| {
            looks[triangle]
                .checked_sub(1)
                .and_then(|k| table.get(k as usize))
                .map(|look| (look.part, look.material))
        };
        let (facet_of, _) = cut.flooded(|triangle, side, next| {
            cut.borders[triangle][side].is_none_or(|border| border.is_tone()) && part(triangle) == part(next)
        });
        let mut numbers: BTreeMap<(u32, u32), u32> = BTreeMap::new();
        let mut keys: Vec<(u32, u32)> = vec![(NOTHING, 0)];
        let keyed: Vec<u32> = (0..looks.len())
            .map(|t| {
                if looks[t] == NOTHING {
                    return NOTHING;
                }
                *numbers.entry((looks[t], facet_of[t])).or_insert_with(|| {
                    keys.push((looks[t], facet_of[t]));
                    keys.len() as u32 - 1
                })
            })
            .collect();
        let crumb = crumb.in_unit(unit).max(0.0) / seen.step;
        let patches = merge::gather(cut, &keyed, NOTHING, 2.0 * crumb * crumb);

        let mut ground = Self { cells: vec![paper()], facets: 1, ..Self::default() };
        let mut cell_of: Vec<Option<u32>> = vec![None; patches.looks.len()];
        let mut facets: BTreeMap<u32, u32> = BTreeMap::new();
        for patch in &patches.of {
            let (look, facet) = keys[patches.looks[*patch as usize] as usize];
            let cell = &mut cell_of[*patch as usize];
            if cell.is_some() {
                continue;
            }
            let seen_look = look.checked_sub(1).and_then(|k| table.get(k as usize));
            let Some(look) = seen_look else {
                *cell = Some(PAPER);
                continue;
            };
            let next = ground.facets;
            let facet = *facets.entry(facet).or_insert(next);
            ground.facets = next.max(facet + 1);
            *cell = Some(ground.cells.len() as u32);
            let area = patches.area2[*patch as usize] / 2.0 * seen.step * seen.step;
            ground.cells.push(Cell { look: *look, facet, area });
        }
        let of = |triangle: usize| cell_of[patches.of[triangle] as usize].unwrap_or(PAPER);
        ground.add_pieces(cut, of, |v: u32| {
            let [x, y] = cut.points[v as usize];
            Point::new(x as f64 * seen.step, y as f64 * seen.step) + offset
        });
        ground.grid = Grid::new(&ground.pieces);
        ground
    }

    /// A ground of given cells and pieces, for tests and for pages without a model; the first cell is
    /// paper.
    #[must_use]
    pub fn of_pieces(cells: Vec<Cell>, pieces: Vec<Piece>) -> Self {
        let facets = cells.iter().map(|cell| cell.facet + 1).max().unwrap_or(1);
        let grid = Grid::new(&pieces);
        Self { cells, pieces, facets, grid }
    }

    fn add_pieces(&mut self, cut: &Triangulation, cell: impl Fn(usize) -> u32, point: impl Fn(u32) -> Point) {
        for (triangle, corners) in cut.triangles.iter().enumerate() {
            for side in 0..3 {
                let next = cut.neighbours[triangle][side];
                // Each side once: by the lesser of its triangles.
                if next != OUTSIDE && (next as usize) < triangle {
                    continue;
                }
                let own = cell(triangle);
                let other = if next == OUTSIDE { PAPER } else { cell(next as usize) };
                let parts = cut.borders[triangle][side].is_some_and(|border| !border.is_tone());
                if own == other && (!parts || own == PAPER) {
                    continue;
                }
                let facet = |cell: u32| self.cells[cell as usize].facet;
                let parts_surfaces = parts || facet(own) != facet(other);
                let ends = [corners[side], corners[(side + 1) % 3]].map(&point);
                // Triangles turn from x to y: their inside is to the right as the page is seen.
                self.pieces.push(Piece { ends, sides: [own, other], parts_surfaces });
            }
        }
    }

    /// The cell at a point.
    #[must_use]
    pub fn cell_at(&self, p: Point) -> u32 {
        self.grid.cell_at(&self.pieces, p)
    }

    /// The cells at the points of a lattice, row by row from its first point.
    #[must_use]
    pub fn raster(&self, first: Point, pitch: f64, columns: usize, rows: usize) -> Vec<u32> {
        let mut meets: Vec<Vec<(f64, u32)>> = vec![Vec::new(); rows];
        for piece in &self.pieces {
            let [a, b] = piece.ends;
            // Of the cells on both sides that which lies to the right on the page.
            let cell = piece.sides[usize::from(b.y > a.y)];
            let (top, bottom) = (a.y.min(b.y), a.y.max(b.y));
            let row = |y: f64| ((y - first.y) / pitch).ceil().max(0.0) as usize;
            for (k, meets) in meets.iter_mut().enumerate().take(row(bottom)).skip(row(top)) {
                let y = first.y + k as f64 * pitch;
                meets.push((a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)), cell));
            }
        }
        let mut cells = vec![PAPER; columns * rows];
        for (meets, cells) in meets.iter_mut().zip(cells.chunks_exact_mut(columns.max(1))) {
            meets.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            let mut next = meets.iter().peekable();
            let mut cell = PAPER;
            for (k, own) in cells.iter_mut().enumerate() {
                let x = first.x + k as f64 * pitch;
                while let Some((_, beyond)) = next.next_if(|(at, _)| *at <= x) {
                    cell = *beyond;
                }
                *own = cell;
            }
        }
        cells
    }

    /// The numbers of the pieces within `reach` of a point and some beyond it, ascending.
    #[must_use]
    pub fn pieces_near(&self, p: Point, reach: f64) -> Vec<u32> {
        self.grid.near(p - Vec2::new(reach, reach), p + Vec2::new(reach, reach))
    }

    /// Where a segment crosses pieces, in order: the part of the way, and the piece's number, and whether it
    /// is crossed from its first side to its second.
    pub(crate) fn crossings(&self, from: Point, to: Point, out: &mut Vec<(f64, u32, bool)>) {
        let first = out.len();
        self.grid.visit(from, to, |number| {
            if let Some((t, along)) = crossing(&self.pieces[number as usize], from, to) {
                out.push((t, number, along));
            }
        });
        out[first..].sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut last = None;
        let mut kept = first;
        for k in first..out.len() {
            if last != Some(out[k].1) {
                last = Some(out[k].1);
                out[kept] = out[k];
                kept += 1;
            }
        }
        out.truncate(kept);
    }
}

const fn paper() -> Cell {
    use crate::mesh::{MaterialId, PaintId, PartId};
    let look =
        Look { part: PartId(0), material: MaterialId(0), paint: PaintId(0), tone: 0, bin: 0, cast: false };
    Cell { look, facet: 0, area: 0.0 }
}

/// On which side of the way from `a` to `b` a point lies: true for the right as the page is seen, and for
/// points on it.
fn is_right(a: Point, b: Point, p: Point) -> bool {
    (b - a).cross(p - a) >= 0.0
}

/// Where a segment crosses a piece, and whether from its first side to its second.
fn crossing(piece: &Piece, from: Point, to: Point) -> Option<(f64, bool)> {
    let [a, b] = piece.ends;
    let (side_a, side_b) = (is_right(from, to, a), is_right(from, to, b));
    if side_a == side_b {
        return None;
    }
    let (off_from, off_to) = ((b - a).cross(from - a), (b - a).cross(to - a));
    // The first point of a segment counts to it, its last to the next one.
    if (off_from >= 0.0) == (off_to >= 0.0) {
        return None;
    }
    Some(((off_from / (off_from - off_to)).clamp(0.0, 1.0), off_from >= 0.0))
}

/// Pieces by the tiles of the page that they pass.
#[derive(Debug, Clone, Default)]
struct Grid {
    low: Vec2,
    tiles_per_unit: f64,
    across: [usize; 2],
    starts: Vec<u32>,
    pieces: Vec<u32>,
}

/// Pieces in a tile, on average.
const PIECES_A_TILE: usize = 2;

/// Most tiles across.
const MOST_TILES: f64 = 256.0;

impl Grid {
    fn new(pieces: &[Piece]) -> Self {
        let ends = || pieces.iter().flat_map(|piece| piece.ends);
        let Some(first) = ends().next() else { return Self::default() };
        let (low, high) = ends().fold((first, first), |(low, high), p| {
            (Point::new(low.x.min(p.x), low.y.min(p.y)), Point::new(high.x.max(p.x), high.y.max(p.y)))
        });
        let size = high - low;
        let wanted = ((pieces.len() / PIECES_A_TILE).max(1) as f64).sqrt().clamp(1.0, MOST_TILES);
        let tiles_per_unit = wanted / size.x.max(size.y).max(f64::MIN_POSITIVE);
        let across = [size.x, size.y].map(|length| (length * tiles_per_unit) as usize + 1);
        let mut grid = Self { low: low.to_vec2(), tiles_per_unit, across, ..Self::default() };
        let mut starts = vec![0u32; across[0] * across[1] + 1];
        for piece in pieces {
            grid.pass(piece.ends[0], piece.ends[1], |tile| starts[tile + 1] += 1);
        }
        for k in 1..starts.len() {
            starts[k] += starts[k - 1];
        }
        let mut next = starts.clone();
        let mut sorted = vec![0u32; starts.last().copied().unwrap_or_default() as usize];
        for (number, piece) in pieces.iter().enumerate() {
            grid.pass(piece.ends[0], piece.ends[1], |tile| {
                sorted[next[tile] as usize] = number as u32;
                next[tile] += 1;
            });
        }
        grid.starts = starts;
        grid.pieces = sorted;
        grid
    }

    /// Calls for each tile that a segment passes; those outside of the grid are left out.
    fn pass(&self, from: Point, to: Point, mut call: impl FnMut(usize)) {
        let at = |p: Point| (p.to_vec2() - self.low) * self.tiles_per_unit;
        let (mut a, mut b) = (at(from), at(to));
        if a.y > b.y {
            std::mem::swap(&mut a, &mut b);
        }
        let [columns, rows] = self.across;
        if columns == 0 || b.y < 0.0 || a.y >= rows as f64 {
            return;
        }
        let way = b - a;
        let (first, last) = (a.y.max(0.0) as usize, (b.y.max(0.0) as usize).min(rows - 1));
        for row in first..=last {
            // The stretch of the segment in this row, a little widened against rounding.
            let x_at =
                |y: f64| if way.y > 0.0 { a.x + way.x * ((y - a.y) / way.y).clamp(0.0, 1.0) } else { a.x };
            let (x0, x1) = if way.y > 0.0 { (x_at(row as f64), x_at(row as f64 + 1.0)) } else { (a.x, b.x) };
            let (x0, x1) = (x0.min(x1) - WIDENED, x0.max(x1) + WIDENED);
            if x1 < 0.0 || x0 >= columns as f64 {
                continue;
            }
            for column in x0.max(0.0) as usize..=(x1 as usize).min(columns - 1) {
                call(row * columns + column);
            }
        }
    }

    /// Calls for the pieces in the tiles that a segment passes, for some more than once.
    fn visit(&self, from: Point, to: Point, mut call: impl FnMut(u32)) {
        self.pass(from, to, |tile| {
            let own = self.starts[tile] as usize..self.starts[tile + 1] as usize;
            self.pieces[own].iter().for_each(|number| call(*number));
        });
    }

    /// Pieces in the tiles that a box touches, ascending.
    fn near(&self, low: Point, high: Point) -> Vec<u32> {
        let at = |p: Point| (p.to_vec2() - self.low) * self.tiles_per_unit;
        let (low, high) = (at(low), at(high));
        let mut found = Vec::new();
        let [columns, rows] = self.across;
        if columns == 0 || high.x < 0.0 || high.y < 0.0 {
            return found;
        }
        for row in low.y.max(0.0) as usize..=(high.y as usize).min(rows - 1) {
            for column in low.x.max(0.0) as usize..=(high.x as usize).min(columns - 1) {
                let tile = row * columns + column;
                found.extend_from_slice(
                    &self.pieces[self.starts[tile] as usize..self.starts[tile + 1] as usize],
                );
            }
        }
        found.sort_unstable();
        found.dedup();
        found
    }

    /// The cell at a point: what the next piece to its left has on this side.
    fn cell_at(&self, pieces: &[Piece], p: Point) -> u32 {
        let at = (p.to_vec2() - self.low) * self.tiles_per_unit;
        let [columns, rows] = self.across;
        if columns == 0 || at.x < 0.0 || at.y < 0.0 || at.y >= rows as f64 {
            return PAPER;
        }
        let row = at.y as usize;
        for column in (0..=(at.x as usize).min(columns - 1)).rev() {
            let tile = row * columns + column;
            let mut nearest: Option<(f64, u32)> = None;
            for number in &self.pieces[self.starts[tile] as usize..self.starts[tile + 1] as usize] {
                let piece = &pieces[*number as usize];
                let [a, b] = piece.ends;
                if (a.y > p.y) == (b.y > p.y) {
                    continue;
                }
                let x = a.x + (b.x - a.x) * ((p.y - a.y) / (b.y - a.y));
                // One that crosses this height farther left is met again there.
                let here = (x - self.low.x) * self.tiles_per_unit >= column as f64 - WIDENED;
                if here && x <= p.x && nearest.is_none_or(|(most, _)| x > most) {
                    // A piece that runs down the page has the point on its left.
                    nearest = Some((x, piece.sides[usize::from(b.y > a.y)]));
                }
            }
            if let Some((_, cell)) = nearest {
                return cell;
            }
        }
        PAPER
    }
}

/// Tiles are widened by this part of themselves against rounding.
const WIDENED: f64 = 1e-6;
