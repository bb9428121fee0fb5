//! Covers: where one triangle, or many that hang together, fill a whole small square of the image, everything behind them there
//! is hidden by them alone.
//!
//! The squares are parts of the tiles. A segment that lies behind the covers of all squares it
//! passes is hidden without a further look; a triangle that lies behind all covers of a tile hides
//! nothing there that is not hidden anyway. In a city of boxes that settles most lines. A line that
//! lies on a triangle is one of its borders, or in contact with it, and so never strictly behind a
//! square that the triangle fills.

use std::sync::atomic::{AtomicUsize, Ordering};

use crate::parallel::prelude::*;
use glam::{DVec2, DVec3};

use super::nearness_bound::{OPEN, Slope, raise, step};
use super::occluder_fusion::Expanses;
use crate::parallel::task_size::GRAIN;
use crate::visibility::occlusion::tiled_triangles::{Triangles, corners};
use crate::visibility::projection::image_segments::ImageSegment;
use crate::visibility::tiles::aligned_grid::squares_per_tile;
use crate::visibility::tiles::tile_grid::Grid;
use crate::visibility::tiles::triangle_columns::Sides;
use crate::visibility::view_tolerances::{Limits, Slack};

/// With fewer layers of surface than this over the page on average, covers hide less than they cost.
const LAYERS: f64 = 3.0;
/// A triangle is big if it is as large as a square of this part of the longer side of the grid.
const BIG_FACE: f64 = 1.0 / 180.0;
/// Big triangles that lie in so many layers over the page on average hide enough for the search for intersections to be worth
/// their covers, by themselves.
const BIG_LAYERS: f64 = 1.0;
/// In a mesh of fewer triangles than this all intersections are found as soon as big ones are covered.
const MANY: usize = 100_000;
/// Covers of the whole page are made by no more tasks than this at a time.
const MOST_SHARES: usize = 8;
/// Triangles, or expanses, that are taken together.
const BLOCK: usize = 32;
/// So many tiles are asked whether they hide a triangle before their squares are.
const MOST_TILES: u32 = 64;

/// The nearness behind which everything is hidden, for squares and for tiles; −∞ where nothing is.
#[derive(Debug, Clone)]
pub struct Covers {
    tiles: Grid,
    squares: Grid,
    /// In single precision, and no nearer than what it stands for.
    of_square: Vec<f32>,
    /// One a tile: the farthest of the covers of its squares.
    pub of_tile: Vec<f64>,
    /// One a tile: the nearest of them.
    nearest: Vec<f32>,
}

impl Covers {
    /// Finds the covers, if they hide more than they cost.
    ///
    /// The result does not depend on the number of threads: the nearest of all covers is taken.
    #[must_use]
    pub fn find(triangles: &Triangles) -> Self {
        if triangles.mean_layers() < LAYERS {
            return Self::none(triangles.grid);
        }
        let squares = squares_of(triangles);
        let expanses = Expanses::new(triangles, squares.cell);
        let is_far = |id: u32| (id as usize) < triangles.mesh.triangles.len() && expanses.is_far_side(id);
        let large = large_ones(triangles, squares.cell, |id| !is_far(id));
        Self::of(triangles, squares, &large, Some(&expanses))
    }

    /// Finds the covers that also spare the search for intersections: those of [`find`](Self::find), and of big triangles
    /// alone where there are fewer layers.
    #[must_use]
    pub fn find_soon(triangles: &Triangles) -> Self {
        if triangles.mean_layers() >= LAYERS {
            return Self::find(triangles);
        }
        if triangles.count() < MANY {
            return Self::none(triangles.grid);
        }
        let squares = squares_of(triangles);
        let tiles = triangles.grid;
        let side = BIG_FACE * tiles.cell * f64::from(tiles.columns.max(tiles.rows));
        let big = large_ones(triangles, squares.cell, |id| triangles.area(id) >= side * side);
        if triangles.layers_of(big.iter().copied()) < BIG_LAYERS {
            return Self::none(triangles.grid);
        }
        Self::of(triangles, squares, &big, None)
    }

    /// The covers of large triangles and of expanses.
    fn of(triangles: &Triangles, squares: Grid, large: &[u32], expanses: Option<&Expanses>) -> Self {
        let per_tile = squares.columns / triangles.grid.columns;
        // Who is free takes the next few of them. Expanses come first, as one may be as large as all the rest.
        let expanse_count = expanses.map_or(0, Expanses::count);
        let (of_expanses, of_large) = (expanse_count.div_ceil(BLOCK), large.len().div_ceil(BLOCK));
        let next = AtomicUsize::new(0);
        let of_share = |_: usize| {
            let (mut cover, mut buffer) = (Vec::new(), Vec::new());
            loop {
                let block = next.fetch_add(1, Ordering::Relaxed);
                if block >= of_expanses + of_large {
                    break;
                }
                cover.resize(squares.len(), OPEN);
                if let Some(expanses) = expanses.filter(|_| block < of_expanses) {
                    for expanse in block * BLOCK..((block + 1) * BLOCK).min(expanse_count) {
                        expanses.add(expanse, triangles, &squares, &mut buffer, &mut cover);
                    }
                    continue;
                }
                for id in large[(block - of_expanses) * BLOCK..].iter().take(BLOCK) {
                    let (points, face) = corners(triangles.mesh, triangles.view, *id);
                    let slack = Slack::of(triangles.mesh.extent(crate::mesh::FaceId(face)));
                    let (frame, limits) = (&triangles.view.frame, triangles.limits);
                    add(&points, &squares, step(&points, limits, &slack, frame), limits, &mut cover);
                }
            }
            (!cover.is_empty()).then_some(cover)
        };
        let shares = rayon_core::current_num_threads().min(MOST_SHARES);
        let mut covers: Vec<Vec<f32>> =
            (0..shares).into_par_iter().with_max_len(1).filter_map(of_share).collect();
        let Some(mut of_square) = covers.pop() else { return Self::none(triangles.grid) };
        // A row of tiles and the rows of squares in it.
        let of_row = |(row, own): (usize, &mut [f32])| {
            let first = row * per_tile as usize * squares.columns as usize;
            for other in &covers {
                let other = &other[first..first + own.len()];
                own.iter_mut().zip(other).for_each(|(own, other)| raise(own, *other));
            }
            let mut spans = vec![[f32::INFINITY, OPEN]; triangles.grid.columns as usize];
            for squares in own.chunks(squares.columns as usize) {
                for ([least, most], squares) in spans.iter_mut().zip(squares.chunks(per_tile as usize)) {
                    for cover in squares {
                        (*least, *most) = (least.min(*cover), most.max(*cover));
                    }
                }
            }
            spans
        };
        let rows = of_square.par_chunks_mut((per_tile * squares.columns) as usize).enumerate();
        let spans: Vec<Vec<[f32; 2]>> = rows.with_min_len(4).with_max_len(8).map(of_row).collect();
        let (of_tile, nearest) =
            spans.iter().flatten().map(|[least, most]| (f64::from(*least), *most)).unzip();
        Self { tiles: *triangles.grid, squares, of_square, of_tile, nearest }
    }

    /// No covers at all: every layer has to be counted.
    #[must_use]
    pub fn none(grid: &Grid) -> Self {
        Self {
            tiles: *grid,
            squares: *grid,
            of_square: Vec::new(),
            of_tile: vec![f64::from(OPEN); grid.len()],
            nearest: vec![OPEN; grid.len()],
        }
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.of_square.is_empty()
    }

    /// Whether a triangle lies behind the covers of all squares that the box around it meets, of which there are at most so many;
    /// also where it meets none.
    #[must_use]
    pub fn hide(&self, points: &[DVec3; 3], most: u32) -> bool {
        let [a, b, c] = points;
        let (low, high) = (a.min(*b).min(*c), a.max(*b).max(*c));
        // Mostly tiles tell.
        let tiles = self.tiles.tile_box(low, high);
        let mut tells_all = tiles.area() <= MOST_TILES;
        for (tile, _) in self.tiles.tiles_of(tiles).take(MOST_TILES as usize) {
            if high.z >= f64::from(self.nearest[tile]) {
                return false;
            }
            tells_all &= high.z < self.of_tile[tile];
        }
        let squares = self.squares.tile_box(low, high);
        if tells_all && squares.area() <= most {
            return true;
        }
        let is_behind = |(square, _): (usize, DVec2)| high.z < f64::from(self.of_square[square]);
        squares.area() <= most && (squares.is_empty() || self.squares.tiles_of(squares).all(is_behind))
    }

    /// Whether the part of a segment between two parameters, which lies in a tile, lies behind the covers of all squares it passes.
    #[must_use]
    pub fn bury(&self, segment: &ImageSegment, tile: usize, start: f64, end: f64) -> bool {
        if self.of_square.is_empty() {
            return false;
        }
        let (a, b) = (segment.at(start), segment.at(end));
        // Mostly the tile tells.
        if a.z.max(b.z) < self.of_tile[tile] {
            return true;
        }
        if a.z.min(b.z) >= f64::from(self.nearest[tile]) {
            return false;
        }
        let mut buried = true;
        self.squares.walk(a, b, |square, t0, t1| {
            let nearest = (a.z + (b.z - a.z) * t0).max(a.z + (b.z - a.z) * t1);
            buried &= nearest < f64::from(self.of_square[square]);
        });
        buried
    }
}

fn squares_of(triangles: &Triangles) -> Grid {
    triangles.grid.refined(squares_per_tile(triangles.mesh.triangles.len()))
}

fn large_ones(triangles: &Triangles, cell: f64, holds: impl Fn(u32) -> bool + Sync) -> Vec<u32> {
    (0..triangles.count() as u32)
        .into_par_iter()
        .with_min_len(GRAIN)
        .filter(|id| is_large(triangles, *id, cell) && holds(*id))
        .collect()
}

/// Whether a triangle is large enough in the image to fill a square, and whole.
#[inline]
fn is_large(triangles: &Triangles, id: u32, cell: f64) -> bool {
    let (p, face) = corners(triangles.mesh, triangles.view, id);
    let low = p[0].min(p[1]).min(p[2]);
    let high = p[0].max(p[1]).max(p[2]);
    // NaN, where the near plane cuts the triangle, is no number of cells.
    let extent = high - low;
    extent.x >= cell
        && extent.y >= cell
        && !(p[0].z.is_nan() || p[1].z.is_nan() || p[2].z.is_nan())
        && !triangles.mesh.is_degenerate(crate::mesh::FaceId(face))
}

/// Raises the cover of the squares that a triangle fills; everything that it hides is farther by `step`.
pub(crate) fn add(points: &[DVec3; 3], squares: &Grid, step: f64, limits: &Limits, cover: &mut [f32]) {
    let low = points[0].min(points[1]).min(points[2]);
    let high = points[0].max(points[1]).max(points[2]);
    if high.x - low.x < squares.cell || high.y - low.y < squares.cell {
        return;
    }
    let (u, v) = (points[1] - points[0], points[2] - points[0]);
    let area = u.truncate().perp_dot(v.truncate());
    let longest = u.truncate().length_squared().max(v.truncate().length_squared());
    let longest = longest.max((v - u).truncate().length_squared());
    // What fits into a triangle is nowhere wider than the triangle is high: most slivers hold no square.
    if area * area <= longest * squares.cell.max(limits.height).powi(2) {
        return;
    }
    let sides = Sides::new(points);
    let half = squares.cell / 2.0;
    let slope = Slope::new(points, half, step, limits);
    let tiles = squares.tile_box(low, high);
    if tiles.is_empty() {
        return;
    }
    for row in tiles.top..=tiles.bottom {
        let columns = sides.columns(squares, tiles, row, -half);
        if columns.is_empty() {
            continue;
        }
        let first = squares.tile(columns.start, u32::from(row));
        let centre = squares.corner(columns.start, u32::from(row)) + half;
        let own = &mut cover[first..first + columns.len()];
        own.iter_mut()
            .zip(slope.over(centre, squares.cell, columns.len()))
            .for_each(|(own, least)| raise(own, least));
    }
}
