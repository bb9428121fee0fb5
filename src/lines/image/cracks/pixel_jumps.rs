//! [`PixelJumps`]: differences of depth and normals between neighbouring pixels.
//!
//! Edges of an image lie between pixels. Among neighbouring pairs, the one with the largest jump locates the
//! edge.

use std::ops::Range;

use super::crest_test::MIN_INDEPENDENT_JUMP;
use super::jump_tiles::JumpTiles;
use crate::lines::image::{EdgeTest, ImageOptions};
use crate::mesh::Mesh;
use crate::view::raster::{NO_FRONT, NormalDepthMaps};

/// Jumps of depth and normals that the opposite test takes for an edge. For depth this is half a step of its
/// hardware; for normals it is 29 degrees, halfway into the picture. Only the ratio of the two matters.
const OPPOSITE_TEST_JUMPS: [f32; 2] = [0.0442, 0.33];

/// Jump over a straight edge for which the gradient test has p = 0.75, in units of its k. Pixels next to the
/// edge have half the jump as gradient, and those behind them none.
const GRADIENT_JUMP_RATIO: f32 = 1.732;

/// Smallest jump between two surfaces.
const MIN_SURFACE_JUMP: f32 = 1.01 * MIN_INDEPENDENT_JUMP;

/// Columns that are skipped at once where no pixel is an edge.
const COLUMNS_PER_BLOCK: usize = 32;

/// Jumps between pixels, in units of the jump that alone makes an edge.
pub(crate) struct PixelJumps<'a> {
    mesh: &'a Mesh,
    maps: &'a NormalDepthMaps,
    /// Whether borders between parts or materials count as jumps.
    parts: bool,
    depth: f32,
    normal: f32,
}

impl<'a> PixelJumps<'a> {
    pub(crate) fn new(mesh: &'a Mesh, maps: &'a NormalDepthMaps, options: &ImageOptions) -> Self {
        let [depth, normal] = match options.test {
            EdgeTest::Gradient => {
                [options.gradient_depth, options.gradient_normal].map(|k| GRADIENT_JUMP_RATIO * k as f32)
            }
            EdgeTest::Opposite => OPPOSITE_TEST_JUMPS,
        };
        let differ = |face: usize| {
            mesh.face_part[face] != mesh.face_part[0] || mesh.face_material[face] != mesh.face_material[0]
        };
        let parts = options.parts && (0..mesh.triangles.len()).any(differ);
        Self { mesh, maps, parts, depth: 1.0 / depth, normal: 1.0 / normal }
    }

    /// Jump of depth between two neighbours `a` and `b`, minus the part that the slope on either side
    /// explains.
    #[inline]
    pub(crate) fn of_depth(&self, [before, a, b, behind]: [usize; 4]) -> f32 {
        let depths = &self.maps.depths;
        let step = depths[b] - depths[a];
        let left = step - (depths[a] - depths[before]);
        let right = step - (depths[behind] - depths[b]);
        left.abs().min(right.abs()) * self.depth
    }

    #[inline]
    fn of_normal(&self, a: usize, b: usize) -> f32 {
        let (a, b) = (self.maps.normals[a], self.maps.normals[b]);
        ((a[0] - b[0]).abs() + (a[1] - b[1]).abs() + (a[2] - b[2]).abs()) / 3.0 * self.normal
    }

    /// Combined jump, if the pixels are edges. Between two surfaces it is large enough not to count as an
    /// echo: where depth jumps, and between parts or materials if these count.
    #[inline]
    fn of(&self, line: [usize; 4], are_edges: bool) -> f32 {
        let parts = self.parts && self.part_things(line[1], line[2]);
        let least = |parts: bool| if parts { MIN_SURFACE_JUMP } else { 0.0 };
        if !are_edges {
            return least(parts);
        }
        let (depth, normal) = (self.of_depth(line), self.of_normal(line[1], line[2]));
        (depth * depth + normal * normal).sqrt().max(least(parts || depth >= 1.0))
    }

    /// Whether two pixels show different parts or materials.
    #[inline]
    fn part_things(&self, a: usize, b: usize) -> bool {
        let faces = &self.maps.faces;
        let (a, b) = (faces[a], faces[b]);
        if a == b || a == NO_FRONT || b == NO_FRONT {
            return false;
        }
        let [a, b] =
            [a, b].map(|face| (self.mesh.face_part[face as usize], self.mesh.face_material[face as usize]));
        a != b
    }

    /// The left neighbour and the pixel itself, with the pixels before and after them in the row.
    #[inline]
    pub(crate) fn line_across(&self, column: usize, row: usize) -> [usize; 4] {
        let last = self.maps.columns - 1;
        [column.saturating_sub(2), column - 1, column, (column + 1).min(last)]
            .map(|column| row * self.maps.columns + column)
    }

    /// The upper neighbour and the pixel itself, with the pixels before and after them in the column.
    #[inline]
    pub(crate) fn line_down(&self, column: usize, row: usize) -> [usize; 4] {
        let last = self.maps.rows - 1;
        [row.saturating_sub(2), row - 1, row, (row + 1).min(last)].map(|row| row * self.maps.columns + column)
    }

    /// Map of the jumps between edge pixels.
    pub(crate) fn map(&self, edges: &[bool]) -> JumpTiles {
        let columns = self.maps.columns;
        JumpTiles::new(columns, self.maps.rows, |row, put| {
            for first in (0..columns).step_by(COLUMNS_PER_BLOCK) {
                let run = first..(first + COLUMNS_PER_BLOCK).min(columns);
                if self.may_jump(edges, row, run.clone()) {
                    self.along(edges, row, run, put);
                }
            }
        })
    }

    /// Whether there may be a jump in a run of a row. Without an edge pixel, only parts and materials cause
    /// jumps.
    fn may_jump(&self, edges: &[bool], row: usize, run: Range<usize>) -> bool {
        let own = row * self.maps.columns;
        // A full scan is faster than an early exit.
        self.parts || edges[own + run.start..own + run.end].iter().fold(false, |any, edge| any | edge)
    }

    /// Reports the jumps of a run of a row.
    fn along(&self, edges: &[bool], row: usize, run: Range<usize>, put: &mut dyn FnMut(usize, [f32; 2])) {
        let (columns, faces) = (self.maps.columns, &self.maps.faces);
        for column in run {
            let pixel = row * columns + column;
            let may_part = |other: usize| edges[pixel] || (self.parts && faces[pixel] != faces[other]);
            let mut jumps = [0.0; 2];
            if column > 0 && may_part(pixel - 1) {
                let are_edges = edges[pixel] && edges[pixel - 1];
                jumps[0] = self.of(self.line_across(column, row), are_edges);
            }
            if row > 0 && may_part(pixel - columns) {
                let are_edges = edges[pixel] && edges[pixel - columns];
                jumps[1] = self.of(self.line_down(column, row), are_edges);
            }
            if jumps != [0.0; 2] {
                put(column, jumps);
            }
        }
    }
}
