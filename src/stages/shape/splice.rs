//! `splice`: a mesh of which some faces were cut into pieces, put together of what was kept and the pieces.
//!
//! Mostly a few faces in a hundred are cut, for one view: all else is copied as it is, run by run.

use std::ops::Range;

use glam::DVec3;

use super::SmoothNormals;
use super::refine::{Facet, Refined};
use crate::mesh::build::face_normals;
use crate::mesh::edge_set::EdgeSet;
use crate::mesh::{FaceId, Mesh};

/// Texture coordinates and colours of new corners are rounded to this part.
const UV_STEPS: f64 = 65536.0;

/// What became of the faces that were cut.
pub(super) struct Cut {
    /// All vertices, the new ones behind those of the mesh.
    pub positions: Vec<DVec3>,
    /// Normals of all smooth vertices, and the vertices these stand on.
    pub normals: Vec<DVec3>,
    pub vertices: Vec<u32>,
    pub pieces: Vec<Facet>,
}

/// The faces that stay as they are.
pub(super) struct Kept {
    runs: Vec<Range<usize>>,
    count: usize,
    of: usize,
}

impl Kept {
    /// All of so many faces but these, which ascend.
    pub fn without(of: usize, cut: impl Iterator<Item = u32>) -> Self {
        let (mut runs, mut next, mut count) = (Vec::new(), 0, of);
        for face in cut.map(|face| face as usize) {
            if next < face {
                runs.push(next..face);
            }
            next = face + 1;
            count -= 1;
        }
        if next < of {
            runs.push(next..of);
        }
        Self { runs, count, of }
    }

    /// What a list has of the faces that are kept, and `more` for the pieces; nothing if the list has nothing.
    fn carry<T: Copy>(&self, list: &[T], more: impl ExactSizeIterator<Item = T>) -> Vec<T> {
        if list.is_empty() {
            return Vec::new();
        }
        let mut carried = Vec::with_capacity(self.count + more.len());
        self.runs.iter().for_each(|run| carried.extend_from_slice(&list[run.clone()]));
        carried.extend(more);
        carried
    }

    /// The faces themselves, and `more`.
    fn hosts(&self, more: impl ExactSizeIterator<Item = u32>) -> Vec<u32> {
        let mut hosts = Vec::with_capacity(self.count + more.len());
        self.runs.iter().for_each(|run| hosts.extend(run.start as u32..run.end as u32));
        hosts.extend(more);
        hosts
    }

    /// The number that each face has among those that are kept, `u32::MAX` for the others.
    fn renamed(&self) -> Vec<u32> {
        let mut renamed = Vec::with_capacity(self.of);
        let mut next = 0;
        for run in &self.runs {
            renamed.resize(run.start, u32::MAX);
            renamed.extend(next..next + run.len() as u32);
            next += run.len() as u32;
        }
        renamed.resize(self.of, u32::MAX);
        renamed
    }
}

/// The finer mesh; `thin` are the edges of the given one that stay straight.
pub(super) fn splice(mesh: &Mesh, smooth: &SmoothNormals, thin: &[usize], kept: &Kept, cut: Cut) -> Refined {
    let pieces = &cut.pieces;
    let own = || pieces.iter().map(|piece| piece.face as usize);
    let triangles: Vec<[u32; 3]> =
        pieces.iter().map(|piece| piece.corners.map(|v| cut.vertices[v as usize])).collect();
    let scale = |piece: usize| mesh.extent(FaceId(pieces[piece].face)).scale;
    let normals = face_normals(&cut.positions, &triangles, scale);
    let (edges, ids) =
        mesh.edges.spliced(&kept.renamed(), kept.count as u32, cut.positions.len(), &triangles);
    let carried = |set: &EdgeSet| set.carried(&ids, edges.len());
    let corners = kept.carry(&smooth.corners, pieces.iter().map(|piece| piece.corners));
    let (parting, straight) =
        (carried(&smooth.parting), carried(&smooth.straight.with(thin, mesh.edges.len())));
    let (uvs, corner_uvs) = texture(mesh, kept, &cut);
    let finer = Mesh {
        uvs,
        corner_uvs,
        corner_colours: colours(mesh, kept, &cut),
        normals: mesh.normals.clone(),
        // What was cut is rounded, and has the smooth normals.
        corner_normals: kept.carry(&mesh.corner_normals, pieces.iter().map(|_| [u32::MAX; 3])),
        origin: mesh.origin,
        extents: mesh.extents.clone(),
        face_normals: kept.carry(&mesh.face_normals, normals.into_iter()),
        face_part: kept.carry(&mesh.face_part, own().map(|f| mesh.face_part[f])),
        face_material: kept.carry(&mesh.face_material, own().map(|f| mesh.face_material[f])),
        face_paint: kept.carry(&mesh.face_paint, own().map(|f| mesh.face_paint[f])),
        edge_marks: kept.carry(&mesh.edge_marks, pieces.iter().map(|piece| piece.marks)),
        triangles: kept.carry(&mesh.triangles, triangles.into_iter()),
        edges,
        positions: cut.positions,
        wires: mesh.wires.clone(),
        cleaning: mesh.cleaning,
    };
    let hosts = kept.hosts(pieces.iter().map(|piece| piece.face));
    let seamless = smooth.seamless;
    let smooth =
        SmoothNormals { normals: cut.normals, vertices: cut.vertices, corners, parting, straight, seamless };
    Refined { mesh: finer, smooth, hosts, edges: ids }
}

/// Texture coordinates of the finer mesh, and those of its corners: on a piece of a face what the face
/// has there.
fn texture(mesh: &Mesh, kept: &Kept, cut: &Cut) -> (Vec<[f32; 2]>, Vec<[u32; 3]>) {
    if mesh.corner_uvs.is_empty() {
        return (Vec::new(), Vec::new());
    }
    let mut uvs = mesh.uvs.clone();
    let of_piece = |piece: &Facet| {
        let own = mesh.corner_uvs[piece.face as usize].map(|uv| mesh.uvs.get(uv as usize).copied());
        let [Some(a), Some(b), Some(c)] = own else { return [u32::MAX; 3] };
        cut.mixed(mesh, piece, [a, b, c]).map(|uv| {
            uvs.push(uv);
            uvs.len() as u32 - 1
        })
    };
    let of_pieces: Vec<[u32; 3]> = cut.pieces.iter().map(of_piece).collect();
    (uvs, kept.carry(&mesh.corner_uvs, of_pieces.into_iter()))
}

/// The colours of the corners of the finer mesh: on a piece of a face what the face has there.
fn colours(mesh: &Mesh, kept: &Kept, cut: &Cut) -> Vec<[[f32; 3]; 3]> {
    if mesh.corner_colours.is_empty() {
        return Vec::new();
    }
    let of_piece = |piece: &Facet| cut.mixed(mesh, piece, mesh.corner_colours[piece.face as usize]);
    kept.carry(&mesh.corner_colours, cut.pieces.iter().map(of_piece))
}

impl Cut {
    /// At the corners of a piece what its face has there, of what it has at its own corners.
    fn mixed<const N: usize>(&self, mesh: &Mesh, piece: &Facet, own: [[f32; N]; 3]) -> [[f32; N]; 3] {
        piece.corners.map(|v| {
            let at = self.positions[self.vertices[v as usize] as usize];
            let weights = mesh.weights(FaceId(piece.face), at);
            std::array::from_fn(|k| {
                let exact: f64 = own.iter().zip(weights).map(|(own, w)| f64::from(own[k]) * w).sum();
                // Neighbours that see the same point from their own planes are to agree.
                ((exact * UV_STEPS).round() / UV_STEPS) as f32
            })
        })
    }
}
