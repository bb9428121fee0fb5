//! [`OcclusionBuffer`]: an occlusion buffer over small squares of the image, in two levels like a hierarchical
//! Z-buffer.
//!
//! 1. A triangle, or a group of fused faces, that fills a whole square hides everything behind it there.
//! 2. Each square stores a nearness limit: everything farther is hidden. Each tile stores the range of its
//!    squares.
//! 3. A segment behind the values of all squares it passes is hidden. A triangle behind all values of a tile
//!    is skipped there.
//!
//! A line on a triangle lies on its border or touches it, so it is never strictly behind a square that this
//! triangle fills.

use std::sync::atomic::{AtomicUsize, Ordering};

use crate::parallel::prelude::*;
use glam::{DVec2, DVec3};

use super::nearness_bound::{NearnessBound, UNCOVERED, raise, step};
use super::occluder_fusion::FusedOccluders;
use crate::parallel::task_size::MIN_TASK_ITEMS;
use crate::visibility::occlusion::tiled_triangles::{TiledTriangles, corners};
use crate::visibility::projection::image_segments::ImageSegment;
use crate::visibility::tiles::aligned_grid::squares_per_tile;
use crate::visibility::tiles::tile_grid::TileGrid;
use crate::visibility::tiles::triangle_columns::TriangleHalfPlanes;
use crate::visibility::view_tolerances::{FaceTolerances, ViewTolerances};

/// Mean number of surface layers over the page above which the buffer saves more than it costs.
const MIN_MEAN_LAYERS: f64 = 3.0;
/// A triangle is big if its area reaches that of a square with this side, as a share of the grid's longer
/// side.
const MIN_BIG_FACE_SIDE_SHARE: f64 = 1.0 / 180.0;
/// Mean number of layers of big triangles that justifies the buffer for the search for intersections alone.
const MIN_BIG_FACE_LAYERS: f64 = 1.0;
/// Lowest number of triangles for an early buffer. In smaller meshes, finding all intersections costs no
/// more.
const MIN_TRIANGLES: usize = 100_000;
/// Largest number of tasks that fill buffers of the whole page at the same time.
const MAX_TASKS: usize = 8;
/// Triangles or fused occluders per block of work.
const OCCLUDERS_PER_BLOCK: usize = 32;
/// Largest number of tiles tested for a triangle before its squares are.
const MAX_TILES_TESTED: u32 = 64;

/// Nearness limits per square and per tile: everything farther is hidden. −∞ where nothing is hidden.
#[derive(Debug, Clone)]
pub(crate) struct OcclusionBuffer {
    tiles: TileGrid,
    squares: TileGrid,
    /// One per square, row by row. In single precision, never nearer than the exact value.
    square_nearness: Vec<f32>,
    /// Farthest value of the squares of each tile.
    pub tile_nearness: Vec<f64>,
    /// Nearest value of the squares of each tile.
    nearest: Vec<f32>,
}

impl OcclusionBuffer {
    /// Fills the buffer, if it is likely to save more than it costs.
    ///
    /// The result does not depend on the number of threads, because each square keeps the nearest value.
    #[must_use]
    pub(crate) fn find(triangles: &TiledTriangles) -> Self {
        if triangles.mean_layers() < MIN_MEAN_LAYERS {
            return Self::none(triangles.grid);
        }
        let squares = squares_of(triangles);
        let expanses = FusedOccluders::new(triangles, squares.cell);
        let large = large_ones(triangles, squares.cell, |_| true);
        Self::of(triangles, squares, &large, Some(&expanses))
    }

    /// Fills the buffer before the lines are known, which also saves work in the search for intersections.
    ///
    /// Equals [`find`](Self::find) where there are enough layers. With fewer layers, only big triangles are
    /// used.
    #[must_use]
    pub(crate) fn find_before_lines(triangles: &TiledTriangles) -> Self {
        if triangles.mean_layers() >= MIN_MEAN_LAYERS {
            return Self::find(triangles);
        }
        if triangles.count() < MIN_TRIANGLES {
            return Self::none(triangles.grid);
        }
        let squares = squares_of(triangles);
        let tiles = triangles.grid;
        let side = MIN_BIG_FACE_SIDE_SHARE * tiles.cell * f64::from(tiles.columns.max(tiles.rows));
        let big = large_ones(triangles, squares.cell, |id| triangles.area(id) >= side * side);
        if triangles.layers_of(big.iter().copied()) < MIN_BIG_FACE_LAYERS {
            return Self::none(triangles.grid);
        }
        Self::of(triangles, squares, &big, None)
    }

    /// Fills the buffer with large triangles and fused occluders.
    fn of(
        triangles: &TiledTriangles,
        squares: TileGrid,
        large: &[u32],
        expanses: Option<&FusedOccluders>,
    ) -> Self {
        let per_tile = squares.columns / triangles.grid.columns;
        // Free threads take the next block. Fused occluders come first, because one may be as large as all
        // the rest.
        let expanse_count = expanses.map_or(0, FusedOccluders::count);
        let (of_expanses, of_large) =
            (expanse_count.div_ceil(OCCLUDERS_PER_BLOCK), large.len().div_ceil(OCCLUDERS_PER_BLOCK));
        let next = AtomicUsize::new(0);
        let of_share = |_: usize| {
            let (mut cover, mut buffer) = (Vec::new(), Vec::new());
            loop {
                let block = next.fetch_add(1, Ordering::Relaxed);
                if block >= of_expanses + of_large {
                    break;
                }
                cover.resize(squares.len(), UNCOVERED);
                if let Some(expanses) = expanses.filter(|_| block < of_expanses) {
                    for expanse in
                        block * OCCLUDERS_PER_BLOCK..((block + 1) * OCCLUDERS_PER_BLOCK).min(expanse_count)
                    {
                        expanses.add(expanse, triangles, &squares, &mut buffer, &mut cover);
                    }
                    continue;
                }
                for id in
                    large[(block - of_expanses) * OCCLUDERS_PER_BLOCK..].iter().take(OCCLUDERS_PER_BLOCK)
                {
                    let (points, face) = corners(triangles.mesh, triangles.view, *id);
                    let slack = FaceTolerances::of(triangles.mesh.extent(crate::mesh::FaceId(face)));
                    let (frame, limits) = (&triangles.view.frame, triangles.limits);
                    add(&points, &squares, step(&points, limits, &slack, frame), limits, &mut cover);
                }
            }
            (!cover.is_empty()).then_some(cover)
        };
        let shares = rayon_core::current_num_threads().min(MAX_TASKS);
        let mut covers: Vec<Vec<f32>> =
            (0..shares).into_par_iter().with_max_len(1).filter_map(of_share).collect();
        let Some(mut of_square) = covers.pop() else { return Self::none(triangles.grid) };
        // One row of tiles with its rows of squares.
        let of_row = |(row, row_cover): (usize, &mut [f32])| {
            let first = row * per_tile as usize * squares.columns as usize;
            for layer in &covers {
                let layer_row = &layer[first..first + row_cover.len()];
                row_cover.iter_mut().zip(layer_row).for_each(|(own, other)| raise(own, *other));
            }
            let mut spans = vec![[f32::INFINITY, UNCOVERED]; triangles.grid.columns as usize];
            for squares in row_cover.chunks(squares.columns as usize) {
                for ([lowest, highest], squares) in spans.iter_mut().zip(squares.chunks(per_tile as usize)) {
                    for cover in squares {
                        (*lowest, *highest) = (lowest.min(*cover), highest.max(*cover));
                    }
                }
            }
            spans
        };
        let rows = of_square.par_chunks_mut((per_tile * squares.columns) as usize).enumerate();
        let spans: Vec<Vec<[f32; 2]>> = rows.with_min_len(4).with_max_len(8).map(of_row).collect();
        let (of_tile, nearest) =
            spans.iter().flatten().map(|[least, most]| (f64::from(*least), *most)).unzip();
        Self { tiles: *triangles.grid, squares, square_nearness: of_square, tile_nearness: of_tile, nearest }
    }

    /// Empty buffer, which hides nothing. Used where all layers must be counted.
    #[must_use]
    pub(crate) fn none(grid: &TileGrid) -> Self {
        Self {
            tiles: *grid,
            squares: *grid,
            square_nearness: Vec::new(),
            tile_nearness: vec![f64::from(UNCOVERED); grid.len()],
            nearest: vec![UNCOVERED; grid.len()],
        }
    }

    /// Whether the buffer is empty.
    #[must_use]
    pub(crate) fn is_empty(&self) -> bool {
        self.square_nearness.is_empty()
    }

    /// Whether a triangle is behind the buffer in every square that its bounding box meets.
    ///
    /// False if the box meets more than `max_squares` squares; true if it meets none.
    #[must_use]
    pub(crate) fn hides_triangle(&self, points: &[DVec3; 3], max_squares: u32) -> bool {
        let [a, b, c] = points;
        let (low, high) = (a.min(*b).min(*c), a.max(*b).max(*c));
        // The tiles settle most cases.
        let tiles = self.tiles.tile_box(low, high);
        let mut tells_all = tiles.area() <= MAX_TILES_TESTED;
        for (tile, _) in self.tiles.tiles_of(tiles).take(MAX_TILES_TESTED as usize) {
            if high.z >= f64::from(self.nearest[tile]) {
                return false;
            }
            tells_all &= high.z < self.tile_nearness[tile];
        }
        let squares = self.squares.tile_box(low, high);
        if tells_all && squares.area() <= max_squares {
            return true;
        }
        let is_behind = |(square, _): (usize, DVec2)| high.z < f64::from(self.square_nearness[square]);
        squares.area() <= max_squares && (squares.is_empty() || self.squares.tiles_of(squares).all(is_behind))
    }

    /// Whether a part of a segment inside one tile is behind the buffer in all squares it passes.
    #[must_use]
    pub(crate) fn hides_segment_part(
        &self,
        segment: &ImageSegment,
        tile: usize,
        start: f64,
        end: f64,
    ) -> bool {
        if self.square_nearness.is_empty() {
            return false;
        }
        let (a, b) = (segment.at(start), segment.at(end));
        // The tile settles most cases.
        if a.z.max(b.z) < self.tile_nearness[tile] {
            return true;
        }
        if a.z.min(b.z) >= f64::from(self.nearest[tile]) {
            return false;
        }
        let mut buried = true;
        self.squares.walk(a, b, |square, t0, t1| {
            let nearest = (a.z + (b.z - a.z) * t0).max(a.z + (b.z - a.z) * t1);
            buried &= nearest < f64::from(self.square_nearness[square]);
        });
        buried
    }
}

fn squares_of(triangles: &TiledTriangles) -> TileGrid {
    triangles.grid.refined(squares_per_tile(triangles.mesh.triangles.len()))
}

fn large_ones(triangles: &TiledTriangles, cell: f64, holds: impl Fn(u32) -> bool + Sync) -> Vec<u32> {
    (0..triangles.count() as u32)
        .into_par_iter()
        .with_min_len(MIN_TASK_ITEMS)
        .filter(|id| is_large(triangles, *id, cell) && holds(*id))
        .collect()
}

/// Whether a triangle is large enough in the image to fill a square, and not cut by the near plane.
#[inline]
fn is_large(triangles: &TiledTriangles, id: u32, cell: f64) -> bool {
    let (p, face) = corners(triangles.mesh, triangles.view, id);
    let low = p[0].min(p[1]).min(p[2]);
    let high = p[0].max(p[1]).max(p[2]);
    // With NaN, where the near plane cuts the triangle, the comparisons are false.
    let extent = high - low;
    extent.x >= cell
        && extent.y >= cell
        && !(p[0].z.is_nan() || p[1].z.is_nan() || p[2].z.is_nan())
        && !triangles.mesh.is_degenerate(crate::mesh::FaceId(face))
}

/// Raises the value of each square that a triangle fills to the triangle's nearness there, less `step`.
pub(crate) fn add(
    points: &[DVec3; 3],
    squares: &TileGrid,
    step: f64,
    limits: &ViewTolerances,
    cover: &mut [f32],
) {
    let low = points[0].min(points[1]).min(points[2]);
    let high = points[0].max(points[1]).max(points[2]);
    if high.x - low.x < squares.cell || high.y - low.y < squares.cell {
        return;
    }
    let (u, v) = (points[1] - points[0], points[2] - points[0]);
    let area = u.truncate().perp_dot(v.truncate());
    let longest = u.truncate().length_squared().max(v.truncate().length_squared());
    let longest = longest.max((v - u).truncate().length_squared());
    // A square inside a triangle is no wider than the triangle's height, so most slivers are skipped.
    if area * area <= longest * squares.cell.max(limits.height).powi(2) {
        return;
    }
    let sides = TriangleHalfPlanes::new(points);
    let half = squares.cell / 2.0;
    let slope = NearnessBound::new(points, half, step, limits);
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
