//! One tile: its segments against its triangles.

use glam::{DVec2, DVec3};

use super::graph::ViewVertexKind;
use super::grid::Grid;
use super::grouped::bucket;
use super::layers::{Layer, sweep};
use super::occlude::{Interval, Limits, covered, hidden_interval};
use super::occluders::{self, Occluder};
use super::project::ImageSegment;
use crate::lines::NO_FACE;
use crate::mesh::Mesh;
use crate::view::View;

/// Lists up to this long are looked through as they are.
const FEW: usize = 32;
/// A tile with more pairs of segment and triangle than this is cut into finer ones.
const MANY_PAIRS: usize = 1024;
/// Finer tiles along each side of a crowded one.
const FINER: u32 = 8;

/// The part of a segment in one tile.
#[derive(Debug, Clone, Copy)]
pub(super) struct Item {
    pub(super) segment: u32,
    pub(super) start: f64,
    pub(super) end: f64,
}

/// What a run of tiles found out about segments.
#[derive(Debug, Default)]
pub(super) struct TileResult {
    pub(super) hidden: Vec<(u32, Layer)>,
    pub(super) backed: Vec<(u32, Interval)>,
    pub(super) tests: u64,
}

pub(super) fn whole(item: &Item) -> Layer {
    let kind = ViewVertexKind::TJunction;
    Layer {
        interval: Interval { start: item.start, end: item.end, start_kind: kind, end_kind: kind },
        count: 1,
    }
}

/// What all tiles share.
#[derive(Debug, Clone, Copy)]
pub(super) struct Context<'a> {
    pub(super) mesh: &'a Mesh,
    pub(super) view: &'a View,
    pub(super) segments: &'a [ImageSegment],
    pub(super) limits: &'a Limits,
    pub(super) counting: bool,
}

impl Context<'_> {
    /// Compares the items of a tile with its triangles. `tiles` has the tile as its cell `tile`.
    pub(super) fn decide_tile(
        &self,
        items: &[Item],
        entries: &[Occluder],
        grid: &Grid,
        tile: usize,
        result: &mut TileResult,
    ) {
        if entries.len() > FEW
            && items.len() * entries.len() > MANY_PAIRS
            && grid.cell > self.limits.beside * 64.0
        {
            return self.decide_finer(items, entries, &grid.of_tile(tile, FINER), result);
        }
        let mut sorted = Vec::new();
        let mut entries = entries;
        // Sorting pays where many lines are asked of many triangles: hidden ones then meet what
        // hides them first.
        if !self.counting && entries.len() > FEW && items.len() > 8 {
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

    /// Cuts a crowded tile into finer ones: where a dense model is small on the page, a grid over
    /// the page does not part its lines.
    fn decide_finer(&self, items: &[Item], entries: &[Occluder], grid: &Grid, result: &mut TileResult) {
        let own = items.iter().filter(|item| item.end > item.start);
        let fine_items = bucket(grid.len(), |put| {
            for item in own.clone() {
                let segment = &self.segments[item.segment as usize];
                let span = item.end - item.start;
                grid.walk(segment.at(item.start), segment.at(item.end), |tile, t0, t1| {
                    let at = |t: f64| if t >= 1.0 { item.end } else { item.start + span * t };
                    put(tile, Item { start: at(t0), end: at(t1), ..*item });
                });
            }
        });
        let slack = 2.0 * self.limits.beside;
        let fine_entries = bucket(grid.len(), |put| {
            for entry in entries {
                let [left, right, top, bottom] = entry.bounds.map(f64::from);
                let (low, high) = (DVec3::new(left, top, 0.0), DVec3::new(right, bottom, 0.0));
                for (tile, _) in grid.tiles_of(grid.tile_box(low - slack, high + slack)) {
                    put(tile, *entry);
                }
            }
        });
        for tile in 0..grid.len() {
            let (items, entries) = (fine_items.of(tile), fine_entries.of(tile));
            if !items.is_empty() {
                self.decide_tile(items, entries, grid, tile, result);
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
        let bounds = [
            (low.x as f32).next_down(),
            (high.x as f32).next_up(),
            (low.y as f32).next_down(),
            (high.y as f32).next_up(),
        ];
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
