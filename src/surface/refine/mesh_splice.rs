//! `splice`: combines the kept faces of a mesh and the pieces of its cut faces into one mesh.
//!
//! Usually only a few per cent of the faces are cut for a view. The rest is copied run by run.

use std::borrow::Cow;
use std::ops::Range;

use glam::DVec3;

use crate::mesh::normals::face_normals::face_normals;
use crate::mesh::{EdgeMark, EdgeSet, Edges, FaceId, MaterialId, Mesh, Overlay, PaintId, PartId};
use crate::surface::SmoothNormals;
use crate::surface::normals::smooth_normals::NO_NORMAL;

/// Texture coordinates and colours of new corners are rounded to multiples of 1 over this.
const UV_STEPS_PER_UNIT: f64 = 65536.0;

/// Piece of a face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PieceTriangle {
    /// Its smooth vertices, or [`NO_NORMAL`] if its face is flat.
    pub corners: [u32; 3],
    /// Marks of the sides 0-1, 1-2, 2-0.
    pub marks: [EdgeMark; 3],
    /// The face of the given mesh that contains it.
    pub face: u32,
}

/// Mesh after some of its faces were cut.
#[derive(Debug, Clone)]
pub(crate) struct RefinedMesh {
    /// The finer mesh; its first vertices are those of the given one.
    pub mesh: Mesh,
    /// Its normals.
    pub smooth: SmoothNormals,
    /// The face of the given mesh that each face is or is part of. Those of kept faces ascend.
    pub hosts: Vec<u32>,
    /// Number of kept faces, which come first.
    pub kept_count: usize,
    /// For each edge of the given mesh its edge in the finer one, `u32::MAX` for edges that were cut.
    pub edges: Vec<u32>,
    /// Edges of the given mesh that are lines and were cut, each with one of its pieces.
    pub edge_pieces: Vec<(u32, usize)>,
}

/// Subdivision of a mesh: new vertices, pieces and kept faces.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct MeshCuts {
    /// Positions of the new vertices, numbered after those of the mesh.
    pub(crate) positions: Vec<DVec3>,
    /// Vertex and normal of each new smooth vertex, numbered after those of the mesh.
    pub(crate) vertices: Vec<u32>,
    pub(crate) normals: Vec<DVec3>,
    /// Pieces, and the vertices of each.
    pub(crate) pieces: Vec<PieceTriangle>,
    pub(crate) triangles: Vec<[u32; 3]>,
    pub(crate) kept: KeptFaces,
    /// Edges that stay straight.
    pub(crate) thin: Vec<usize>,
    /// Smooth vertices at the ends of new straight edges.
    pub(crate) straight: Vec<[u32; 2]>,
    /// Pieces of lines: an edge of the given mesh, and the vertices at the ends of one of its pieces.
    pub(crate) edge_pieces: Vec<(u32, [u32; 2])>,
}

/// Faces that stay unchanged.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct KeptFaces {
    runs: Vec<Range<usize>>,
    count: usize,
    of: usize,
}

impl KeptFaces {
    /// All of `of` faces except those in `cut`, ascending.
    pub(crate) fn without(of: usize, cut: impl Iterator<Item = u32>) -> Self {
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

    /// The entries of a list for the kept faces, followed by `more` for the pieces; empty if the list is
    /// empty.
    fn carry<T: Copy>(&self, list: Cow<'_, [T]>, more: impl ExactSizeIterator<Item = T>) -> Vec<T> {
        if list.is_empty() {
            return Vec::new();
        }
        let mut carried = match list {
            Cow::Borrowed(list) => {
                let mut carried = Vec::with_capacity(self.count + more.len());
                self.runs.iter().for_each(|run| carried.extend_from_slice(&list[run.clone()]));
                carried
            }
            Cow::Owned(mut list) => {
                let mut next = 0;
                for run in &self.runs {
                    list.copy_within(run.clone(), next);
                    next += run.len();
                }
                list.truncate(next);
                list.reserve_exact(more.len());
                list
            }
        };
        carried.extend(more);
        carried
    }

    /// The ids of the kept faces, followed by `more`.
    fn hosts(&self, more: impl ExactSizeIterator<Item = u32>) -> Vec<u32> {
        let mut hosts = Vec::with_capacity(self.count + more.len());
        self.runs.iter().for_each(|run| hosts.extend(run.start as u32..run.end as u32));
        hosts.extend(more);
        hosts
    }

    /// Number of kept faces before a face.
    fn before(&self, face: usize) -> usize {
        self.runs.iter().map(|run| run.end.min(face).saturating_sub(run.start)).sum()
    }

    /// The pairs of faces and carriers, ascending, where both are kept.
    fn carriers(&self, carriers: &[[u32; 2]]) -> Vec<[u32; 2]> {
        if carriers.is_empty() {
            return Vec::new();
        }
        let renamed = self.renamed();
        let pairs = carriers.iter().map(|pair| pair.map(|face| renamed[face as usize]));
        pairs.filter(|[face, carrier]| *face != u32::MAX && *carrier != u32::MAX).collect()
    }

    /// New number of each face, `u32::MAX` for cut faces.
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

/// Borrows a field, or takes it from an owned value.
macro_rules! part {
    ($of:ident, $field:ident) => {
        match &mut $of {
            Cow::Borrowed(of) => Cow::Borrowed(of.$field.as_slice()),
            Cow::Owned(of) => Cow::Owned(std::mem::take(&mut of.$field)),
        }
    };
}

/// Builds the finer mesh. An owned mesh is modified instead of copied.
pub(crate) fn splice(mut mesh: Cow<'_, Mesh>, smooth: Cow<'_, SmoothNormals>, cuts: MeshCuts) -> RefinedMesh {
    let vertex = |v: u32| match smooth.vertices.get(v as usize) {
        Some(vertex) => *vertex,
        None => cuts.vertices[v as usize - smooth.vertices.len()],
    };
    let level: Vec<[u32; 2]> = cuts.straight.iter().map(|ends| ends.map(vertex)).collect();
    let old_edges = match &mut mesh {
        Cow::Borrowed(mesh) => Cow::Borrowed(&mesh.edges),
        Cow::Owned(mesh) => Cow::Owned(std::mem::take(&mut mesh.edges)),
    };
    let [straight, separating_edges] = [&smooth.straight, &smooth.separating_edges].map(EdgeSet::clone);
    let (mut mesh, mut smooth) = of_faces(mesh, smooth, &cuts);
    mesh.edges = old_edges.updated(mesh.positions.len(), &mesh.triangles, &cuts.kept.renamed());
    let edges = new_numbers(&old_edges.vertices, &mesh.edges.vertices);
    let (before, count) = (old_edges.len(), mesh.edges.len());
    let find = |[a, b]: &[u32; 2]| mesh.edges.between(*a, *b);
    let level: Vec<usize> = level.iter().filter_map(find).collect();
    smooth.straight = straight.with(&cuts.thin, before).remapped(&edges, count).with(&level, count);
    let edge_pieces: Vec<(u32, usize)> =
        cuts.edge_pieces.iter().filter_map(|(edge, ends)| Some((*edge, find(ends)?))).collect();
    smooth.separating_edges = separating_edges.refined(&edges, &edge_pieces, count);
    let MeshCuts { pieces, kept, .. } = &cuts;
    let hosts = kept.hosts(pieces.iter().map(|piece| piece.face));
    RefinedMesh { mesh, smooth, hosts, kept_count: kept.count, edges, edge_pieces }
}

/// For each edge of a table its number in a new table, `u32::MAX` where it has none. Both are sorted.
fn new_numbers(before: &[[u32; 2]], after: &[[u32; 2]]) -> Vec<u32> {
    let mut next = 0;
    let number = |ends: &[u32; 2]| {
        while after.get(next).is_some_and(|other| other < ends) {
            next += 1;
        }
        if after.get(next) == Some(ends) { next as u32 } else { u32::MAX }
    };
    before.iter().map(number).collect()
}

/// The parts of the finer mesh and its normals that are not indexed by edge.
fn of_faces(
    mut mesh: Cow<'_, Mesh>,
    mut smooth: Cow<'_, SmoothNormals>,
    cuts: &MeshCuts,
) -> (Mesh, SmoothNormals) {
    let MeshCuts { pieces, triangles, kept, .. } = cuts;
    let own = |piece: &PieceTriangle| piece.face as usize;
    let old = mesh.positions.len();
    let at = |vertex: u32| match mesh.positions.get(vertex as usize) {
        Some(at) => *at,
        None => cuts.positions[vertex as usize - old],
    };
    let (new_uvs, corner_uvs) = texture(&mesh, pieces, triangles, at);
    let colours = colours(&mesh, pieces, triangles, at);
    let positions = extended(part!(mesh, positions), &cuts.positions);
    let scale = |piece: usize| mesh.extent(FaceId(pieces[piece].face)).scale;
    let mut normals = face_normals(&positions, triangles, scale);
    // A flat face stays flat, however narrow its pieces are.
    for (normal, piece) in normals.iter_mut().zip(pieces).filter(|(_, piece)| piece.corners[0] == NO_NORMAL) {
        *normal = mesh.face_normals[own(piece)];
    }
    let own_parts: Vec<PartId> = pieces.iter().map(|piece| mesh.face_part[own(piece)]).collect();
    let own_materials: Vec<MaterialId> = pieces.iter().map(|piece| mesh.face_material[own(piece)]).collect();
    let own_paints: Vec<PaintId> =
        pieces.iter().filter_map(|piece| mesh.face_paint.get(own(piece)).copied()).collect();
    let own_overlays: Vec<Overlay> =
        pieces.iter().filter_map(|piece| mesh.overlays.get(own(piece)).copied()).collect();
    let finer = Mesh {
        uvs: extended(part!(mesh, uvs), &new_uvs),
        corner_uvs: kept.carry(part!(mesh, corner_uvs), corner_uvs.into_iter()),
        corner_colours: kept.carry(part!(mesh, corner_colours), colours.into_iter()),
        normals: part!(mesh, normals).into_owned(),
        // Pieces are curved and use the smooth normals.
        corner_normals: kept.carry(part!(mesh, corner_normals), pieces.iter().map(|_| [u32::MAX; 3])),
        origin: mesh.origin,
        extents: mesh.extents.clone(),
        bodies: mesh.bodies.clone(),
        face_normals: kept.carry(part!(mesh, face_normals), normals.into_iter()),
        first_piece: Some(mesh.first_piece.map_or(kept.count, |first| kept.before(first as usize)) as u32),
        carriers: kept.carriers(&mesh.carriers),
        face_part: kept.carry(part!(mesh, face_part), own_parts.into_iter()),
        face_material: kept.carry(part!(mesh, face_material), own_materials.into_iter()),
        face_paint: kept.carry(part!(mesh, face_paint), own_paints.into_iter()),
        overlays: kept.carry(part!(mesh, overlays), own_overlays.into_iter()),
        edge_marks: kept.carry(part!(mesh, edge_marks), pieces.iter().map(|piece| piece.marks)),
        triangles: kept.carry(part!(mesh, triangles), triangles.iter().copied()),
        edges: Edges::default(),
        positions,
        wires: part!(mesh, wires).into_owned(),
        cleaning: mesh.cleaning,
        turned: mesh.turned.clone(),
    };
    let is_in_order = cuts.vertices.iter().copied().eq(old as u32..finer.positions.len() as u32);
    let smooth = SmoothNormals {
        vertices: extended(part!(smooth, vertices), &cuts.vertices),
        normals: extended(part!(smooth, normals), &cuts.normals),
        corners: kept.carry(part!(smooth, corners), pieces.iter().map(|piece| piece.corners)),
        separating_edges: EdgeSet::default(),
        straight: EdgeSet::default(),
        gentle: EdgeSet::default(),
        seamless: smooth.seamless && is_in_order,
    };
    (finer, smooth)
}

/// A list extended by `more`.
fn extended<T: Copy>(list: Cow<'_, [T]>, more: &[T]) -> Vec<T> {
    match list {
        Cow::Borrowed(list) => [list, more].concat(),
        Cow::Owned(mut list) => {
            list.reserve_exact(more.len());
            list.extend_from_slice(more);
            list
        }
    }
}

/// Texture coordinates at the corners of the pieces, interpolated in their faces. Returns the new
/// coordinates, and for each corner an index into the old ones followed by the new ones.
fn texture(
    mesh: &Mesh,
    pieces: &[PieceTriangle],
    triangles: &[[u32; 3]],
    at: impl Fn(u32) -> DVec3,
) -> (Vec<[f32; 2]>, Vec<[u32; 3]>) {
    if mesh.corner_uvs.is_empty() {
        return (Vec::new(), Vec::new());
    }
    let mut uvs: Vec<[f32; 2]> = Vec::new();
    let of_piece = |(piece, triangle): (&PieceTriangle, &[u32; 3])| {
        let own = mesh.corner_uvs[piece.face as usize].map(|uv| mesh.uvs.get(uv as usize).copied());
        let [Some(a), Some(b), Some(c)] = own else { return [u32::MAX; 3] };
        mixed(mesh, piece.face, triangle.map(&at), [a, b, c]).map(|uv| {
            uvs.push(uv);
            (mesh.uvs.len() + uvs.len()) as u32 - 1
        })
    };
    let corner_uvs = pieces.iter().zip(triangles).map(of_piece).collect();
    (uvs, corner_uvs)
}

/// Colours at the corners of the pieces, interpolated in their faces.
fn colours(
    mesh: &Mesh,
    pieces: &[PieceTriangle],
    triangles: &[[u32; 3]],
    at: impl Fn(u32) -> DVec3,
) -> Vec<[[f32; 3]; 3]> {
    if mesh.corner_colours.is_empty() {
        return Vec::new();
    }
    let of_piece = |(piece, triangle): (&PieceTriangle, &[u32; 3])| {
        mixed(mesh, piece.face, triangle.map(&at), mesh.corner_colours[piece.face as usize])
    };
    pieces.iter().zip(triangles).map(of_piece).collect()
}

/// Values at points of a face, interpolated from the values at its corners.
fn mixed<const N: usize>(mesh: &Mesh, face: u32, points: [DVec3; 3], own: [[f32; N]; 3]) -> [[f32; N]; 3] {
    points.map(|at| {
        let weights = mesh.weights(FaceId(face), at);
        std::array::from_fn(|k| {
            let exact: f64 = own.iter().zip(weights).map(|(own, w)| f64::from(own[k]) * w).sum();
            // Rounded, so that neighbours agree on a point that they interpolate in different planes.
            ((exact * UV_STEPS_PER_UNIT).round() / UV_STEPS_PER_UNIT) as f32
        })
    })
}
