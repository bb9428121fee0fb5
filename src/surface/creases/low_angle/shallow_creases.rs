//! [`shallow_creases`]: creases of machined parts below the crease angle, where the surfaces on both sides
//! end.
//!
//! A chamfer, a ramp or the tip of a drill may meet its neighbour at the same angle as two facets of a coarse
//! cylinder. The continuation across the surface distinguishes them: facets of a curve bend again by a
//! similar angle in the same direction; a surface cut at an angle does not.

use std::ops::Range;

use crate::parallel::prelude::*;

use super::surface_trace::SurfaceTracer;
use crate::geometry::numbers::portable_math::cos;
use crate::mesh::EdgeSet;
use crate::mesh::normals::dihedral::mark;
use crate::mesh::{DihedralCosines, EdgeFaces, EdgeMark, Mesh};
use crate::parallel::task_size::MIN_TASK_ITEMS;
use crate::surface::HardEdges;

/// Minimum turn of a shallow crease, as a share of the crease angle: 16 of 40 degrees.
const MIN_TURN_OF_CREASE: f64 = 0.4;

/// Maximum crease angle, degrees, for which shallow creases are sought. A larger angle requests sharp creases
/// only.
const MAX_CREASE_DEG: f64 = 40.0;

/// Possible shallow crease, with the edges where the surfaces on both sides must bend back.
type ShallowCandidate = (usize, [Option<usize>; 2]);

/// Edges, ascending, that turn by less than `crease_deg` degrees and separate surfaces that end there.
///
/// Only edges that satisfy `may` are examined. The surface is flat at edges in `flat`; edges in `hard` are
/// creases already.
pub(crate) fn shallow_creases(
    mesh: &Mesh,
    (turns, flat): (&DihedralCosines, &EdgeSet),
    crease_deg: f64,
    hard: &HardEdges,
    may: impl Fn(usize) -> bool + Sync,
) -> Vec<usize> {
    let asked = shallow_edges(mesh, turns, crease_deg, hard, may);
    if asked.is_empty() {
        return Vec::new();
    }
    let walk = SurfaceTracer::new(mesh, (turns, flat), hard, crease_deg);
    let found: Vec<ShallowCandidate> = asked
        .into_par_iter()
        .with_min_len(MIN_TASK_ITEMS >> 3)
        .filter_map(|edge| Some((edge, walk.ends_at(edge)?)))
        .collect();
    if found.is_empty() {
        return Vec::new();
    }
    consistent_candidates(mesh, &found, hard)
}

/// Edges, ascending, that turn by less than `crease_deg` degrees and by more than facets of a fine curve.
/// Only edges that satisfy `may` and have no mark in the file are examined.
pub(crate) fn shallow_edges(
    mesh: &Mesh,
    turns: &DihedralCosines,
    crease_deg: f64,
    hard: &HardEdges,
    may: impl Fn(usize) -> bool + Sync,
) -> Vec<usize> {
    if crease_deg > MAX_CREASE_DEG {
        return Vec::new();
    }
    let [least, most] = [MIN_TURN_OF_CREASE * crease_deg, crease_deg].map(|deg| cos(deg.to_radians()) as f32);
    let is_unmarked = |edge: usize| match mesh.edges.faces(edge) {
        EdgeFaces::Two { faces, .. } => mark(mesh, edge, faces) == EdgeMark::Unmarked,
        _ => true,
    };
    let is_asked = |edge: &usize| {
        let cosine = turns.at(mesh, *edge);
        cosine < least && cosine >= most && !hard.is_hard(*edge) && is_unmarked(*edge) && may(*edge)
    };
    (0..mesh.edges.len()).into_par_iter().with_min_len(MIN_TASK_ITEMS).filter(is_asked).collect()
}

/// The candidates (in edge order) that support each other. The edges where the surface must bend back must be
/// shallow creases too, and no line may end inside the surface.
fn consistent_candidates(mesh: &Mesh, found: &[ShallowCandidate], hard: &HardEdges) -> Vec<usize> {
    let vertices = |k: usize| mesh.edges.vertices[found[k].0];
    // Candidates by end vertex, and by the edges that they depend on.
    let mut ends: Vec<(u32, usize)> = (0..found.len()).flat_map(|k| vertices(k).map(|v| (v, k))).collect();
    let mut needs: Vec<(usize, usize)> = Vec::new();
    needs.extend((0..found.len()).flat_map(|k| found[k].1.into_iter().flatten().map(move |edge| (edge, k))));
    ends.sort_unstable();
    needs.sort_unstable();
    let at = |vertex: u32| equal_range(&ends, vertex);
    // Number of lines that end at each vertex: remaining candidates, creases and borders.
    let is_line =
        |edge: &usize| hard.is_hard(*edge) || !matches!(mesh.edges.faces(*edge), EdgeFaces::Two { .. });
    let of_others: Vec<usize> = (0..mesh.edges.len())
        .into_par_iter()
        .with_min_len(MIN_TASK_ITEMS)
        .filter(is_line)
        .flat_map_iter(|edge| mesh.edges.vertices[edge])
        .map(at)
        .filter(|range| !range.is_empty())
        .map(|range| range.start)
        .collect();
    let mut lines = vec![0usize; ends.len()];
    of_others.into_iter().for_each(|first| lines[first] += 1);
    ends.iter().for_each(|(vertex, _)| lines[at(*vertex).start] += 1);
    let mut stays = vec![true; found.len()];
    let mut asked: Vec<usize> = (0..found.len()).collect();
    while let Some(k) = asked.pop() {
        let is_held = |edge: usize| {
            found.binary_search_by_key(&edge, |candidate| candidate.0).is_ok_and(|at| stays[at])
        };
        let goes_on = |vertex: u32| lines[at(vertex).start] > 1;
        if !stays[k] || vertices(k).into_iter().all(goes_on) && found[k].1.into_iter().flatten().all(is_held)
        {
            continue;
        }
        stays[k] = false;
        for range in vertices(k).map(at) {
            lines[range.start] -= 1;
            // Only the last line at a vertex needs another check.
            if lines[range.start] == 1 {
                asked.extend(ends[range].iter().map(|(_, other)| *other));
            }
        }
        asked.extend(needs[equal_range(&needs, found[k].0)].iter().map(|(_, other)| *other));
    }
    found.iter().zip(stays).filter(|(_, stays)| *stays).map(|((edge, _), _)| *edge).collect()
}

/// Range of the pairs with a key, in sorted pairs.
fn equal_range<K: Ord>(pairs: &[(K, usize)], key: K) -> Range<usize> {
    let first = pairs.partition_point(|pair| pair.0 < key);
    first..first + pairs[first..].partition_point(|pair| pair.0 <= key)
}
