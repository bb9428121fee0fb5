//! [`fillet_centre_lines`]: centre edges of fillets, kept where they form whole lines.
//!
//! On decimated meshes single edges may look like the middle of a fillet. A centre line must run along the
//! whole fillet, except for a corner at its ends.

use crate::parallel::prelude::*;
use glam::DVec3;

use super::surface_trace::SurfaceTracer;
use crate::mesh::EdgeFaces;
use crate::parallel::task_size::MIN_TASK_ITEMS;

/// Centre edge of a fillet, with the width of the fillet.
pub(crate) type CentreEdge = (usize, f64);

/// Minimum length of a line, in widths of its fillet.
const MIN_LENGTH_PER_WIDTH: f64 = 3.0;
/// Minimum length of a line, in lengths of the continuation of the fillet at both ends.
const MIN_LENGTH_PER_EXTENSION: f64 = 2.0;
/// Maximum number of edges followed from the end of a line. A longer continuation is no corner.
const MAX_EXTENSION_EDGES: usize = 64;
/// Minimum cosine (40 degrees) of the turn between consecutive edges, and of the total turn after the end of
/// a line.
const MIN_ONWARD_COSINE: f64 = 0.766;

/// The edges of `found` that belong to whole lines, ascending. `found` is a subset of `asked`; both are
/// ascending.
pub(crate) fn centre_lines(walk: &SurfaceTracer, asked: &[usize], found: &[CentreEdge]) -> Vec<usize> {
    let lines = CentreLines::new(walk, asked, found);
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
            // Follows the line to its end. A closed line has none.
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
        if length < MIN_LENGTH_PER_WIDTH * wide {
            continue;
        }
        let beyond = outside.into_iter().flatten().try_fold(0.0, |beyond, (edge, end)| {
            lines.remaining_length(edge, end, beyond, length / MIN_LENGTH_PER_EXTENSION)
        });
        if beyond.is_some() {
            stays.extend(line.iter().map(|at| found[*at].0));
        }
    }
    stays.sort_unstable();
    stays
}

/// Fillet edges by end vertex.
struct CentreLines<'a> {
    walk: &'a SurfaceTracer<'a>,
    found: &'a [CentreEdge],
    /// Vertices of the found edges with their indices, sorted; then vertices of all examined edges with their
    /// edges.
    centre_edge_ends: Vec<(u32, usize)>,
    examined_edge_ends: Vec<(u32, usize)>,
    /// Whether a crease or border ends at each vertex.
    is_on_line: Vec<bool>,
}

impl<'a> CentreLines<'a> {
    fn new(walk: &'a SurfaceTracer<'a>, asked: &[usize], found: &'a [CentreEdge]) -> Self {
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
            .with_min_len(MIN_TASK_ITEMS)
            .filter(is_line)
            .flat_map_iter(|edge| edges.vertices[edge])
            .collect();
        of_lines.into_iter().for_each(|v| is_on_line[v as usize] = true);
        Self { walk, found, centre_edge_ends: found_at, examined_edge_ends: asked_at, is_on_line }
    }

    /// The other end of an edge.
    fn far(&self, edge: usize, end: u32) -> u32 {
        let [a, b] = self.walk.mesh.edges.vertices[edge];
        if a == end { b } else { a }
    }

    /// Vector along an edge towards one of its ends.
    fn towards(&self, edge: usize, end: u32) -> DVec3 {
        let positions = &self.walk.mesh.positions;
        positions[end as usize] - positions[self.far(edge, end) as usize]
    }

    fn length(&self, edge: usize) -> f64 {
        let [a, _] = self.walk.mesh.edges.vertices[edge];
        self.towards(edge, a).length()
    }

    /// Found edges that end at a vertex, except one edge.
    fn found_at(&self, vertex: u32, edge: usize) -> impl Iterator<Item = usize> {
        at_vertex(&self.centre_edge_ends, vertex).filter(move |other| self.found[*other].0 != edge)
    }

    /// The found edge that continues an edge at one end: the only one there, if it does not turn away.
    fn next_in_line(&self, edge: usize, end: u32) -> Option<usize> {
        let mut found = self.found_at(end, edge);
        let next = found.next().filter(|_| !self.is_on_line[end as usize])?;
        (found.next().is_none() && self.onward(edge, end, self.found[next].0) > MIN_ONWARD_COSINE)
            .then_some(next)
    }

    /// Cosine of the turn from an edge to another at a vertex.
    fn onward(&self, edge: usize, end: u32, other: usize) -> f64 {
        let next = self.towards(other, self.far(other, end));
        self.towards(edge, end).normalize_or_zero().dot(next.normalize_or_zero())
    }

    /// Length of the fillet after the end of a line, until it meets another line or turns away, added to
    /// `length`. `None` if the sum exceeds `most`.
    fn remaining_length(&self, mut edge: usize, mut end: u32, mut length: f64, most: f64) -> Option<f64> {
        let convex = self.walk.is_convex(edge);
        let ahead = self.towards(edge, end).normalize_or_zero();
        for _ in 0..MAX_EXTENSION_EDGES {
            if self.is_on_line[end as usize] || self.found_at(end, edge).next().is_some() {
                return Some(length);
            }
            let onward = |other: usize| {
                let next = self.towards(other, self.far(other, end));
                (ahead.dot(next.normalize_or_zero()), other)
            };
            let next = at_vertex(&self.examined_edge_ends, end)
                .filter(|other| *other != edge && self.walk.is_convex(*other) == convex)
                .map(onward)
                .max_by(|a, b| a.0.total_cmp(&b.0));
            let Some((_, next)) = next.filter(|(onward, _)| *onward > MIN_ONWARD_COSINE) else {
                return Some(length);
            };
            length += self.length(next);
            if length > most {
                return None;
            }
            (edge, end) = (next, self.far(next, end));
        }
        None
    }
}

/// Values of a vertex in sorted pairs.
fn at_vertex(pairs: &[(u32, usize)], vertex: u32) -> impl Iterator<Item = usize> {
    let first = pairs.partition_point(|(v, _)| *v < vertex);
    pairs[first..].iter().take_while(move |(v, _)| *v == vertex).map(|(_, of)| *of)
}
