//! [`SegmentVisibility`]: the hidden parts of all segments, and the number of surfaces in front of each.
//!
//! Invisibility counts every surface layer between a line and the eye, facing or averted. So a line behind a
//! closed box is behind two layers.
//!
//! 1. All lines of sight of a view leave one point, so a grid over the *image* replaces a spatial tree.
//! 2. Every segment is traversed through the tiles of the grid.
//! 3. Inside a tile, each segment is compared with each triangle there. A triangle hides an interval of the
//!    segment's parameter (see [`crate::visibility::occlusion::triangle_occlusion`]).
//! 4. The visible parts are those that no interval covers. Cusps, T-junctions and piercings follow, with
//!    computed end points.
//!
//! Source: intervals are subtracted as in Blender's Line Art and three-edge-projection. Visibility is decided
//! in the image, after Arthur Appel, "The notion of quantitative invisibility and the machine rendering of
//! solids", 1967.

use std::borrow::Cow;

use crate::parallel::prelude::*;

use super::segment_comparison::TriangleChoice;
use super::tile_comparison::{SegmentScratch, TileResult};
use super::tile_segments::TileSegments;
use crate::geometry::lists::csr_lists::{CsrLists, csr_lists_from_pairs};
use crate::lines::Role;
use crate::mesh::Mesh;
use crate::view::View;
use crate::visibility::culling::occlusion_buffer::OcclusionBuffer;
use crate::visibility::culling::view_occlusion::ViewOcclusionBuffer;
use crate::visibility::graph::ViewVertexKind;
use crate::visibility::occlusion::interval_sweep::{HiddenInterval, sweep};
use crate::visibility::occlusion::occlusion_input::{OcclusionInput, TileSegment};
use crate::visibility::occlusion::tiled_triangles::{OccluderBounds, TiledTriangles};
use crate::visibility::occlusion::triangle_occlusion::Interval;
use crate::visibility::projection::image_segments::ImageSegment;
use crate::visibility::tiles::aligned_grid::{grid_over, tiles_across};
use crate::visibility::tolerances;
use crate::visibility::view_tolerances::ViewTolerances;

/// Hidden from end to end.
pub(crate) const FULLY_HIDDEN: [HiddenInterval; 1] = [whole(0.0, 1.0)];

const fn whole(start: f64, end: f64) -> HiddenInterval {
    let kind = ViewVertexKind::TJunction;
    HiddenInterval { interval: Interval { start, end, start_kind: kind, end_kind: kind }, count: 1 }
}

/// Visibility of all segments.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SegmentVisibility {
    /// Whether each segment is hidden from end to end by at least one layer; only where layers are not
    /// counted.
    fully_hidden: Vec<bool>,
    hidden: CsrLists<HiddenInterval>,
    non_silhouette: CsrLists<Interval>,
    /// Number of comparisons between a segment and a triangle.
    pub tests: u64,
}

impl SegmentVisibility {
    /// Hidden pieces of a segment with their counts, ascending.
    #[must_use]
    pub(crate) fn hidden(&self, segment: usize) -> &[HiddenInterval] {
        if self.fully_hidden[segment] { &FULLY_HIDDEN } else { self.hidden.of(segment) }
    }

    /// Ranges of a segment with a surface next to them on the outer side, ascending. Only for segments that
    /// bound a surface.
    #[must_use]
    pub(crate) fn backed(&self, segment: usize) -> &[Interval] {
        self.non_silhouette.of(segment)
    }
}

/// Computes the visibility of all segments except smooth contours, which take theirs from the mesh contour.
///
/// With `counting` false, all counts are 1, which is faster.
#[must_use]
pub(crate) fn decide(
    mesh: &Mesh,
    view: &View,
    segments: &[ImageSegment],
    limits: &ViewTolerances,
    counting: bool,
) -> SegmentVisibility {
    decide_with(mesh, view, segments, limits, counting, None)
}

/// Like [`decide`], with an occlusion buffer made earlier, which is used if its grid fits.
#[must_use]
pub(crate) fn decide_with(
    mesh: &Mesh,
    view: &View,
    segments: &[ImageSegment],
    limits: &ViewTolerances,
    counting: bool,
    buffer: Option<&ViewOcclusionBuffer>,
) -> SegmentVisibility {
    let relevant_segments =
        || segments.iter().zip(0u32..).filter(|(segment, _)| segment.role != Role::SmoothContour);
    if relevant_segments().next().is_none() {
        return gather(segments, limits, &[], &[]);
    }
    let grid = grid_over(relevant_segments().map(|(segment, _)| segment), tiles_across(mesh.triangles.len()));
    let triangles = TiledTriangles { mesh, view, grid: &grid, limits };
    let items = || {
        let matching_buffer = buffer.filter(|known| known.grid == grid);
        let covers = match matching_buffer {
            _ if counting => Cow::Owned(OcclusionBuffer::none(&grid)),
            Some(known) => Cow::Borrowed(&known.covers),
            None => Cow::Owned(OcclusionBuffer::find(&triangles)),
        };
        (TileSegments::new(segments, &grid, &covers), covers)
    };
    let ((items, covers), boxes) = crate::parallel::join(items, || triangles.tile_boxes());
    let TileSegments { open: items, behind_buffer: buried } = items;
    let farthest = |tile: usize| {
        if items.of(tile).is_empty() { f64::INFINITY } else { covers.tile_nearness[tile] }
    };
    let farthest: Vec<f64> = (0..grid.len()).map(farthest).collect();
    let occluders = triangles.fill(boxes, &farthest);

    let compared = OcclusionInput { triangles: &triangles, segments, limits, counting };
    const TILES_PER_TASK: usize = 64;
    let decided = |task: usize| {
        let (mut scratch, mut result) = (SegmentScratch::default(), TileResult::default());
        for tile in task * TILES_PER_TASK..((task + 1) * TILES_PER_TASK).min(grid.len()) {
            if !items.of(tile).is_empty() {
                let chosen: Vec<OccluderBounds> =
                    occluders.of(tile).iter().map(|id| triangles.reach(*id)).collect();
                let entries = TriangleChoice { chosen: &chosen, ordered: false };
                compared.decide_tile(items.of(tile), entries, (&grid, tile), &mut scratch, &mut result);
            }
        }
        result.tidy();
        result
    };
    // Some tiles are crowded and most are not, so tasks are small.
    let tasks = (0..grid.len().div_ceil(TILES_PER_TASK)).into_par_iter().with_max_len(1);
    let results: Vec<TileResult> = tasks.map(decided).collect();
    // Freed first, because sorting the results takes the same amount of memory again.
    drop((occluders, items));
    gather(segments, limits, &buried, &results)
}

/// Gathers the results of all tiles by segment and joins them there.
fn gather(
    segments: &[ImageSegment],
    limits: &ViewTolerances,
    buried_items: &[TileSegment],
    results: &[TileResult],
) -> SegmentVisibility {
    let shortest = |segment: usize| limits.piece / segments[segment].length().max(limits.piece);
    let hidden_items = || buried_items.iter().chain(results.iter().flat_map(|r| &r.fully_hidden));
    // The parts of a segment divide its parameter range. So a segment is entirely hidden if its hidden parts
    // add up to 1.
    let mut length = vec![0.0f64; segments.len()];
    for item in hidden_items() {
        length[item.segment as usize] += item.end - item.start;
    }
    let buried: Vec<bool> =
        length.iter().map(|l| *l >= 1.0 - tolerances::MAX_VISIBLE_OF_BURIED_SEGMENT).collect();
    let open = |segment: u32| !buried[segment as usize];
    let hidden = || {
        let of_item = |item: &TileSegment| (item.segment, whole(item.start, item.end));
        let pieces = results.iter().flat_map(|r| &r.hidden).copied();
        let found = hidden_items().map(of_item).chain(pieces).filter(|(segment, _)| open(*segment));
        let hidden =
            csr_lists_from_pairs(segments.len(), found.map(|(segment, layer)| (segment as usize, layer)));
        hidden.tidied(|segment, layers| join_layers(layers, shortest(segment)))
    };
    let backed = || {
        let pairs = results.iter().flat_map(|r| &r.non_silhouette);
        let backed = csr_lists_from_pairs(
            segments.len(),
            pairs.map(|(segment, interval)| (*segment as usize, *interval)),
        );
        backed.tidied(|segment, intervals| {
            let mut joined = Vec::new();
            // Near a corner, the outer side may graze a face that only shares the vertex.
            let grazing = 4.0 * limits.side_offset / segments[segment].length().max(4.0 * limits.side_offset);
            sweep(intervals, grazing, false, &mut joined);
            intervals.clear();
            intervals.extend(joined.iter().map(|l| l.interval));
        })
    };
    let (hidden, backed) = crate::parallel::join(hidden, backed);
    SegmentVisibility {
        tests: results.iter().map(|r| r.tests).sum(),
        hidden,
        non_silhouette: backed,
        fully_hidden: buried,
    }
}

/// Joins touching pieces of equal count and drops those shorter than rounding.
fn join_layers(layers: &mut Vec<HiddenInterval>, shortest: f64) {
    layers.sort_by(|a, b| a.interval.start.total_cmp(&b.interval.start));
    join_touching(layers, shortest);
    layers.retain(|l| l.interval.end - l.interval.start > shortest);
    // Both faces at an edge cover it, so behind every edge there is a sliver with one more layer. The pieces
    // on both sides of it are joined again.
    join_touching(layers, 2.0 * shortest);
}

/// Joins neighbours of equal count with a gap of at most `gap` between them.
fn join_touching(layers: &mut Vec<HiddenInterval>, gap: f64) {
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
