//! [`rim_cuts`]: halves the edges of rims along their arcs, and cuts the faces next to them.

use std::collections::HashMap;

use glam::DVec3;

use super::even_runs::EvenRuns;
use super::rim_arcs::{has_room, rim_arc};
use crate::mesh::edges::triangle_sides::sides;
use crate::mesh::{EdgeMark, Mesh};
use crate::surface::normals::smooth_normals::NO_NORMAL;
use crate::surface::refine::mesh_splice::{KeptFaces, MeshCuts, PieceTriangle};
use crate::surface::{EdgeArc, SmoothNormals};

/// Maximum number of times an edge of a rim is halved.
const MAX_HALVINGS: u32 = 6;

/// Side of a piece that follows a rim.
#[derive(Debug, Clone, Copy)]
struct ArcSide {
    /// Vertices of the finer mesh, ascending for the edge of the mesh.
    ends: [u32; 2],
    /// Middle vertex and index of the first half, which is followed by the second.
    cut: Option<(u32, usize)>,
}

/// Piece of a face.
#[derive(Debug, Clone, Copy)]
struct Piece {
    /// Vertices of the finer mesh.
    triangle: [u32; 3],
    /// Smooth vertices, or [`NO_NORMAL`].
    corners: [u32; 3],
    marks: [EdgeMark; 3],
    /// Arc along each side 0-1, 1-2, 2-0.
    arcs: [Option<usize>; 3],
    face: u32,
}

/// The cuts along the rims of a mesh: the lines between its surfaces, and its `even` runs. `rise_limit` is
/// the largest distance from an arc at a point. `None` if no rim needs a cut.
pub(crate) fn rim_cuts(
    mesh: &Mesh,
    smooth: &SmoothNormals,
    even: &EvenRuns,
    rise_limit: impl Fn(DVec3) -> f64,
) -> Option<MeshCuts> {
    let between =
        smooth.separating_edges.iter().filter_map(|edge| Some((edge, rim_arc(mesh, smooth, edge)?)));
    let even = even.0.iter().filter_map(|even| Some((even.edge as usize, even.arc(mesh)?)));
    let mut work = RimCuts::new(mesh, smooth);
    let mut at: Vec<(u32, usize)> = Vec::new();
    for (edge, arc) in between.chain(even) {
        let Some(side) = work.halve_edge(edge, &arc, &rise_limit) else { continue };
        at.extend(mesh.edges.faces(edge).each().map(|face| (face, side)));
    }
    if at.is_empty() {
        return None;
    }
    at.sort_unstable();
    let (mut open, mut pieces, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
    for own in at.chunk_by(|a, b| a.0 == b.0) {
        open.push(work.face_piece(own[0].0, own));
    }
    let kept = KeptFaces::without(mesh.triangles.len(), open.iter().map(|piece: &Piece| piece.face));
    while let Some(piece) = open.pop() {
        let parts = work.split(&piece);
        if parts.is_empty() {
            pieces.push(PieceTriangle { corners: piece.corners, marks: piece.marks, face: piece.face });
            triangles.push(piece.triangle);
        }
        open.extend(parts);
    }
    let RimCuts { positions, smooth_vertices, normals, edges, .. } = work;
    Some(MeshCuts {
        positions,
        vertices: smooth_vertices,
        normals,
        pieces,
        triangles,
        kept,
        thin: Vec::new(),
        straight: Vec::new(),
        edge_pieces: edges,
    })
}

struct RimCuts<'a> {
    mesh: &'a Mesh,
    smooth: &'a SmoothNormals,
    /// New vertices, numbered after those of the mesh.
    positions: Vec<DVec3>,
    /// Vertex of each new smooth vertex, and its normal; numbered after those of the mesh.
    smooth_vertices: Vec<u32>,
    normals: Vec<DVec3>,
    arcs: Vec<ArcSide>,
    /// New smooth vertex between two others.
    known: HashMap<[u32; 3], u32>,
    /// Edge of the mesh and ends of each of its pieces.
    edges: Vec<(u32, [u32; 2])>,
}

impl<'a> RimCuts<'a> {
    fn new(mesh: &'a Mesh, smooth: &'a SmoothNormals) -> Self {
        Self {
            mesh,
            smooth,
            positions: Vec::new(),
            smooth_vertices: Vec::new(),
            normals: Vec::new(),
            arcs: Vec::new(),
            known: HashMap::new(),
            edges: Vec::new(),
        }
    }

    /// Halves an edge as often as needed. Returns its arc, or `None` if it stays whole.
    fn halve_edge(
        &mut self,
        edge: usize,
        arc: &EdgeArc,
        rise_limit: &impl Fn(DVec3) -> f64,
    ) -> Option<usize> {
        let height = arc.height();
        let limit = rise_limit(arc.at(0.5));
        // Each half rises by a quarter.
        let is_far = |halvings: &u32| height.length() > limit * f64::from(1u32 << (2 * halvings));
        let halvings = (0..MAX_HALVINGS).take_while(is_far).count();
        if halvings == 0 || !has_room(self.mesh, edge, arc) {
            return None;
        }
        let first = self.arcs.len();
        self.arcs.push(ArcSide { ends: self.mesh.edges.vertices[edge], cut: None });
        self.halve(first, arc, halvings, edge as u32);
        Some(first)
    }

    fn halve(&mut self, side: usize, arc: &EdgeArc, times: usize, edge: u32) {
        let [a, b] = self.arcs[side].ends;
        if times == 0 {
            self.edges.push((edge, [a, b]));
            return;
        }
        let vertex = (self.mesh.positions.len() + self.positions.len()) as u32;
        self.positions.push(arc.at(0.5));
        let half = self.arcs.len();
        self.arcs[side].cut = Some((vertex, half));
        self.arcs.extend([[a, vertex], [vertex, b]].map(|ends| ArcSide { ends, cut: None }));
        for (k, part) in arc.halves().iter().enumerate() {
            self.halve(half + k, part, times - 1, edge);
        }
    }

    /// A face as a piece. `own` lists its arcs.
    fn face_piece(&self, face: u32, own: &[(u32, usize)]) -> Piece {
        let triangle = self.mesh.triangles[face as usize];
        let arcs = sides(triangle).map(|[a, b]| {
            let ends = [a.min(b), a.max(b)];
            own.iter().map(|(_, arc)| *arc).find(|arc| self.arcs[*arc].ends == ends)
        });
        Piece {
            triangle,
            corners: self.smooth.corners_of(face).unwrap_or([NO_NORMAL; 3]),
            marks: self.mesh.edge_marks.get(face as usize).copied().unwrap_or_default(),
            arcs,
            face,
        }
    }

    fn position(&self, v: u32) -> DVec3 {
        let v = v as usize;
        self.mesh.positions.get(v).copied().unwrap_or_else(|| self.positions[v - self.mesh.positions.len()])
    }

    fn normal(&self, v: u32) -> DVec3 {
        let v = v as usize;
        self.smooth.normals.get(v).copied().unwrap_or_else(|| self.normals[v - self.smooth.normals.len()])
    }

    /// The smooth vertex at a new vertex, between two others.
    fn smooth_vertex(&mut self, vertex: u32, [a, b]: [u32; 2]) -> u32 {
        if a == NO_NORMAL {
            return NO_NORMAL;
        }
        let key = [vertex, a.min(b), a.max(b)];
        if let Some(known) = self.known.get(&key) {
            return *known;
        }
        let ends = [key[1], key[2]];
        let normals = ends.map(|v| self.normal(v));
        let id = (self.smooth.normals.len() + self.normals.len()) as u32;
        self.normals.push((normals[0] + normals[1]).normalize_or_zero());
        self.smooth_vertices.push(vertex);
        self.known.insert(key, id);
        id
    }

    /// Cuts a piece at the middles of its arcs; empty if there are none.
    fn split(&mut self, piece: &Piece) -> Vec<Piece> {
        let cuts = piece.arcs.map(|arc| arc.and_then(|arc| self.arcs[arc].cut));
        let count = cuts.iter().flatten().count();
        if count == 0 {
            return Vec::new();
        }
        // Rotated so that side 0 is the only cut side, or side 2 the only whole one.
        let turn = match count {
            1 => cuts.iter().position(Option::is_some).unwrap_or(0),
            2 => (cuts.iter().position(Option::is_none).unwrap_or(0) + 1) % 3,
            _ => 0,
        };
        let Piece { mut triangle, mut corners, mut marks, mut arcs, face } = *piece;
        triangle.rotate_left(turn);
        corners.rotate_left(turn);
        marks.rotate_left(turn);
        arcs.rotate_left(turn);
        // Corners and middles as pairs of vertex and smooth vertex.
        let own = [0, 1, 2].map(|k| (triangle[k], corners[k]));
        let middles = [0, 1, 2].map(|k| {
            let (vertex, _) = cuts[(k + turn) % 3]?;
            Some((vertex, self.smooth_vertex(vertex, [corners[k], corners[(k + 1) % 3]])))
        });
        let half = |k: usize, end: u32| {
            let (_, first) = cuts[(k + turn) % 3]?;
            let arc = self.arcs[arcs[k]?];
            Some(first + usize::from(end != arc.ends[0]))
        };
        let m = |k: usize| middles[k].unwrap_or(own[k]);
        let inner = (None, EdgeMark::Unmarked);
        let part = |points: [(u32, u32); 3], sides: [(Option<usize>, EdgeMark); 3]| Piece {
            triangle: points.map(|p| p.0),
            corners: points.map(|p| p.1),
            marks: sides.map(|side| side.1),
            arcs: sides.map(|side| side.0),
            face,
        };
        let whole = |k: usize| (arcs[k], marks[k]);
        let at = |k: usize, end: usize| (half(k, triangle[end]), marks[k]);
        let [a, b, c] = own;
        match count {
            1 => vec![
                part([a, m(0), c], [at(0, 0), inner, whole(2)]),
                part([m(0), b, c], [at(0, 1), whole(1), inner]),
            ],
            2 => {
                let far =
                    |p: (u32, u32), q: (u32, u32)| self.position(p.0).distance_squared(self.position(q.0));
                let corner = part([m(0), b, m(1)], [at(0, 1), at(1, 1), inner]);
                if far(a, m(1)) <= far(m(0), c) {
                    vec![
                        corner,
                        part([a, m(0), m(1)], [at(0, 0), inner, inner]),
                        part([a, m(1), c], [inner, at(1, 2), whole(2)]),
                    ]
                } else {
                    vec![
                        corner,
                        part([a, m(0), c], [at(0, 0), inner, whole(2)]),
                        part([m(0), m(1), c], [inner, at(1, 2), inner]),
                    ]
                }
            }
            _ => vec![
                part([a, m(0), m(2)], [at(0, 0), inner, at(2, 0)]),
                part([m(0), b, m(1)], [at(0, 1), at(1, 1), inner]),
                part([m(2), m(1), c], [inner, at(1, 2), at(2, 2)]),
                part([m(0), m(1), m(2)], [inner; 3]),
            ],
        }
    }
}
