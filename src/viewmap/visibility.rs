//! Visibility: which parts of which segments are hidden, and by how many surfaces.
//!
//! Invisibility counts every surface layer between a line and the eye, whether it turns its
//! outside to the eye or not: a line behind a closed box is behind two layers.
//!
//! All lines of sight of a view leave one point, so a grid over the *image* answers what a tree
//! over space would: the page is cut into tiles, every segment is walked through them, and inside
//! a tile each segment is compared with each triangle there. What a triangle hides is an interval
//! of the segment's parameter (see [`super::occlude`]); the visible parts are what no interval
//! covers. Cusps, T-junctions and piercings fall out of that with computed end points.
//!
//! Source: the idea of subtracting intervals follows Blender's Line Art and
//! three-edge-projection; deciding in the image is after Arthur Appel, "The notion of
//! quantitative invisibility and the machine rendering of solids", 1967.

use glam::DVec3;
use rayon::prelude::*;

use super::grid::Grid;
use super::grouped::{Grouped, bucket};
use super::layers::{Layer, sweep};
use super::occlude::{Interval, Limits};
use super::occluders::Triangles;
use super::project::ImageSegment;
use super::tile::{Context, Item, TileResult, whole};
use crate::mesh::Mesh;
use crate::view::View;

/// What is known of all segments.
#[derive(Debug, Clone, PartialEq)]
pub struct Visibility {
    hidden: Grouped<Layer>,
    backed: Grouped<Interval>,
    /// How many times a segment was compared with a triangle.
    pub tests: u64,
}

impl Visibility {
    /// The hidden pieces of a segment with their counts, ascending.
    #[must_use]
    pub fn hidden(&self, segment: usize) -> &[Layer] {
        self.hidden.of(segment)
    }

    /// The ranges of a segment that have a surface beside them on the outer side, ascending; only
    /// for segments that bound a surface.
    #[must_use]
    pub fn backed(&self, segment: usize) -> &[Interval] {
        self.backed.of(segment)
    }
}

/// Decides the visibility of all segments. With `counting` false, counts are not told apart and
/// stay 1, which is faster.
#[must_use]
pub fn decide(
    mesh: &Mesh,
    view: &View,
    segments: &[ImageSegment],
    limits: &Limits,
    counting: bool,
) -> Visibility {
    let grid = grid_over(segments, tiles_across(mesh.triangles.len()));
    let mut items = bucket(grid.len(), |put| {
        for (i, s) in segments.iter().enumerate() {
            grid.walk(s.a, s.b, |tile, start, end| put(tile, Item { segment: i as u32, start, end }));
        }
    });
    let mut wanted: Vec<bool> = (0..grid.len()).map(|t| !items.of(t).is_empty()).collect();

    let triangles = Triangles { mesh, view, grid: &grid, limits };
    let boxes = triangles.tile_boxes();
    let mut cover = vec![f64::NEG_INFINITY; grid.len()];
    let mut buried: Vec<(u32, Layer)> = Vec::new();
    if !counting {
        cover = triangles.covers(&boxes, &wanted);
        buried = bury(segments, &mut items, &cover, &mut wanted);
    }
    let occluders = triangles.fill(&boxes, &wanted, &cover);
    drop(boxes);

    let context = Context { mesh, view, segments, limits, counting };
    const TILES: usize = 64;
    let results: Vec<TileResult> = (0..grid.len().div_ceil(TILES))
        .into_par_iter()
        .map(|k| {
            let mut result = TileResult::default();
            for tile in k * TILES..((k + 1) * TILES).min(grid.len()) {
                context.decide_tile(items.of(tile), occluders.of_tile(tile), &grid, tile, &mut result);
            }
            result
        })
        .collect();
    gather(segments, limits, &buried, &results)
}

/// A grid over the box around all segments.
fn grid_over(segments: &[ImageSegment], across: u32) -> Grid {
    let nothing = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (low, high) =
        segments.iter().fold(nothing, |(low, high), s| (low.min(s.a).min(s.b), high.max(s.a).max(s.b)));
    let (low, high) = if segments.is_empty() { (DVec3::ZERO, DVec3::ZERO) } else { (low, high) };
    Grid::new(low.truncate(), high.truncate(), across)
}

/// Denser meshes want smaller tiles; crowded tiles are cut further.
fn tiles_across(triangles: usize) -> u32 {
    match triangles {
        0..=2_000 => 64,
        2_001..=30_000 => 128,
        _ => 256,
    }
}

/// Marks items that lie behind the cover of their tile as hidden by emptying their range, and
/// forgets tiles all of whose items are.
fn bury(
    segments: &[ImageSegment],
    items: &mut Grouped<Item>,
    cover: &[f64],
    wanted: &mut [bool],
) -> Vec<(u32, Layer)> {
    let mut buried = Vec::new();
    for (tile, cover) in cover.iter().enumerate().filter(|(_, c)| **c > f64::NEG_INFINITY) {
        let mut left = false;
        for item in items.of_mut(tile) {
            let s = &segments[item.segment as usize];
            if s.at(item.start).z.max(s.at(item.end).z) < *cover {
                buried.push((item.segment, whole(item)));
                item.end = f64::NEG_INFINITY;
            } else {
                left = true;
            }
        }
        wanted[tile] = left;
    }
    buried
}

/// Brings the findings of all tiles back to their segments and joins them there.
fn gather(
    segments: &[ImageSegment],
    limits: &Limits,
    buried: &[(u32, Layer)],
    results: &[TileResult],
) -> Visibility {
    let shortest = |segment: usize| limits.piece / segments[segment].length().max(limits.piece);
    let hidden: Vec<&[(u32, Layer)]> =
        std::iter::once(buried).chain(results.iter().map(|r| &r.hidden[..])).collect();
    let backed: Vec<&[(u32, Interval)]> = results.iter().map(|r| &r.backed[..]).collect();
    Visibility {
        tests: results.iter().map(|r| r.tests).sum(),
        hidden: Grouped::new(segments.len(), &hidden, |segment, layers| {
            join_layers(layers, shortest(segment));
        }),
        backed: Grouped::new(segments.len(), &backed, |segment, intervals| {
            let mut joined = Vec::new();
            // Beside a corner the outer side may graze a face that only shares the vertex.
            let grazing = 4.0 * limits.beside / segments[segment].length().max(4.0 * limits.beside);
            sweep(intervals, grazing, false, &mut joined);
            intervals.clear();
            intervals.extend(joined.iter().map(|l| l.interval));
        }),
    }
}

/// Joins pieces of equal count that touch, and drops what is shorter than rounding.
fn join_layers(layers: &mut Vec<Layer>, shortest: f64) {
    layers.sort_by(|a, b| a.interval.start.total_cmp(&b.interval.start));
    join_touching(layers, shortest);
    layers.retain(|l| l.interval.end - l.interval.start > shortest);
    // Both faces beside an edge cover it, so that behind every edge lies a sliver of one layer
    // more: what it parted is one again.
    join_touching(layers, 2.0 * shortest);
}

/// Joins neighbours of equal count with a gap of at most `gap` between them.
fn join_touching(layers: &mut Vec<Layer>, gap: f64) {
    let mut last = 0;
    for i in 1..layers.len() {
        let layer = layers[i];
        let joined = &mut layers[last];
        if joined.count == layer.count && layer.interval.start - joined.interval.end <= gap {
            if layer.interval.end > joined.interval.end {
                joined.interval.end = layer.interval.end;
                joined.interval.end_kind = layer.interval.end_kind;
            }
        } else {
            last += 1;
            layers[last] = layer;
        }
    }
    layers.truncate(last + 1);
}
