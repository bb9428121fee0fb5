//! [`middle_lines`]: the middle edges of roundings as lines, where these are whole.
//!
//! On thinned out meshes an edge here and there looks like the middle of a rounding. What is drawn is a line that goes as far as the
//! rounding does, but for a corner at its ends.

use crate::parallel::prelude::*;
use glam::DVec3;

use super::surface_trace::Walk;
use crate::mesh::EdgeFaces;
use crate::parallel::task_size::GRAIN;

/// An edge in the middle of a rounding, and how wide the rounding is.
pub(crate) type Middle = (usize, f64);

/// A line is longer than its rounding is wide by this factor,
const LONG: f64 = 3.0;
/// and by this one than what goes on along the rounding at both its ends.
const WHOLE: f64 = 2.0;
/// Edges that are followed from the end of a line: what takes more of them is no corner.
const MOST: usize = 64;
/// The cosine (40 degrees) of the turn by which a line goes on from one edge to another, and beyond its end in all.
const ONWARD: f64 = 0.766;

/// The edges of those found, which are some of the edges asked, that are parts of whole lines; both are ascending, as is what is left.
pub(crate) fn middle_lines(walk: &Walk, asked: &[usize], found: &[Middle]) -> Vec<usize> {
    let lines = Lines::new(walk, asked, found);
    let mut stays: Vec<usize> = Vec::new();
    let mut is_seen = vec![false; found.len()];
    for at in 0..found.len() {
        if is_seen[at] {
            continue;
        }
        is_seen[at] = true;
        let ends = walk.mesh.edges.vertices[found[at].0];
        let mut line = vec![at];
        let outside = ends.map(|end| {
            let (mut edge, mut end) = (found[at].0, end);
            // Along the line to its end, which a closed line has none of.
            loop {
                let Some(next) = lines.next_in_line(edge, end) else { break Some((edge, end)) };
                if std::mem::replace(&mut is_seen[next], true) {
                    break None;
                }
                line.push(next);
                edge = found[next].0;
                end = lines.far(edge, end);
            }
        });
        let length: f64 = line.iter().map(|at| lines.length(found[*at].0)).sum();
        let wide = line.iter().map(|at| found[*at].1).fold(0.0, f64::max);
        if length < LONG * wide {
            continue;
        }
        let beyond = outside
            .into_iter()
            .flatten()
            .try_fold(0.0, |beyond, (edge, end)| lines.beyond(edge, end, beyond, length / WHOLE));
        if beyond.is_some() {
            stays.extend(line.iter().map(|at| found[*at].0));
        }
    }
    stays.sort_unstable();
    stays
}

/// The edges of roundings by the vertices at which they end.
struct Lines<'a> {
    walk: &'a Walk<'a>,
    found: &'a [Middle],
    /// The vertices of those found with their places, ascending, and those of all edges asked with these.
    found_at: Vec<(u32, usize)>,
    asked_at: Vec<(u32, usize)>,
    /// Vertices at which creases or borders end.
    is_on_line: Vec<bool>,
}

impl<'a> Lines<'a> {
    fn new(walk: &'a Walk<'a>, asked: &[usize], found: &'a [Middle]) -> Self {
        let edges = &walk.mesh.edges;
        let mut found_at: Vec<(u32, usize)> = Vec::with_capacity(2 * found.len());
        found_at.extend((0..found.len()).flat_map(|k| edges.vertices[found[k].0].map(|v| (v, k))));
        let mut asked_at: Vec<(u32, usize)> = Vec::with_capacity(2 * asked.len());
        asked_at.extend(asked.iter().flat_map(|edge| edges.vertices[*edge].map(|v| (v, *edge))));
        found_at.sort_unstable();
        asked_at.sort_unstable();
        let mut is_on_line = vec![false; walk.mesh.positions.len()];
        let is_line =
            |edge: &usize| walk.hard.is_hard(*edge) || !matches!(edges.faces(*edge), EdgeFaces::Two { .. });
        let of_lines: Vec<u32> = (0..edges.len())
            .into_par_iter()
            .with_min_len(GRAIN)
            .filter(is_line)
            .flat_map_iter(|edge| edges.vertices[edge])
            .collect();
        of_lines.into_iter().for_each(|v| is_on_line[v as usize] = true);
        Self { walk, found, found_at, asked_at, is_on_line }
    }

    /// The other end of an edge.
    fn far(&self, edge: usize, end: u32) -> u32 {
        let [a, b] = self.walk.mesh.edges.vertices[edge];
        if a == end { b } else { a }
    }

    /// From one end of an edge to the other.
    fn towards(&self, edge: usize, end: u32) -> DVec3 {
        let positions = &self.walk.mesh.positions;
        positions[end as usize] - positions[self.far(edge, end) as usize]
    }

    fn length(&self, edge: usize) -> f64 {
        let [a, _] = self.walk.mesh.edges.vertices[edge];
        self.towards(edge, a).length()
    }

    /// Those found that end at a vertex, but for one edge.
    fn found_at(&self, vertex: u32, edge: usize) -> impl Iterator<Item = usize> {
        at_vertex(&self.found_at, vertex).filter(move |other| self.found[*other].0 != edge)
    }

    /// Which of those found goes on at one end of an edge: the only one there, if it does not turn away.
    fn next_in_line(&self, edge: usize, end: u32) -> Option<usize> {
        let mut found = self.found_at(end, edge);
        let next = found.next().filter(|_| !self.is_on_line[end as usize])?;
        (found.next().is_none() && self.onward(edge, end, self.found[next].0) > ONWARD).then_some(next)
    }

    /// The cosine of the turn from an edge to another at a vertex.
    fn onward(&self, edge: usize, end: u32, other: usize) -> f64 {
        let next = self.towards(other, self.far(other, end));
        self.towards(edge, end).normalize_or_zero().dot(next.normalize_or_zero())
    }

    /// How far the rounding goes on from the end of a line until it meets another one or turns away, in addition to so much; none if that
    /// is more than the most.
    fn beyond(&self, mut edge: usize, mut end: u32, mut length: f64, most: f64) -> Option<f64> {
        let convex = self.walk.is_convex(edge);
        let ahead = self.towards(edge, end).normalize_or_zero();
        for _ in 0..MOST {
            if self.is_on_line[end as usize] || self.found_at(end, edge).next().is_some() {
                return Some(length);
            }
            let onward = |other: usize| {
                let next = self.towards(other, self.far(other, end));
                (ahead.dot(next.normalize_or_zero()), other)
            };
            let next = at_vertex(&self.asked_at, end)
                .filter(|other| *other != edge && self.walk.is_convex(*other) == convex)
                .map(onward)
                .max_by(|a, b| a.0.total_cmp(&b.0));
            let Some((_, next)) = next.filter(|(onward, _)| *onward > ONWARD) else { return Some(length) };
            length += self.length(next);
            if length > most {
                return None;
            }
            (edge, end) = (next, self.far(next, end));
        }
        None
    }
}

/// What belongs to a vertex in sorted pairs.
fn at_vertex(pairs: &[(u32, usize)], vertex: u32) -> impl Iterator<Item = usize> {
    let first = pairs.partition_point(|(v, _)| *v < vertex);
    pairs[first..].iter().take_while(move |(v, _)| *v == vertex).map(|(_, of)| *of)
}
