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

use glam::DVec2;
use rayon::prelude::*;

use super::graph::ViewVertexKind;
use super::grid::Grid;
use super::layers::{Layer, sweep};
use super::occlude::{Interval, Limits, covered, hidden_interval};
use super::occluders::{self, Occluder, Occluders, Triangles};
use super::project::ImageSegment;
use crate::lines::NO_FACE;
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

/// Findings in the order of their segments.
#[derive(Debug, Clone, PartialEq)]
struct Grouped<T> {
    starts: Vec<u32>,
    findings: Vec<T>,
}

impl<T: Copy> Grouped<T> {
    fn of(&self, segment: usize) -> &[T] {
        &self.findings[self.starts[segment] as usize..self.starts[segment + 1] as usize]
    }

    /// Sorts findings by segment (a counting sort, stable) and lets `tidy` order and join those
    /// of each.
    fn new(segments: usize, found: &[&[(u32, T)]], tidy: impl Fn(usize, &mut Vec<T>)) -> Self {
        let mut starts = vec![0u32; segments + 1];
        for (segment, _) in found.iter().copied().flatten() {
            starts[*segment as usize + 1] += 1;
        }
        for segment in 0..segments {
            starts[segment + 1] += starts[segment];
        }
        let mut order = vec![(0u32, 0u32); starts[segments] as usize];
        let mut next = starts.clone();
        for (list, findings) in found.iter().enumerate() {
            for (i, (segment, _)) in findings.iter().enumerate() {
                order[next[*segment as usize] as usize] = (list as u32, i as u32);
                next[*segment as usize] += 1;
            }
        }
        let mut grouped = Self { starts: vec![0; segments + 1], findings: Vec::with_capacity(order.len()) };
        let mut own: Vec<T> = Vec::new();
        for segment in 0..segments {
            let places = &order[starts[segment] as usize..starts[segment + 1] as usize];
            if !places.is_empty() {
                own.clear();
                own.extend(places.iter().map(|(list, i)| found[*list as usize][*i as usize].1));
                tidy(segment, &mut own);
                grouped.findings.extend_from_slice(&own);
            }
            grouped.starts[segment + 1] = grouped.findings.len() as u32;
        }
        grouped
    }
}

/// The part of a segment in one tile.
#[derive(Clone, Copy)]
struct Item {
    segment: u32,
    start: f64,
    end: f64,
}

#[derive(Default)]
struct TileResult {
    hidden: Vec<(u32, Layer)>,
    backed: Vec<(u32, Interval)>,
    tests: u64,
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
    let grid = Grid::new(&view.frame, tiles_across(mesh.triangles.len()));
    let (starts, mut items) = items_of_tiles(&grid, segments);
    let mut wanted: Vec<bool> = (0..grid.len()).map(|t| starts[t] < starts[t + 1]).collect();

    let triangles = Triangles { mesh, view, grid: &grid, limits };
    let boxes = triangles.tile_boxes();
    let mut cover = vec![f64::NEG_INFINITY; grid.len()];
    let mut buried: Vec<(u32, Layer)> = Vec::new();
    if !counting {
        cover = triangles.covers(&boxes, &wanted);
        buried = bury(segments, &starts, &mut items, &cover, &mut wanted);
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
                let items = &items[starts[tile] as usize..starts[tile + 1] as usize];
                context.decide_tile(items, &occluders, tile, &mut result);
            }
            result
        })
        .collect();
    gather(segments, limits, &buried, &results)
}

/// Denser meshes want smaller tiles; a tile should hold some tens of triangles.
fn tiles_across(triangles: usize) -> u32 {
    match triangles {
        0..=2_000 => 64,
        2_001..=30_000 => 128,
        _ => 256,
    }
}

/// The items of every tile by counting sort: where each tile starts, and the items.
fn items_of_tiles(grid: &Grid, segments: &[ImageSegment]) -> (Vec<u32>, Vec<Item>) {
    let mut starts = vec![0u32; grid.len() + 1];
    for s in segments {
        grid.walk(s.a, s.b, |tile, _, _| starts[tile + 1] += 1);
    }
    for tile in 0..grid.len() {
        starts[tile + 1] += starts[tile];
    }
    let mut next = starts.clone();
    let mut items = vec![Item { segment: 0, start: 0.0, end: 0.0 }; starts[grid.len()] as usize];
    for (i, s) in segments.iter().enumerate() {
        grid.walk(s.a, s.b, |tile, start, end| {
            items[next[tile] as usize] = Item { segment: i as u32, start, end };
            next[tile] += 1;
        });
    }
    (starts, items)
}

/// Marks items that lie behind the cover of their tile as hidden by emptying their range, and
/// forgets tiles all of whose items are.
fn bury(
    segments: &[ImageSegment],
    starts: &[u32],
    items: &mut [Item],
    cover: &[f64],
    wanted: &mut [bool],
) -> Vec<(u32, Layer)> {
    let mut buried = Vec::new();
    for (tile, cover) in cover.iter().enumerate().filter(|(_, c)| **c > f64::NEG_INFINITY) {
        let mut left = false;
        for item in &mut items[starts[tile] as usize..starts[tile + 1] as usize] {
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

fn whole(item: &Item) -> Layer {
    let kind = ViewVertexKind::TJunction;
    Layer {
        interval: Interval { start: item.start, end: item.end, start_kind: kind, end_kind: kind },
        count: 1,
    }
}

struct Context<'a> {
    mesh: &'a Mesh,
    view: &'a View,
    segments: &'a [ImageSegment],
    limits: &'a Limits,
    counting: bool,
}

impl Context<'_> {
    #[inline(never)]
    fn decide_tile(&self, items: &[Item], occluders: &Occluders, tile: usize, result: &mut TileResult) {
        let entries = occluders.of_tile(tile);
        let mut sorted = Vec::new();
        let mut entries = entries;
        // Sorting pays where many lines are asked of many triangles: hidden ones then meet what
        // hides them first.
        if !self.counting && entries.len() > 32 && items.len() > 8 {
            sorted.extend_from_slice(entries);
            sorted.sort_by(|a, b| b.nearest.total_cmp(&a.nearest).then(a.id.cmp(&b.id)));
            entries = &sorted;
        }
        let ordered = !sorted.is_empty();
        let mut hidden: Vec<Interval> = Vec::new();
        let mut layers: Vec<Layer> = Vec::new();
        for item in items.iter().filter(|item| item.end > item.start) {
            let segment = &self.segments[item.segment as usize];
            hidden.clear();
            if self.gather_hidden(segment, item, entries, ordered, &mut hidden, &mut result.tests) {
                result.hidden.push((item.segment, whole(item)));
                continue;
            }
            layers.clear();
            let shortest = self.limits.piece / segment.length().max(self.limits.piece);
            sweep(&mut hidden, shortest * 1e-3, self.counting, &mut layers);
            result.hidden.extend(layers.iter().map(|l| (item.segment, *l)));
            let buried = layers.iter().any(|l| l.interval.start <= item.start && l.interval.end >= item.end);
            if segment.bounds && !buried {
                self.gather_backed(segment, item, entries, result);
            }
        }
    }

    /// Collects what the triangles of a tile hide of an item. True if one of them, or a run of
    /// them, hides all of it and counts are not asked for.
    #[inline(never)]
    fn gather_hidden(
        &self,
        segment: &ImageSegment,
        item: &Item,
        entries: &[Occluder],
        ordered: bool,
        hidden: &mut Vec<Interval>,
        tests: &mut u64,
    ) -> bool {
        let (p, q) = (segment.at(item.start), segment.at(item.end));
        let (low, high) = (p.min(q), p.max(q));
        let bounds = [low.x as f32, high.x as f32, low.y as f32, high.y as f32];
        let farthest = (low.z as f32).next_down();
        let mut run = (f64::INFINITY, f64::NEG_INFINITY);
        for entry in entries {
            if entry.nearest < farthest {
                if ordered {
                    break;
                }
                continue;
            }
            let b = &entry.bounds;
            if b[0] > bounds[1] || b[1] < bounds[0] || b[2] > bounds[3] || b[3] < bounds[2] {
                continue;
            }
            let (corners, face) = occluders::corners(self.mesh, self.view, entry.id);
            if segment.hosts.contains(&face) {
                continue;
            }
            *tests += 1;
            let ids = self.mesh.triangles[face as usize];
            let Some(mut found) = hidden_interval(segment, &corners, ids, &self.view.frame, self.limits)
            else {
                continue;
            };
            if found.end < item.start || found.start > item.end {
                continue;
            }
            found.start = found.start.max(item.start);
            found.end = found.end.min(item.end);
            hidden.push(found);
            if !self.counting {
                if found.start <= run.1 && found.end >= run.0 {
                    run = (run.0.min(found.start), run.1.max(found.end));
                } else if found.end - found.start > run.1 - run.0 {
                    run = (found.start, found.end);
                }
                if run.0 <= item.start && run.1 >= item.end {
                    return true;
                }
            }
        }
        false
    }

    /// Collects where a surface lies just beside a bounding segment, on its outer side.
    #[inline(never)]
    fn gather_backed(
        &self,
        segment: &ImageSegment,
        item: &Item,
        entries: &[Occluder],
        result: &mut TileResult,
    ) {
        let Some(outward) = self.outward(segment) else { return };
        let shift = outward * self.limits.beside;
        let (p, q) = (segment.a.truncate() + shift, segment.b.truncate() + shift);
        let (from, to) = (segment.at(item.start).truncate() + shift, segment.at(item.end).truncate() + shift);
        let (low, high) = (from.min(to), from.max(to));
        for entry in entries {
            let b = entry.bounds.map(f64::from);
            if b[0] > high.x || b[1] < low.x || b[2] > high.y || b[3] < low.y {
                continue;
            }
            let (corners, face) = occluders::corners(self.mesh, self.view, entry.id);
            let ids = self.mesh.triangles[face as usize];
            if segment.ends.iter().all(|end| ids.contains(end)) {
                continue;
            }
            let Some((start, end)) = covered(p, q, &corners, self.limits) else { continue };
            let (start, end) = (start.max(item.start), end.min(item.end));
            if start < end {
                let kind = ViewVertexKind::Backdrop;
                let interval = Interval { start, end, start_kind: kind, end_kind: kind };
                result.backed.push((item.segment, interval));
            }
        }
    }

    /// The unit vector across a segment, away from the faces that meet there.
    fn outward(&self, segment: &ImageSegment) -> Option<DVec2> {
        let along = (segment.b - segment.a).truncate();
        let across = along.perp().try_normalize()?;
        let face = *segment.hosts.iter().filter(|f| **f != NO_FACE).max_by(|a, b| {
            let height = |f: u32| self.height(segment, across, f).abs();
            height(**a).total_cmp(&height(**b))
        })?;
        let height = self.height(segment, across, face);
        Some(if height > 0.0 { -across } else { across })
    }

    /// How far the third corner of a face lies to the side of a segment; 0 where it is cut off.
    fn height(&self, segment: &ImageSegment, across: DVec2, face: u32) -> f64 {
        let corners = self.mesh.triangles[face as usize];
        let third = corners.iter().find(|v| !segment.ends.contains(v));
        let height = third.map(|v| (self.view.points[*v as usize] - segment.a).truncate().dot(across));
        height.filter(|h| h.is_finite()).unwrap_or(0.0)
    }
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
            sweep(intervals, shortest(segment), false, &mut joined);
            intervals.clear();
            intervals.extend(joined.iter().map(|l| l.interval));
        }),
    }
}

/// Joins pieces of equal count that touch, and drops what is shorter than rounding.
fn join_layers(layers: &mut Vec<Layer>, shortest: f64) {
    layers.sort_by(|a, b| a.interval.start.total_cmp(&b.interval.start));
    let mut last = 0;
    for i in 1..layers.len() {
        let layer = layers[i];
        let joined = &mut layers[last];
        if joined.count == layer.count && layer.interval.start - joined.interval.end <= shortest {
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
    layers.retain(|l| l.interval.end - l.interval.start > shortest);
}
