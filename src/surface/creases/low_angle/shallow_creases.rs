//! [`shallow_creases`]: edges of machined parts that turn by less than a crease, where the surfaces on both sides of them end.
//!
//! The chamfer of a plate, a ramp, the point of a drill and its shank meet at angles at which a coarse cylinder has its
//! facets as well. What tells them apart is how the surface goes on straight across: facets of a curve turn again by as much, the
//! same way; what was cut at an angle does not.

use std::ops::Range;

use crate::parallel::prelude::*;

use super::surface_trace::Walk;
use crate::geometry::numbers::portable_math::cos;
use crate::mesh::edges::edge_set::EdgeSet;
use crate::mesh::normals::dihedral::mark;
use crate::mesh::{EdgeFaces, EdgeMark, Mesh, Turns};
use crate::parallel::task_size::GRAIN;
use crate::surface::HardEdges;

/// A shallow crease turns by more than this share of the angle of a crease: 16 degrees of 40.
const SHALLOW: f64 = 0.4;

/// Who asks for creases that are sharper than by default, degrees, gets these alone.
const MOST_DEG: f64 = 40.0;

/// An edge that may be a shallow crease, with those at which the surfaces on both sides have to turn back for that.
type Candidate = (usize, [Option<usize>; 2]);

/// The edges, ascending, that turn by less than `crease_deg` degrees and part surfaces that end there. `may` says which are asked;
/// at `flat` ones the surface does not turn, and `hard` ones are creases already.
pub(crate) fn shallow_creases(
    mesh: &Mesh,
    (turns, flat): (&Turns, &EdgeSet),
    crease_deg: f64,
    hard: &HardEdges,
    may: impl Fn(usize) -> bool + Sync,
) -> Vec<usize> {
    let asked = shallow_edges(mesh, turns, crease_deg, hard, may);
    if asked.is_empty() {
        return Vec::new();
    }
    let walk = Walk::new(mesh, (turns, flat), hard, crease_deg);
    let found: Vec<Candidate> = asked
        .into_par_iter()
        .with_min_len(GRAIN >> 3)
        .filter_map(|edge| Some((edge, walk.ends_at(edge)?)))
        .collect();
    if found.is_empty() {
        return Vec::new();
    }
    settled(mesh, &found, hard)
}

/// The edges, ascending, that turn by less than `crease_deg` degrees and by more than the facets of a fine curve; `may` says which are
/// asked. Of what the file says something about it is not asked.
pub(crate) fn shallow_edges(
    mesh: &Mesh,
    turns: &Turns,
    crease_deg: f64,
    hard: &HardEdges,
    may: impl Fn(usize) -> bool + Sync,
) -> Vec<usize> {
    if crease_deg > MOST_DEG {
        return Vec::new();
    }
    let [least, most] = [SHALLOW * crease_deg, crease_deg].map(|deg| cos(deg.to_radians()) as f32);
    let is_unmarked = |edge: usize| match mesh.edges.faces(edge) {
        EdgeFaces::Two { faces, .. } => mark(mesh, edge, faces) == EdgeMark::Unmarked,
        _ => true,
    };
    let is_asked = |edge: &usize| {
        let cosine = turns.of_two(*edge);
        cosine < least && cosine >= most && !hard.is_hard(*edge) && is_unmarked(*edge) && may(*edge)
    };
    (0..mesh.edges.len()).into_par_iter().with_min_len(GRAIN).filter(is_asked).collect()
}

/// Those of the candidates, which are in order, that hold each other: where the surface has to turn back is a shallow
/// crease as well, and no line of them ends inside the surface.
fn settled(mesh: &Mesh, found: &[Candidate], hard: &HardEdges) -> Vec<usize> {
    let vertices = |k: usize| mesh.edges.vertices[found[k].0];
    // Candidates by the vertices at which they end, and by the edges where they need another.
    let mut ends: Vec<(u32, usize)> = (0..found.len()).flat_map(|k| vertices(k).map(|v| (v, k))).collect();
    let mut needs: Vec<(usize, usize)> = Vec::new();
    needs.extend((0..found.len()).flat_map(|k| found[k].1.into_iter().flatten().map(move |edge| (edge, k))));
    ends.sort_unstable();
    needs.sort_unstable();
    let at = |vertex: u32| equal_range(&ends, vertex);
    // How many lines end at each vertex: those that stay, and others, at which none ends inside the surface.
    let is_line =
        |edge: &usize| hard.is_hard(*edge) || !matches!(mesh.edges.faces(*edge), EdgeFaces::Two { .. });
    let of_others: Vec<usize> = (0..mesh.edges.len())
        .into_par_iter()
        .with_min_len(GRAIN)
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
            // The last one at a vertex is asked once more, and whoever else is there need not be.
            if lines[range.start] == 1 {
                asked.extend(ends[range].iter().map(|(_, other)| *other));
            }
        }
        asked.extend(needs[equal_range(&needs, found[k].0)].iter().map(|(_, other)| *other));
    }
    found.iter().zip(stays).filter(|(_, stays)| *stays).map(|((edge, _), _)| *edge).collect()
}

/// Where in sorted pairs those of a key lie.
fn equal_range<K: Ord>(pairs: &[(K, usize)], key: K) -> Range<usize> {
    let first = pairs.partition_point(|pair| pair.0 < key);
    first..first + pairs[first..].partition_point(|pair| pair.0 <= key)
}
