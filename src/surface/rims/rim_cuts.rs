//! [`rim_cuts`]: halves the edges of rims along their arcs, and cuts the faces next to them.
//!
//! A facet of a round cylinder or cone has a rim, a straight side and a diagonal. Its diagonal is halved with the rim, and
//! leaves its chord as the rim does. The new edges then run straight from rim to rim, and no piece of the wall
//! sticks out over the rim where the wall is seen edge-on.

use std::collections::HashMap;

use glam::DVec3;

use super::even_runs::{EvenRuns, MAX_EVEN_RATIO};
use super::rim_arcs::{has_room, rim_arc};
use crate::mesh::edges::triangle_sides::sides;
use crate::mesh::{EdgeFaces, EdgeMark, Mesh};
use crate::surface::normals::smooth_normals::NO_NORMAL;
use crate::surface::refine::mesh_splice::{KeptFaces, MeshCuts, PieceTriangle};
use crate::surface::{EdgeArc, SmoothNormals};

/// Maximum number of times an edge of a rim is halved.
const MAX_HALVINGS: u32 = 6;

/// Side of a piece that follows an arc.
#[derive(Debug, Clone, Copy)]
struct ArcSide {
    /// Vertices of the finer mesh, ascending for the edge of the mesh.
    ends: [u32; 2],
    /// From the first to the second of these.
    arc: EdgeArc,
    /// How often it is halved.
    halvings: usize,
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
    /// Whether the face is a facet with a diagonal.
    is_facet: bool,
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
    let mut diagonals: Vec<Diagonal> = Vec::new();
    for (edge, arc) in between.chain(even) {
        let Some(side) = work.halve_edge(edge, &arc, &rise_limit) else { continue };
        for face in mesh.edges.faces(edge).each() {
            at.push((face, side));
            diagonals.extend(work.diagonal(face, side, &rise_limit));
        }
    }
    if at.is_empty() {
        return None;
    }
    diagonals.sort_by_key(|diagonal| diagonal.edge);
    for own in diagonals.chunk_by(|a, b| a.edge == b.edge) {
        let edge = own[0].edge as usize;
        let beside: Vec<EdgeArc> = own.iter().map(|diagonal| diagonal.beside).collect();
        let halvings = own.iter().map(|diagonal| diagonal.halvings).max().unwrap_or(0);
        let side = work.side(
            mesh.edges.vertices[edge],
            EdgeArc::beside(mesh.ends(edge), &beside),
            halvings,
            Some(own[0].edge),
        );
        at.extend(mesh.edges.faces(edge).each().map(|face| (face, side)));
    }
    let mut facets: Vec<u32> = diagonals.iter().map(|diagonal| diagonal.face).collect();
    facets.sort_unstable();
    at.sort_unstable();
    let (mut open, mut pieces, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
    // The sides of facets are fine enough.
    let mut straight = Vec::new();
    for own in at.chunk_by(|a, b| a.0 == b.0) {
        let is_facet = facets.binary_search(&own[0].0).is_ok();
        open.push(work.face_piece(own[0].0, own, is_facet));
    }
    let kept = KeptFaces::without(mesh.triangles.len(), open.iter().map(|piece: &Piece| piece.face));
    while let Some(piece) = open.pop() {
        let parts = work.split(&piece);
        if parts.is_empty() {
            let ends = |k: usize| [piece.corners[k], piece.corners[(k + 1) % 3]];
            let is_fine = |k: &usize| piece.is_facet && piece.arcs[*k].is_some();
            straight.extend((0..3).filter(is_fine).map(ends));
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
        straight,
        edge_pieces: edges,
    })
}

/// Diagonal of a facet between two rims.
struct Diagonal {
    edge: u32,
    face: u32,
    /// Arc of the rim of a face next to it, in the direction of the edge.
    beside: EdgeArc,
    halvings: usize,
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
        Some(self.side(self.mesh.edges.vertices[edge], *arc, halvings, Some(edge as u32)))
    }

    /// The diagonal of a face whose rim is `side`, if this turns evenly: of its other sides, the one that rises
    /// too far, if there is just one.
    fn diagonal(&self, face: u32, side: usize, rise_limit: &impl Fn(DVec3) -> f64) -> Option<Diagonal> {
        let ArcSide { ends, arc, halvings, .. } = self.arcs[side];
        if !arc.is_even(MAX_EVEN_RATIO) {
            return None;
        }
        let (apex, corners) = (self.mesh.apex(face, ends)?, self.smooth.corners_of(face)?);
        let triangle = self.mesh.triangles[face as usize];
        let corner = |v: u32| Some(corners[triangle.iter().position(|own| *own == v)?]);
        // Diagonals of long facets count as straight, since they hardly turn for their length.
        let rises = |end: u32| {
            let edge = self.mesh.edges.between(apex, end)?;
            let normals = [corner(apex)?, corner(end)?].map(|corner| self.smooth.normals[corner as usize]);
            let own = EdgeArc::new([apex, end].map(|v| self.mesh.positions[v as usize]), normals);
            // Other edges may be rims.
            let is_free = matches!(self.mesh.edges.faces(edge), EdgeFaces::Two { .. })
                && !self.smooth.separating_edges.contains(edge);
            Some((edge, is_free && own.height().length() > rise_limit(own.at(0.5))))
        };
        let (edge, beside, end) = match [rises(ends[0])?, rises(ends[1])?] {
            [(edge, true), (_, false)] => (edge, arc.reversed(), ends[0]),
            [(_, false), (edge, true)] => (edge, arc, ends[1]),
            _ => return None,
        };
        // `beside` leads to the end that it shares with the diagonal.
        let beside = if apex < end { beside } else { beside.reversed() };
        Some(Diagonal { edge: edge as u32, face, beside, halvings })
    }

    /// A side that is halved along an arc. `edge` is that of the mesh.
    fn side(&mut self, ends: [u32; 2], arc: EdgeArc, halvings: usize, edge: Option<u32>) -> usize {
        let side = self.arcs.len();
        self.arcs.push(ArcSide { ends, arc, halvings, cut: None });
        self.halve(side, edge);
        side
    }

    fn halve(&mut self, side: usize, edge: Option<u32>) {
        let ArcSide { ends: [a, b], arc, halvings, .. } = self.arcs[side];
        if halvings == 0 {
            self.edges.extend(edge.map(|edge| (edge, [a, b])));
            return;
        }
        let vertex = (self.mesh.positions.len() + self.positions.len()) as u32;
        self.positions.push(arc.at(0.5));
        let half = self.arcs.len();
        self.arcs[side].cut = Some((vertex, half));
        for (ends, arc) in [[a, vertex], [vertex, b]].into_iter().zip(arc.halves()) {
            self.arcs.push(ArcSide { ends, arc, halvings: halvings - 1, cut: None });
        }
        self.halve(half, edge);
        self.halve(half + 1, edge);
    }

    /// The side between two vertices of a strip, across from the ends of two sides that bound it. `beside`
    /// leads along both in one direction, from the first vertex to the second.
    fn across(&mut self, ends: [u32; 2], beside: [Option<(usize, u32)>; 2]) -> Option<usize> {
        let [Some(a), Some(b)] = beside else { return None };
        let halvings = self.arcs[a.0].halvings.min(self.arcs[b.0].halvings);
        if halvings == 0 {
            return None;
        }
        let arcs = [a, b].map(|(side, from)| {
            let ArcSide { ends, arc, .. } = self.arcs[side];
            if ends[0] == from { arc } else { arc.reversed() }
        });
        let places = ends.map(|v| self.position(v));
        Some(self.side(ends, EdgeArc::beside(places, &arcs), halvings, None))
    }

    /// A face as a piece. `own` lists its arcs.
    fn face_piece(&self, face: u32, own: &[(u32, usize)], is_facet: bool) -> Piece {
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
            is_facet,
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
        let Piece { mut triangle, mut corners, mut marks, mut arcs, face, is_facet } = *piece;
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
            is_facet,
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
                let first = [at(0, 0), at(1, 2)];
                let side =
                    |half: Option<usize>, from: u32| half.filter(|_| is_facet).map(|half| (half, from));
                let beside = [side(first[0].0, a.0), side(first[1].0, c.0)];
                if far(a, m(1)) <= far(m(0), c) {
                    let across = (self.across([a.0, m(1).0], beside), EdgeMark::Unmarked);
                    vec![
                        corner,
                        part([a, m(0), m(1)], [first[0], inner, across]),
                        part([a, m(1), c], [across, first[1], whole(2)]),
                    ]
                } else {
                    let across = (self.across([c.0, m(0).0], beside), EdgeMark::Unmarked);
                    vec![
                        corner,
                        part([a, m(0), c], [first[0], across, whole(2)]),
                        part([m(0), m(1), c], [inner, first[1], across]),
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
