//! Removal of hidden lines that the ink of other lines would cover.
//!
//! 1. Half the ink width of every edge of the map is looked up.
//! 2. For each hidden edge, the ranges that run along a visible edge within its ink are found. A line
//!    entirely in the ink of visible lines is removed; its direction does not matter.
//! 3. Hidden edges are processed in order: stronger kinds first, then lower invisibility. Each loses the
//!    ranges that run along the remaining pieces of earlier edges, so coincident hidden lines are drawn once.
//!
//! Source: ISO 128-2: where lines coincide, visible outlines and edges take precedence over hidden ones.

use std::cmp::Ordering;

use crate::geometry::numbers::ranges::joined;
use crate::parallel::prelude::*;
use kurbo::Vec2;

use super::coincident_lines::{cut_edges, precedence};
use super::edge_grid::EdgeGrid;
use super::edge_line::EdgeLine;
use super::smooth_chains::smooth_chains;
use crate::mesh::MeshMetrics;
use crate::visibility::graph::{ViewEdge, ViewMap};
use crate::visibility::tolerances::{BEHIND_INK_PX, BEHIND_INK_SINE};

/// Smallest tile side, in multiples of the widest reach. An edge within reach of a line is then in the tiles
/// of the line shifted by that reach.
const MIN_CELL_PER_REACH: f64 = 2.0;

/// A range of an edge's parameter, 0 to 1.
type ParameterRange = (f64, f64);

/// Ink of the lines on the page.
pub(crate) struct LineInk<'a> {
    /// Half the ink width of an edge, user units; 0 if it is unknown. At least [`BEHIND_INK_PX`] is used.
    pub half_width: &'a (dyn Fn(&ViewEdge) -> f64 + Sync),
    /// Sizes of the parts, which decide between parts in one place.
    pub extents: &'a MeshMetrics,
    /// Whether depth varies along a line as in perspective.
    pub perspective: bool,
    /// A px in user units.
    pub px: f64,
}

/// Removes the pieces of hidden edges that lie in the ink of other edges; `None` if there are none.
///
/// All edges of the map count as drawn.
#[must_use]
pub(crate) fn without_hidden_in_ink(map: &ViewMap, ink: &LineInk) -> Option<ViewMap> {
    let behind = find(map, ink);
    if behind.iter().all(Vec::is_empty) {
        return None;
    }
    let within = BEHIND_INK_PX * ink.px;
    let mut vertices = map.vertices.clone();
    let edges = cut_edges(&mut vertices, &map.edges, behind.into_iter(), within, ink.perspective);
    Some(ViewMap { vertices, edges, ..map.clone() })
}

/// Ranges of each edge that lie in the ink of others.
fn find(map: &ViewMap, ink: &LineInk) -> Vec<Vec<ParameterRange>> {
    let lines: Vec<EdgeLine> = map.edges.iter().map(|edge| EdgeLine::of(map, edge)).collect();
    if map.edges.iter().all(|edge| edge.invisibility == 0) {
        return vec![Vec::new(); lines.len()];
    }
    let half_width = |edge: &ViewEdge| (ink.half_width)(edge).max(BEHIND_INK_PX * ink.px);
    let reaches: Vec<f64> = map.edges.par_iter().with_min_len(256).map(half_width).collect();
    let widest = reaches.iter().copied().fold(0.0, f64::max);
    let Some(grid) = EdgeGrid::new(&lines, MIN_CELL_PER_REACH * widest) else {
        return vec![Vec::new(); lines.len()];
    };
    let search = InkSearch { map, half_widths: reaches, widest, lines, grid, ink };
    let found: Vec<NearbyEdges> = (0..map.edges.len())
        .into_par_iter()
        .with_min_len(256)
        .map(|edge| search.nearby_edges(edge))
        .collect();
    search.resolve(found)
}

/// Edges near a hidden edge.
#[derive(Default)]
struct NearbyEdges {
    /// Ranges along visible edges, within their ink.
    behind: Vec<ParameterRange>,
    /// Whether all of it lies in the ink of visible edges.
    within: bool,
    /// Hidden edges that precede it and run along it.
    preceding_hidden: Vec<u32>,
}

/// All edges of a map, in a grid of tiles.
struct InkSearch<'a> {
    map: &'a ViewMap,
    ink: &'a LineInk<'a>,
    /// Half the ink width of each edge.
    half_widths: Vec<f64>,
    widest: f64,
    /// One per edge.
    lines: Vec<EdgeLine>,
    grid: EdgeGrid,
}

impl InkSearch<'_> {
    /// Edges near an edge; none near a visible one.
    fn nearby_edges(&self, number: usize) -> NearbyEdges {
        let (edge, line) = (&self.map.edges[number], &self.lines[number]);
        if edge.invisibility == 0 || line.length == 0.0 {
            return NearbyEdges { within: edge.invisibility > 0, ..NearbyEdges::default() };
        }
        let mut found = NearbyEdges::default();
        let mut covered = Vec::new();
        for neighbour in self.candidates_near(line).into_iter().filter(|other| *other as usize != number) {
            let (other_line, reach) = (&self.lines[neighbour as usize], self.half_widths[neighbour as usize]);
            let is_visible = self.map.edges[neighbour as usize].invisibility == 0;
            if is_visible {
                covered.extend(line.within_ink_of(other_line, reach));
            }
            if !is_parallel(line, other_line) {
                continue;
            }
            let Some(range) = along(line, other_line, reach) else { continue };
            if is_visible {
                found.behind.push(range);
            } else if self.order(neighbour, number as u32).is_lt() {
                found.preceding_hidden.push(neighbour);
            }
        }
        found.within = matches!(joined(covered, 0.0).as_slice(), [(from, to)] if *from <= 0.0 && *to >= 1.0);
        found
    }

    /// Compares two coincident hidden edges; the lesser one is kept.
    fn order(&self, first: u32, second: u32) -> Ordering {
        let Self { map, ink, .. } = self;
        let [a, b] = [first, second].map(|number| &map.edges[number as usize]);
        let by_kind = a.kind.cmp(&b.kind).then(a.invisibility.cmp(&b.invisibility));
        by_kind.then_with(|| precedence(map, ink.extents, a, b)).then(first.cmp(&second))
    }

    /// Ranges that each edge loses, after those before it have lost theirs.
    fn resolve(&self, mut found: Vec<NearbyEdges>) -> Vec<Vec<ParameterRange>> {
        let mut removed_ranges: Vec<Vec<ParameterRange>> = vec![Vec::new(); found.len()];
        for line in smooth_chains(self.map) {
            if line.iter().all(|edge| found[*edge as usize].within) {
                line.iter().for_each(|edge| found[*edge as usize].behind = vec![(0.0, 1.0)]);
            }
        }
        let mut order: Vec<u32> = (0..found.len() as u32)
            .filter(|edge| {
                !(found[*edge as usize].behind.is_empty()
                    && found[*edge as usize].preceding_hidden.is_empty())
            })
            .collect();
        order.par_sort_by(|a, b| self.order(*a, *b));
        for number in order {
            let NearbyEdges { behind, preceding_hidden: earlier, .. } =
                std::mem::take(&mut found[number as usize]);
            let line = &self.lines[number as usize];
            let mut ranges = behind;
            for earlier_id in earlier {
                let (earlier_line, reach) =
                    (&self.lines[earlier_id as usize], self.half_widths[earlier_id as usize]);
                let visible_ranges = rest(&removed_ranges[earlier_id as usize]);
                ranges.extend(
                    visible_ranges
                        .into_iter()
                        .filter_map(|piece| along(line, &earlier_line.piece(piece), reach)),
                );
            }
            // Gaps shorter than the ink width are closed by the ink around them. Where lines only meet, the
            // overlap is no longer than that.
            let width = self.half_widths[number as usize] / line.length;
            let mut ranges = joined(ranges, width);
            ranges.retain(|(from, to)| to - from > width.min(0.5));
            removed_ranges[number as usize] = ranges;
        }
        removed_ranges
    }

    /// Edges that may be within reach of a line, ascending.
    ///
    /// Edges that are not parallel count only if the line is short enough to cross their ink lengthwise. The
    /// lookup is complete, because tiles are convex and wider than the reach.
    fn candidates_near(&self, line: &EdgeLine) -> Vec<u32> {
        let across = Vec2::new(-line.along.y, line.along.x) * self.widest;
        let is_short = line.length * BEHIND_INK_SINE <= 2.0 * self.widest;
        let reach = if is_short { line.along * self.widest } else { Vec2::ZERO };
        let mut candidates: Vec<u32> = Vec::new();
        self.grid.walk_beside([line.start - reach, line.end() + reach], across, |tile| {
            let is_relevant = |other: &&u32| is_short || is_parallel(line, &self.lines[**other as usize]);
            candidates.extend(self.grid.lines_in(tile).iter().filter(is_relevant));
        });
        candidates.sort_unstable();
        candidates.dedup();
        candidates
    }
}

/// Complement of sorted, disjoint ranges in the parameter range 0 to 1.
fn rest(removed: &[ParameterRange]) -> Vec<ParameterRange> {
    let mut remaining = Vec::with_capacity(removed.len() + 1);
    let mut at = 0.0;
    for (from, to) in removed.iter().copied().chain([(1.0, 1.0)]) {
        if from > at {
            remaining.push((at, from));
        }
        at = at.max(to);
    }
    remaining
}

fn is_parallel(line: &EdgeLine, other: &EdgeLine) -> bool {
    other.length > 0.0 && line.along.cross(other.along).abs() <= BEHIND_INK_SINE
}

/// Range of a line's parameter (0 to 1) along which a parallel line is within `max_distance`.
fn along(line: &EdgeLine, other: &EdgeLine, max_distance: f64) -> Option<ParameterRange> {
    let line_coordinates = |p| (line.along.dot(p - line.start), line.along.cross(p - line.start));
    let (mut a, mut b) = (line_coordinates(other.start), line_coordinates(other.end()));
    if a.0 > b.0 {
        std::mem::swap(&mut a, &mut b);
    }
    let (mut from, mut to) = (a.0.max(0.0), b.0.min(line.length));
    let slope = (b.1 - a.1) / (b.0 - a.0);
    if slope == 0.0 {
        if a.1.abs() > max_distance {
            return None;
        }
    } else {
        let reaches = |offset: f64| a.0 + (offset - a.1) / slope;
        let (p, q) = (reaches(-max_distance), reaches(max_distance));
        from = from.max(p.min(q));
        to = to.min(p.max(q));
    }
    (to > from).then(|| (from / line.length, to / line.length))
}
