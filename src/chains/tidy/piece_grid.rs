//! [`PieceGrid`]: straight pieces of lines in a grid over the page, and the test for parallel pieces nearby.

use crate::parallel::prelude::*;
use kurbo::{Point, Rect, Vec2};

use crate::chains::sampled_line::SampledLine;
use crate::geometry::lists::csr_lists::{CsrLists, csr_lists_from_pairs};
use crate::geometry::plane::planar_distance::{length, segment_distance_squared, unit};
use crate::geometry::plane::planar_grid::PlanarGrid;
use crate::geometry::plane::polylines::bounds;

/// Cosine of the largest angle (35 degrees) between parallel lines.
const MIN_PARALLEL_COSINE: f64 = 0.82;

/// Window for the direction of a jagged line, in double distances.
const DIRECTION_WINDOW_DISTANCES: f64 = 4.0;

/// Largest lengthwise offset between parallel lines, as a share of the distance.
const MAX_OVERHANG_RATIO: f64 = 0.3;

/// Pieces per task.
const PIECES_PER_TASK: usize = 1 << 10;

/// Maximum number of grid cells per piece.
const MAX_CELLS_PER_PIECE: usize = 8;

/// Straight piece of a visible line, with its smoothed direction.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LinePiece {
    pub(crate) line: u32,
    pub(crate) a: Point,
    pub(crate) b: Point,
    pub(crate) direction: Vec2,
}

/// Pieces of lines by square cells of the page.
pub(crate) struct PieceGrid {
    grid: PlanarGrid,
    pieces: CsrLists<u32>,
}

/// Pieces of a line, each with its direction over a few distances.
pub(crate) fn collect(index: u32, line: &SampledLine, distance: f64) -> Vec<LinePiece> {
    let n = line.len();
    let sides = if line.closed { n } else { n - 1 };
    let mut pieces = Vec::with_capacity(sides);
    let reach = DIRECTION_WINDOW_DISTANCES * distance / 2.0;
    for k in 0..sides {
        let (a, b) = (line.points[k], line.points[(k + 1) % n]);
        let mut low = k;
        while low > 0 && length(line.points[low] - a) < reach {
            low -= 1;
        }
        let mut high = k + 1;
        while high < sides && length(line.points[high % n] - b) < reach {
            high += 1;
        }
        let direction = unit(line.points[high % n] - line.points[low]);
        pieces.push(LinePiece { line: index, a, b, direction });
    }
    pieces
}

impl PieceGrid {
    pub(crate) fn new(pieces: &[LinePiece], cell: f64) -> Option<Self> {
        let bounds = bounds(pieces.iter().flat_map(|p| [p.a, p.b]))?;
        // At most a million cells on giant pages, and few cells for few pieces.
        let (width, height) = (bounds.width(), bounds.height());
        let of_piece = (width * height / (MAX_CELLS_PER_PIECE * pieces.len()) as f64).sqrt();
        let cell = cell.max(width / 1000.0).max(height / 1000.0).max(of_piece);
        if !cell.is_finite() || cell <= 0.0 {
            return None;
        }
        let grid = PlanarGrid::new(bounds, 1.0 / cell);
        let cells_of = |(chunk, some): (usize, &[LinePiece])| {
            let mut found = Vec::with_capacity(2 * some.len());
            for (i, piece) in (chunk * PIECES_PER_TASK..).zip(some) {
                grid.visit_passed(piece.a, piece.b, |cell| found.push((cell, i as u32)));
            }
            found
        };
        let found: Vec<Vec<(usize, u32)>> =
            pieces.par_chunks(PIECES_PER_TASK).enumerate().with_max_len(1).map(cells_of).collect();
        let pieces = csr_lists_from_pairs(grid.count(), found.iter().flatten().copied());
        Some(Self { grid, pieces })
    }

    /// Whether a parallel piece of an admitted line lies within `distance` of `point`.
    pub(crate) fn has_parallel_near(
        &self,
        pieces: &[LinePiece],
        point: Point,
        direction: Vec2,
        distance: f64,
        admit: impl Fn(u32) -> bool,
    ) -> bool {
        let around = Rect::from_points(point, point).inflate(distance, distance);
        let near = self.grid.rows_in(around).flat_map(|cells| self.pieces.of_all(cells));
        near.map(|i| &pieces[*i as usize]).any(|other| {
            other.direction.dot(direction).abs() >= MIN_PARALLEL_COSINE
                && other.is_abreast(point, MAX_OVERHANG_RATIO * distance)
                && admit(other.line)
                && segment_distance_squared(point, other.a, other.b) <= distance * distance
        })
    }
}

impl LinePiece {
    /// Whether the projection of a point falls on the piece, within `slack`.
    fn is_abreast(&self, point: Point, slack: f64) -> bool {
        let side = self.b - self.a;
        let along = (point - self.a).dot(side);
        let slack = slack * length(side);
        (-slack..=side.hypot2() + slack).contains(&along)
    }
}
