//! `marks`: edges of curved surfaces to split for a view, and edges of walls that are too thin.

use crate::parallel::prelude::*;
use glam::DVec3;

use super::wall_thickness;
use crate::mesh::Mesh;
use crate::surface::SmoothNormals;
use crate::surface::normals::smooth_normals::NO_NORMAL;

/// Maximum number of curved faces of a part that is always refined, because it is fast.
const MAX_ALWAYS_REFINED_FACES: usize = 20_000;
/// A larger part is dense enough if at most one edge in this number is marked. The rest are slivers, and
/// rebuilding the part would cost more than they show.
const DENSE_EDGES_PER_MARK: usize = 500;

/// Number of edges per task.
const EDGES_PER_TASK: usize = 1 << 12;

/// Decisions on the edges of a mesh.
pub(crate) struct EdgeMarks {
    /// Smooth vertices at the ends of the edges to split.
    pub cut: Vec<[u32; 2]>,
    /// The edges to split.
    pub edges: Vec<u32>,
    /// Edges that stay straight, ascending.
    pub thin: Vec<usize>,
}

/// Edge that may be split.
#[derive(Clone, Copy)]
struct MarkedEdge {
    edge: usize,
    /// Its smooth vertices.
    ends: [u32; 2],
}

/// Marks the edges for which `want` returns more than 1, with the conditions of
/// [`cuts`](super::subdivision::cuts).
pub(crate) fn marks(
    mesh: &Mesh,
    smooth: &SmoothNormals,
    (is_long, may): (&(impl Fn(DVec3, DVec3) -> bool + Sync), &(impl Fn([u32; 2], f64) -> bool + Sync)),
    want: &(impl Fn([DVec3; 2], [DVec3; 2]) -> f64 + Sync),
) -> EdgeMarks {
    let mark = |edge: usize| {
        let [a, b] = mesh.ends(edge);
        if smooth.gentle.contains(edge) && !may(mesh.edges.vertices[edge], a.distance_squared(b)) {
            return None;
        }
        if !is_long(a, b) || smooth.straight.contains(edge) {
            return None;
        }
        let ends = smooth.across(mesh, edge)?;
        let [a, b] = ends;
        let at = |v: u32| mesh.positions[smooth.vertices[v as usize] as usize];
        let normal = |v: u32| smooth.normals[v as usize];
        let is_far = want([at(a), at(b)], [normal(a), normal(b)]) > 1.0;
        is_far.then_some(MarkedEdge { edge, ends })
    };
    let edges =
        (0..mesh.edges.len()).into_par_iter().with_min_len(EDGES_PER_TASK).with_max_len(EDGES_PER_TASK);
    let marked = without_dense_parts(mesh, smooth, edges.filter_map(mark).collect());
    let swollen: Vec<(usize, [u32; 2])> = marked.iter().map(|m| (m.edge, m.ends)).collect();
    let thin = wall_thickness::thin(mesh, smooth, &swollen);
    let is_cut = |marked: &&MarkedEdge| thin.binary_search(&marked.edge).is_err();
    let (cut, edges) = marked.iter().filter(is_cut).map(|marked| (marked.ends, marked.edge as u32)).unzip();
    EdgeMarks { cut, edges, thin }
}

/// Removes the edges of parts that are dense enough.
fn without_dense_parts(mesh: &Mesh, smooth: &SmoothNormals, mut marked: Vec<MarkedEdge>) -> Vec<MarkedEdge> {
    if marked.is_empty() || mesh.triangles.len() <= MAX_ALWAYS_REFINED_FACES {
        return marked;
    }
    let part_of = |edge: usize| mesh.body(mesh.edges.faces(edge).list()[0]).index();
    let parts = mesh.face_part.iter().map(|part| part.index() + 1).max().unwrap_or(0);
    let (mut faces, mut wanted) = (vec![0usize; parts], vec![0usize; parts]);
    marked.iter().for_each(|marked| wanted[part_of(marked.edge)] += 1);
    let is_few = |wanted: usize, faces: usize| wanted <= faces * 3 / 2 / DENSE_EDGES_PER_MARK;
    if !wanted.iter().any(|wanted| *wanted > 0 && is_few(*wanted, mesh.triangles.len())) {
        return marked;
    }
    for (face, corners) in (0..).zip(&smooth.corners) {
        faces[mesh.body(face).index()] += usize::from(corners[0] != NO_NORMAL);
    }
    let is_dense = |part: usize| faces[part] > MAX_ALWAYS_REFINED_FACES && is_few(wanted[part], faces[part]);
    marked.retain(|marked| !is_dense(part_of(marked.edge)));
    marked
}
