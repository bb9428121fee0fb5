//! Removal of coincident lines: where two visible lines coincide in the image, only the stronger one is kept.
//!
//! Edges of touching parts, coplanar faces and T-vertices give lines that coincide in the image without being
//! one edge of the mesh. The weaker kind gives way. Of equal kinds the farther line gives way. The order of
//! parts in the file has no effect. Lines that share a vertex may be the two sides of a fold, so they must
//! coincide within rounding.

use std::cmp::Ordering;

use crate::parallel::prelude::*;
use kurbo::Vec2;

use super::edge_grid::EdgeGrid;
use super::edge_line::EdgeLine;
use crate::mesh::MeshMetrics;
use crate::view::Frame;
use crate::visibility::graph::{ViewEdge, ViewMap, ViewVertex, ViewVertexId, ViewVertexKind};
use crate::visibility::tolerances;

/// Lines shorter than this multiple of the distance have no reliable direction and are left alone.
const MIN_LENGTH_PER_DISTANCE: f64 = 8.0;

/// Removes the parts of visible edges that lie within `max_distance` (user units) of a stronger visible edge.
///
/// `frame` is the frame of the view, `extents` those of the mesh.
pub(crate) fn remove_coincident(map: &mut ViewMap, max_distance: f64, frame: &Frame, extents: &MeshMetrics) {
    let covered = find_covered(map, max_distance, frame, extents);
    if covered.is_empty() {
        return;
    }
    let mut covered = covered.into_iter().peekable();
    let edges = std::mem::take(&mut map.edges);
    let ranges = (0..edges.len() as u32).map(|id| {
        std::iter::from_fn(|| covered.next_if(|(of, _)| *of == id)).map(|(_, range)| range).collect()
    });
    map.edges = cut_edges(&mut map.vertices, &edges, ranges, max_distance, frame.perspective);
}

/// Parameter ranges of edges that another edge covers, sorted by edge and start.
fn find_covered(map: &ViewMap, within: f64, frame: &Frame, extents: &MeshMetrics) -> Vec<(u32, (f64, f64))> {
    let visible_edges = map.edges.iter().zip(0..).filter(|(edge, _)| edge.invisibility == 0);
    let visible_ids: Vec<u32> = visible_edges.map(|(_, id)| id).collect();
    let of_edge = |id: &u32| (*id, EdgeLine::of(map, &map.edges[*id as usize]));
    let mut lines: Vec<(u32, EdgeLine)> = visible_ids.par_iter().with_min_len(1 << 10).map(of_edge).collect();
    drop(visible_ids);
    lines.retain(|(_, line)| line.length > MIN_LENGTH_PER_DISTANCE * within);
    let (ids, lines): (Vec<u32>, Vec<EdgeLine>) = lines.into_iter().unzip();
    let Some(grid) = EdgeGrid::new(&lines, 0.0) else { return Vec::new() };
    let search = CoincidenceSearch { map, extents, frame, max_distance: within, ids, lines, grid };
    let mut covered: Vec<(u32, (f64, f64))> = (0..search.lines.len())
        .into_par_iter()
        .with_min_len(256)
        .map_init(NearbyLines::default, |near, k| search.covered_with(k, near))
        .flatten_iter()
        .collect();
    covered.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.0.total_cmp(&b.1.0)));
    covered
}

/// Lines long enough to have a direction, with the grid tiles they pass.
struct CoincidenceSearch<'a> {
    map: &'a ViewMap,
    extents: &'a MeshMetrics,
    frame: &'a Frame,
    max_distance: f64,
    /// Indices of edges, ascending.
    ids: Vec<u32>,
    lines: Vec<EdgeLine>,
    grid: EdgeGrid,
}

impl CoincidenceSearch<'_> {
    /// Ranges of one line and the lines before it that cover each other.
    fn covered_with(&self, number: usize, nearby: &mut NearbyLines) -> Vec<(u32, (f64, f64))> {
        let Self { map, extents, max_distance: within, ids, lines, .. } = self;
        let (id, line) = (&ids[number], &lines[number]);
        let edge = &map.edges[*id as usize];
        let mut covered = Vec::new();
        self.find_near(number, nearby);
        for nearby_number in &nearby.lines {
            let other = *nearby_number as usize;
            let (other_id, other_line) = (&ids[other], &lines[other]);
            let other_edge = &map.edges[*other_id as usize];
            let joined = edge.start == other_edge.start
                || edge.start == other_edge.end
                || edge.end == other_edge.start
                || edge.end == other_edge.end;
            let within = if joined { self.joined_tolerance([edge, other_edge]) } else { *within };
            if !line.runs_along(other_line, within) {
                continue;
            }
            let (loser, range) = if precedence(map, extents, edge, other_edge).is_lt() {
                (*other_id, other_line.covered_by(line, within))
            } else {
                (*id, line.covered_by(other_line, within))
            };
            covered.extend(range.map(|range| (loser, range)));
        }
        covered
    }

    /// Distance within which two lines with a common vertex coincide, user units: the effect of rounding on a
    /// line that was split.
    fn joined_tolerance(&self, edges: [&ViewEdge; 2]) -> f64 {
        let shift = |edge: &ViewEdge| {
            let depth = self.map.vertices[edge.start.index()].depth;
            2.0 * self.extents.part(edge.part).rounding / self.frame.px_at(depth) * self.frame.px()
        };
        // NaN at the eye itself, which `f64::max` ignores.
        let rounding = edges.map(shift).into_iter().fold(0.0, f64::max);
        (self.max_distance * tolerances::JOINED_LINE_OF_DISTANCE).max(rounding.min(self.max_distance))
    }

    /// Collects the earlier lines that may coincide with a line, ascending.
    ///
    /// Such a line passes a tile of the line itself or of one of its parallels at distance `max_distance`, because
    /// tiles are convex.
    fn find_near(&self, number: usize, NearbyLines { tiles, lines }: &mut NearbyLines) {
        let line = &self.lines[number];
        let across = Vec2::new(-line.along.y, line.along.x) * self.max_distance;
        tiles.clear();
        self.grid.walk_beside([line.start, line.end()], across, |tile| {
            // Most lines are short and yield the same tile three times.
            if tiles.last() != Some(&tile) {
                tiles.push(tile);
            }
        });
        let before = |tile: &usize| {
            let own = self.grid.lines_in(*tile);
            own[..own.partition_point(|other| (*other as usize) < number)].iter().copied()
        };
        lines.clear();
        // Only few lines remain, so sorting them is cheap.
        let runs_along = |other: &u32| line.runs_along(&self.lines[*other as usize], self.max_distance);
        lines.extend(tiles.iter().flat_map(before).filter(runs_along));
        if tiles.len() > 1 {
            lines.sort_unstable();
            lines.dedup();
        }
    }
}

/// Candidates near a line. The buffers are reused for the next line.
#[derive(Default)]
struct NearbyLines {
    tiles: Vec<usize>,
    lines: Vec<u32>,
}

/// Compares two coincident edges; the lesser one is kept. Of touching parts, the smaller one keeps the line.
pub(crate) fn precedence(map: &ViewMap, extents: &MeshMetrics, one: &ViewEdge, other: &ViewEdge) -> Ordering {
    let ends = |edge: &ViewEdge| [edge.start, edge.end].map(|v| map.vertices[v.index()]);
    let depth = |edge: &ViewEdge| ends(edge).iter().map(|end| end.depth).sum::<f64>();
    let end_points = |edge: &ViewEdge| {
        let mut positions = ends(edge).map(|end| [end.position.x, end.position.y]);
        positions.sort_by(|p, q| p.partial_cmp(q).unwrap_or(Ordering::Equal));
        positions
    };
    let by_depth = || depth(one).total_cmp(&depth(other));
    let by_place = || end_points(one).partial_cmp(&end_points(other)).unwrap_or(Ordering::Equal);
    let by_part = || extents.part(one.part).precedence(extents.part(other.part));
    let last = || other.segment.cmp(&one.segment);
    one.kind.cmp(&other.kind).then_with(by_depth).then_with(by_place).then_with(by_part).then_with(last)
}

/// Edges without the given ranges of each.
pub(crate) fn cut_edges(
    vertices: &mut Vec<ViewVertex>,
    edges: &[ViewEdge],
    ranges: impl Iterator<Item = Vec<(f64, f64)>>,
    within: f64,
    perspective: bool,
) -> Vec<ViewEdge> {
    let mut cut = Vec::with_capacity(edges.len());
    for (edge, mut ranges) in edges.iter().zip(ranges) {
        if ranges.is_empty() {
            cut.push(*edge);
        } else {
            cut_edge(vertices, &mut cut, edge, &mut ranges, within, perspective);
        }
    }
    cut
}

/// Appends the parts of an edge outside the given ranges.
fn cut_edge(
    vertices: &mut Vec<ViewVertex>,
    edges: &mut Vec<ViewEdge>,
    edge: &ViewEdge,
    ranges: &mut [(f64, f64)],
    within: f64,
    perspective: bool,
) {
    let (a, b) = (vertices[edge.start.index()], vertices[edge.end.index()]);
    let shortest = within / (b.position - a.position).hypot().max(within);
    let mut node = |t: f64| {
        let id = ViewVertexId(vertices.len() as u32);
        vertices.push(ViewVertex {
            position: a.position.lerp(b.position, t),
            depth: if perspective {
                1.0 / ((1.0 - t) / a.depth + t / b.depth)
            } else {
                a.depth + (b.depth - a.depth) * t
            },
            strength: a.strength + (b.strength - a.strength) * t as f32,
            kind: ViewVertexKind::TJunction,
        });
        id
    };
    ranges.sort_by(|p, q| p.0.total_cmp(&q.0));
    let mut at = 0.0;
    let mut start = edge.start;
    for &(from, to) in ranges.iter() {
        if from - at > shortest {
            edges.push(ViewEdge { start, end: node(from), ..*edge });
        }
        if to > at {
            at = to;
            start = if 1.0 - at > shortest { node(at) } else { edge.end };
        }
    }
    if 1.0 - at > shortest {
        edges.push(ViewEdge { start, end: edge.end, ..*edge });
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;
    use kurbo::Point;

    use super::*;
    use crate::lines::LineKind;
    use crate::mesh::{MaterialId, PartId};
    use crate::scene::{Camera, NamedView, Projection, UpAxis};
    use crate::surface::MeshSource;
    use crate::visibility::overlap::edge_grid::LINES_PER_TASK;

    type TestLine = ((f64, f64), (f64, f64), LineKind);

    fn frame() -> Frame {
        let camera = Camera::named(NamedView::Front, UpAxis::Y).with_frame(1000.0, 1000.0);
        Frame::new(&camera.with_projection(Projection::Orthographic { height: 1.0 }), DVec3::ZERO)
    }

    fn view_map_of(lines: &[TestLine]) -> ViewMap {
        let mut map = ViewMap::default();
        for (i, (a, b, kind)) in lines.iter().enumerate() {
            for p in [a, b] {
                let position = Point::new(p.0, p.1);
                map.vertices.push(ViewVertex {
                    position,
                    depth: 1.0,
                    strength: 1.0,
                    kind: ViewVertexKind::Vertex,
                });
            }
            map.edges.push(ViewEdge {
                start: ViewVertexId(2 * i as u32),
                end: ViewVertexId(2 * i as u32 + 1),
                kind: *kind,
                invisibility: 0,
                silhouette: false,
                both_seen: false,
                smooth: false,
                origin: MeshSource::default(),
                strength: 180.0,
                part: PartId(0),
                material: MaterialId(0),
                segment: i as u32,
            });
        }
        map
    }

    fn edge_lengths(map: &ViewMap) -> Vec<(LineKind, f64)> {
        map.edges.iter().map(|e| (e.kind, EdgeLine::of(map, e).length.round())).collect()
    }

    #[test]
    fn the_weaker_of_two_coinciding_lines_gives_way() {
        let mut m = view_map_of(&[
            ((0.0, 0.0), (100.0, 0.0), LineKind::Crease),
            ((70.0, 0.0), (30.0, 0.0), LineKind::Contour),
            ((0.0, 1.0), (100.0, 1.0), LineKind::Crease),
        ]);
        remove_coincident(&mut m, 0.005, &frame(), &MeshMetrics::default());
        let (k, c) = (LineKind::Crease, LineKind::Contour);
        assert_eq!(edge_lengths(&m), [(k, 30.0), (k, 30.0), (c, 40.0), (k, 100.0)]);
    }

    #[test]
    fn remove_coincident_keeps_the_first_of_equal_kinds_and_crossings() {
        let mut m = view_map_of(&[
            ((0.0, 0.0), (50.0, 50.0), LineKind::Crease),
            ((0.0, 50.0), (50.0, 0.0), LineKind::Crease),
            ((10.0, 10.0), (60.0, 60.0), LineKind::Crease),
        ]);
        remove_coincident(&mut m, 0.005, &frame(), &MeshMetrics::default());
        assert_eq!(edge_lengths(&m).iter().map(|l| l.1).collect::<Vec<_>>(), [71.0, 71.0, 14.0]);
    }

    #[test]
    fn remove_coincident_removes_only_duplicates_among_many_lines() {
        // Rows of short lines; the last few occur twice.
        let row = |k: usize| {
            let (x, y) = ((k % 100) as f64 * 10.0, (k / 100) as f64 * 10.0);
            ((x, y), (x + 7.0, y + 3.0), LineKind::Crease)
        };
        let count = 2 * LINES_PER_TASK + 300;
        let lines: Vec<TestLine> = (0..count).chain(count - 50..count).map(row).collect();
        let mut m = view_map_of(&lines);
        remove_coincident(&mut m, 0.005, &frame(), &MeshMetrics::default());
        assert_eq!(m.edges.len(), count);
        let left: std::collections::BTreeSet<usize> = m
            .edges
            .iter()
            .map(|e| if e.segment < count as u32 { e.segment as usize } else { e.segment as usize - 50 })
            .collect();
        assert_eq!(left.len(), count);
    }
}
