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
use super::occluders::{self, Occluder, Occluders};
use super::project::ImageSegment;
use crate::mesh::Mesh;
use crate::view::View;

/// What is known of one segment; both lists ascending.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Seen {
    /// Hidden pieces with their counts.
    pub hidden: Vec<Layer>,
    /// Ranges that have a surface beside them on the outer side; only for segments that bound a
    /// surface.
    pub backed: Vec<Interval>,
}

/// The part of a segment in one tile.
#[derive(Clone, Copy)]
struct Item {
    segment: u32,
    start: f64,
    end: f64,
}

/// What one tile found out about one of its items.
struct Finding {
    segment: u32,
    hidden: Layer,
}

#[derive(Default)]
struct TileResult {
    hidden: Vec<Finding>,
    backed: Vec<(u32, Interval)>,
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
) -> Vec<Seen> {
    let grid = Grid::new(&view.frame, tiles_across(mesh.triangles.len()));
    let (starts, mut items) = items_of_tiles(&grid, segments);
    let mut wanted: Vec<bool> = (0..grid.len()).map(|t| starts[t] < starts[t + 1]).collect();

    let mut cover = vec![f64::NEG_INFINITY; grid.len()];
    let mut buried: Vec<Finding> = Vec::new();
    if !counting {
        cover = occluders::covers(mesh, view, &grid, &wanted, limits);
        buried = bury(segments, &starts, &mut items, &cover, &mut wanted);
    }
    let occluders = occluders::fill(mesh, view, &grid, &wanted, &cover);

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
    gather(segments, limits, buried, results)
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
) -> Vec<Finding> {
    let mut buried = Vec::new();
    for (tile, cover) in cover.iter().enumerate().filter(|(_, c)| **c > f64::NEG_INFINITY) {
        let mut left = false;
        for item in &mut items[starts[tile] as usize..starts[tile + 1] as usize] {
            let s = &segments[item.segment as usize];
            if s.at(item.start).z.max(s.at(item.end).z) < *cover {
                buried.push(Finding { segment: item.segment, hidden: whole(item) });
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
            if self.gather_hidden(segment, item, entries, ordered, &mut hidden) {
                result.hidden.push(Finding { segment: item.segment, hidden: whole(item) });
                continue;
            }
            layers.clear();
            let shortest = self.limits.piece / segment.length().max(self.limits.piece);
            sweep(&mut hidden, shortest * 1e-3, self.counting, &mut layers);
            result.hidden.extend(layers.iter().map(|l| Finding { segment: item.segment, hidden: *l }));
            let buried = layers.iter().any(|l| l.interval.start <= item.start && l.interval.end >= item.end);
            if segment.bounds && !buried {
                self.gather_backed(segment, item, entries, result);
            }
        }
    }

    /// Collects what the triangles of a tile hide of an item. True if one of them, or a run of
    /// them, hides all of it and counts are not asked for.
    fn gather_hidden(
        &self,
        segment: &ImageSegment,
        item: &Item,
        entries: &[Occluder],
        ordered: bool,
        hidden: &mut Vec<Interval>,
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
        let [u, v] = segment.ends;
        let (lo, hi) = (u.min(v), u.max(v));
        let edge = self.mesh.edges.vertices.binary_search(&[lo, hi]).ok()?;
        let face = match self.mesh.edges.faces(edge) {
            crate::mesh::EdgeFaces::One(face) => face,
            crate::mesh::EdgeFaces::Two { faces, .. } => self.tallest(segment, across, &faces),
            crate::mesh::EdgeFaces::Many(faces) => self.tallest(segment, across, faces),
        };
        let height = self.height(segment, across, face);
        Some(if height > 0.0 { -across } else { across })
    }

    fn tallest(&self, segment: &ImageSegment, across: DVec2, faces: &[u32]) -> u32 {
        let height = |f: &u32| self.height(segment, across, *f).abs();
        let mut best = faces[0];
        for face in faces {
            if height(face) > height(&best) {
                best = *face;
            }
        }
        best
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
    buried: Vec<Finding>,
    results: Vec<TileResult>,
) -> Vec<Seen> {
    let mut seen: Vec<Seen> = vec![Seen::default(); segments.len()];
    for finding in buried {
        seen[finding.segment as usize].hidden.push(finding.hidden);
    }
    for result in results {
        for finding in result.hidden {
            seen[finding.segment as usize].hidden.push(finding.hidden);
        }
        for (segment, interval) in result.backed {
            seen[segment as usize].backed.push(interval);
        }
    }
    seen.par_iter_mut().zip(segments).for_each(|(seen, segment)| {
        let shortest = limits.piece / segment.length().max(limits.piece);
        join_layers(&mut seen.hidden, shortest);
        if !seen.backed.is_empty() {
            let mut joined = Vec::new();
            sweep(&mut seen.backed, shortest, false, &mut joined);
            seen.backed = joined.iter().map(|l| l.interval).collect();
        }
    });
    seen
}

/// Joins pieces of equal count that touch, and drops what is shorter than rounding.
fn join_layers(layers: &mut Vec<Layer>, shortest: f64) {
    layers.sort_by(|a, b| a.interval.start.total_cmp(&b.interval.start));
    let mut joined: Vec<Layer> = Vec::with_capacity(layers.len());
    for layer in layers.iter() {
        match joined.last_mut() {
            Some(last)
                if last.count == layer.count && layer.interval.start - last.interval.end <= shortest =>
            {
                if layer.interval.end > last.interval.end {
                    last.interval.end = layer.interval.end;
                    last.interval.end_kind = layer.interval.end_kind;
                }
            }
            _ => joined.push(*layer),
        }
    }
    joined.retain(|l| l.interval.end - l.interval.start > shortest);
    *layers = joined;
}
