//! No hidden line in the ink of a visible one: what of a hidden line runs behind a visible line is left out.
//!
//! Source: ISO 128-2, where lines coincide: visible outlines and edges come before hidden ones.

use glam::DVec3;
use kurbo::Vec2;
use rayon::prelude::*;

use super::doubles::{Line, cut, vector};
use super::graph::ViewMap;
use super::grid::Grid;
use crate::math::grouped::{Grouped, grouped};
use crate::math::tolerance::{BEHIND_INK_PX, BEHIND_INK_SINE};

/// Tiles are at least this many distances wide, so that what is near a line is in the tiles of the line moved by one distance.
const CELL_OF_DISTANCE: f64 = 4.0;

/// The map without what of hidden edges runs along visible ones; `None` if nothing does. All edges of the map are drawn; `px` is a px in user units, `perspective` tells how depth runs along a line.
#[must_use]
pub fn apart(map: &ViewMap, perspective: bool, px: f64) -> Option<ViewMap> {
    let within = BEHIND_INK_PX * px;
    let behind = find(map, within);
    if behind.iter().all(Vec::is_empty) {
        return None;
    }
    let mut vertices = map.vertices.clone();
    let mut edges = Vec::with_capacity(map.edges.len());
    for (edge, mut ranges) in map.edges.iter().zip(behind) {
        if ranges.is_empty() {
            edges.push(*edge);
        } else {
            cut(&mut vertices, &mut edges, edge, &mut ranges, within, perspective);
        }
    }
    Some(ViewMap { vertices, edges, ..map.clone() })
}

/// For each edge the ranges of its parameter (0 to 1) that run along a visible one.
fn find(map: &ViewMap, within: f64) -> Vec<Vec<(f64, f64)>> {
    let lines: Vec<Line> = map.edges.iter().map(|edge| Line::of(map, edge)).collect();
    let nothing = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (low, high) = lines
        .iter()
        .map(Line::ends)
        .fold(nothing, |(low, high), [p, q]| (low.min(p).min(q), high.max(p).max(q)));
    let size = (high - low).max_element();
    if !size.is_finite() {
        return vec![Vec::new(); lines.len()];
    }
    let widest = (size / (CELL_OF_DISTANCE * within)).max(1.0) as u32;
    let across = ((lines.len() as f64).sqrt() as u32 * 2).clamp(16, 1024).min(widest);
    let grid = Grid::new(low.truncate(), high.truncate(), across);
    let in_tile = grouped(grid.len(), |put| {
        for (line, number) in lines.iter().zip(0..) {
            let [p, q] = line.ends();
            grid.walk(p, q, |tile, _, _| put(tile, number));
        }
    });
    let among = Among { map, within, lines, grid, in_tile };
    (0..map.edges.len()).into_par_iter().with_min_len(256).map(|edge| among.behind(edge)).collect()
}

/// All edges of a map, and which of them pass the tiles of a grid.
struct Among<'a> {
    map: &'a ViewMap,
    within: f64,
    /// One an edge.
    lines: Vec<Line>,
    grid: Grid,
    in_tile: Grouped<u32>,
}

impl Among<'_> {
    /// What of an edge runs behind others.
    fn behind(&self, number: usize) -> Vec<(f64, f64)> {
        let Self { map, within, lines, .. } = self;
        let (edge, line) = (&map.edges[number], &lines[number]);
        if edge.invisibility == 0 || line.length == 0.0 {
            return Vec::new();
        }
        let covers = |other: &u32| map.edges[*other as usize].invisibility == 0;
        let near = self.near(line).into_iter().filter(|other| *other as usize != number);
        let ranges = near.filter(covers).filter_map(|other| along(line, &lines[other as usize], *within));
        // Where two lines only meet, one covers nothing of the other but rounding.
        let least = (within / line.length).min(0.5);
        let mut joined = joined(ranges.collect());
        joined.retain(|(from, to)| to - from > least);
        joined
    }

    /// The edges of a line's direction that may be within reach of it, ascending: tiles are convex, and wider than the reach.
    fn near(&self, line: &Line) -> Vec<u32> {
        let across = Vec2::new(-line.along.y, line.along.x) * self.within;
        let mut near: Vec<u32> = Vec::new();
        for shift in [Vec2::ZERO, across, -across] {
            self.grid.walk(vector(line.start + shift), vector(line.end() + shift), |tile, _, _| {
                let beside = |other: &&u32| is_parallel(line, &self.lines[**other as usize]);
                near.extend(self.in_tile.of(tile).iter().filter(beside));
            });
        }
        near.sort_unstable();
        near.dedup();
        near
    }
}

fn is_parallel(line: &Line, other: &Line) -> bool {
    other.length > 0.0 && line.along.cross(other.along).abs() <= BEHIND_INK_SINE
}

/// Ranges in order, those that overlap as one.
fn joined(mut ranges: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    ranges.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut joined: Vec<(f64, f64)> = Vec::with_capacity(ranges.len());
    for (from, to) in ranges {
        match joined.last_mut() {
            Some(last) if from <= last.1 => last.1 = last.1.max(to),
            _ => joined.push((from, to)),
        }
    }
    joined
}

/// The range of a line's parameter (0 to 1) along which another, which is parallel to it, runs within `within` beside it.
fn along(line: &Line, other: &Line, within: f64) -> Option<(f64, f64)> {
    let place = |p| (line.along.dot(p - line.start), line.along.cross(p - line.start));
    let (mut a, mut b) = (place(other.start), place(other.end()));
    if a.0 > b.0 {
        std::mem::swap(&mut a, &mut b);
    }
    let (mut from, mut to) = (a.0.max(0.0), b.0.min(line.length));
    let slope = (b.1 - a.1) / (b.0 - a.0);
    if slope == 0.0 {
        if a.1.abs() > within {
            return None;
        }
    } else {
        let reaches = |offset: f64| a.0 + (offset - a.1) / slope;
        let (p, q) = (reaches(-within), reaches(within));
        from = from.max(p.min(q));
        to = to.min(p.max(q));
    }
    (to > from).then(|| (from / line.length, to / line.length))
}
