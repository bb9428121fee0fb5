//! `marks`: which edges of rounded surfaces are cut for a view, and which are too thin to be.

use crate::parallel::prelude::*;
use glam::DVec3;

use super::wall_thickness;
use crate::mesh::Mesh;
use crate::surface::SmoothNormals;
use crate::surface::normals::smooth_normals::NO_NORMAL;

/// Parts up to so many rounded faces are cut in no time.
const SMALL: usize = 20_000;
/// A larger part of which no more than one edge in so many is wanted is dense enough as it is: what is
/// left are slivers, and building all of it anew would cost more than they show.
const FEW: usize = 500;

/// Only what stands out so many times as far as wanted is asked for its thickness: less is not seen.
const SWOLLEN: f64 = 6.0;

/// Edges that are asked, or passed over, together.
pub const RUN: usize = 16;

/// Runs that one task looks at.
const CHUNK: usize = 1 << 8;

/// What becomes of the edges of a mesh.
pub(crate) struct Marks {
    /// The smooth vertices at the ends of the edges to cut.
    pub cut: Vec<[u32; 2]>,
    /// These edges themselves.
    pub edges: Vec<u32>,
    /// Edges that stay straight, ascending.
    pub thin: Vec<usize>,
}

/// An edge that may be cut.
#[derive(Clone, Copy)]
struct Marked {
    edge: usize,
    /// Its smooth vertices.
    ends: [u32; 2],
    /// How much it is wanted.
    wanted: f64,
}

/// Marks the edges for which `want` says more than 1, as [`cuts`](super::subdivision::cuts) has it.
pub(crate) fn marks(
    mesh: &Mesh,
    smooth: &SmoothNormals,
    (is_asked, is_long, may): (
        &(impl Fn(usize) -> bool + Sync),
        &(impl Fn(DVec3, DVec3) -> bool + Sync),
        &(impl Fn([u32; 2], f64) -> bool + Sync),
    ),
    want: &(impl Fn([DVec3; 2], [DVec3; 2]) -> f64 + Sync),
) -> Marks {
    let mark = |edge: usize| {
        let [a, b] = mesh.edges.vertices[edge].map(|v| mesh.positions[v as usize]);
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
        let wanted = want([at(a), at(b)], [normal(a), normal(b)]);
        (wanted > 1.0).then_some(Marked { edge, ends, wanted })
    };
    let runs = mesh.edges.len().div_ceil(RUN);
    let marked: Vec<Vec<Marked>> = (0..runs.div_ceil(CHUNK))
        .into_par_iter()
        .with_max_len(1)
        .map(|k| {
            let mut marked = Vec::new();
            for run in (k * CHUNK..((k + 1) * CHUNK).min(runs)).filter(|run| is_asked(*run)) {
                marked.extend((run * RUN..((run + 1) * RUN).min(mesh.edges.len())).filter_map(mark));
            }
            marked
        })
        .collect();
    let marked = without_dense_parts(mesh, smooth, marked.concat());
    let swollen: Vec<(usize, [u32; 2])> =
        marked.iter().filter(|m| m.wanted > SWOLLEN).map(|m| (m.edge, m.ends)).collect();
    let thin = wall_thickness::thin(mesh, smooth, &swollen);
    let is_cut = |marked: &&Marked| thin.binary_search(&marked.edge).is_err();
    let (cut, edges) = marked.iter().filter(is_cut).map(|marked| (marked.ends, marked.edge as u32)).unzip();
    Marks { cut, edges, thin }
}

/// The marked edges, but for those of parts that are dense enough.
fn without_dense_parts(mesh: &Mesh, smooth: &SmoothNormals, mut marked: Vec<Marked>) -> Vec<Marked> {
    if marked.is_empty() || mesh.triangles.len() <= SMALL {
        return marked;
    }
    let part_of = |edge: usize| mesh.body(mesh.edges.faces(edge).list()[0]).index();
    let parts = mesh.face_part.iter().map(|part| part.index() + 1).max().unwrap_or(0);
    let (mut faces, mut wanted) = (vec![0usize; parts], vec![0usize; parts]);
    marked.iter().for_each(|marked| wanted[part_of(marked.edge)] += 1);
    let is_few = |wanted: usize, faces: usize| wanted <= faces * 3 / 2 / FEW;
    if !wanted.iter().any(|wanted| *wanted > 0 && is_few(*wanted, mesh.triangles.len())) {
        return marked;
    }
    for (face, corners) in (0..).zip(&smooth.corners) {
        faces[mesh.body(face).index()] += usize::from(corners[0] != NO_NORMAL);
    }
    let is_dense = |part: usize| faces[part] > SMALL && is_few(wanted[part], faces[part]);
    marked.retain(|marked| !is_dense(part_of(marked.edge)));
    marked
}
