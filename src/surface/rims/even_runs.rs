//! [`EvenRuns`]: lines that turn evenly, as arcs of circles do.

use std::collections::HashSet;

use glam::{DVec3, Vec3};

use super::rim_arcs::has_known_direction;
use crate::mesh::{EdgeFaces, EdgeSet, Mesh};
use crate::surface::{EdgeArc, SmoothNormals};

/// Largest turn at a corner, degrees: that of an octagon, and a tenth of it.
const MAX_TURN_DEG: f64 = 49.5;
/// Smallest turn at a corner, degrees.
const MIN_TURN_DEG: f64 = 1.0;
/// Largest ratio of the lengths of two edges next to each other, and of the turns at their ends.
pub(super) const MAX_EVEN_RATIO: f64 = 1.1;
/// Minimum number of edges of a closed run.
const MIN_CLOSED_EDGES: usize = 8;
/// Minimum number of edges of an open run. Three even corners in a row are no chance.
const MIN_OPEN_EDGES: usize = 4;
/// Minimum cosine (6 degrees) between the planes of two turns of one run.
const MIN_PLANE_COSINE: f64 = 0.9945;
/// Maximum sine of the angle between an arc and the plane of a flat face next to it.
const MAX_OFF_PLANE_SINE: f64 = 0.02;

/// No vertex: a run starts or ends here.
const NONE: u32 = u32::MAX;

/// Edge of an even run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct EvenEdge {
    /// Edge id.
    pub edge: u32,
    /// Vertex before the edge, its two ends, and the vertex after it, along the run; `NONE` where the run
    /// starts or ends.
    around: [u32; 4],
}

impl EvenEdge {
    /// The arc over the edge, from the smaller vertex to the larger.
    pub(crate) fn arc(&self, mesh: &Mesh) -> Option<EdgeArc> {
        let [before, from, to, after] = self.around;
        let at = |v: u32| mesh.positions[v as usize];
        let along = (at(to) - at(from)).normalize_or_zero();
        // A circle leaves a chord at both ends by the same angle.
        let mirrored = |tangent: DVec3| along * (2.0 * tangent.dot(along)) - tangent;
        let known = [[before, from, to], [from, to, after]]
            .map(|points| (!points.contains(&NONE)).then(|| circle_tangent(points.map(at))));
        let tangents = match known {
            [Some(a), Some(b)] => [a, b],
            [Some(a), None] => [a, mirrored(a)],
            [None, Some(b)] => [mirrored(b), b],
            [None, None] => return None,
        };
        Some(if from < to {
            EdgeArc::with_tangents([at(from), at(to)], tangents)
        } else {
            EdgeArc::with_tangents([at(to), at(from)], [-tangents[1], -tangents[0]])
        })
    }
}

/// Unit tangent at the second of three points of a circle.
fn circle_tangent([a, b, c]: [DVec3; 3]) -> DVec3 {
    let (p, q) = (b - a, c - b);
    let (l, m) = (p.length(), q.length());
    (p * (m / l) + q * (l / m)).normalize_or_zero()
}

/// The even runs of a mesh, by edge.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct EvenRuns(pub Vec<EvenEdge>);

impl EvenRuns {
    /// Finds the even runs of borders, and of lines between surfaces whose direction no file gives, among the
    /// faces that are decided `by_evidence`.
    ///
    /// A run counts if it is a border of something curved, and if each face next to it is curved or lies in
    /// the plane of the arc.
    pub(crate) fn find(mesh: &Mesh, smooth: &SmoothNormals, by_evidence: &[bool]) -> Self {
        if smooth.is_empty() {
            return Self::default();
        }
        let lines = EdgeSet::collect(mesh.edges.len(), |edge| match mesh.edges.faces(edge) {
            EdgeFaces::One(face) => by_evidence[face as usize],
            EdgeFaces::Two { faces, .. } => {
                by_evidence[faces[0] as usize]
                    && smooth.separating_edges.contains(edge)
                    && !has_known_direction(mesh, smooth, faces)
            }
            EdgeFaces::Many(_) => false,
        });
        let graph = LineGraph::new(mesh, &lines);
        let mut done: HashSet<u32> = HashSet::new();
        let mut found = Vec::new();
        for edge in lines.iter().map(|edge| edge as u32) {
            if done.contains(&edge) {
                continue;
            }
            let run = graph.run(edge);
            done.extend(&run.edges);
            let least = if run.closed { MIN_CLOSED_EDGES } else { MIN_OPEN_EDGES };
            if run.edges.len() < least {
                continue;
            }
            let edges = run.even_edges();
            let is_curved = |even: &EvenEdge| {
                let mut faces = mesh.edges.faces(even.edge as usize).each();
                faces.any(|face| smooth.corners_of(face).is_some())
            };
            if edges.iter().any(is_curved) && edges.iter().all(|even| fits(mesh, smooth, even)) {
                found.extend(edges);
            }
        }
        found.sort_unstable_by_key(|even| even.edge);
        Self(found)
    }
}

/// Whether each face at an edge is curved, or lies in the plane of its arc.
fn fits(mesh: &Mesh, smooth: &SmoothNormals, even: &EvenEdge) -> bool {
    let Some(height) = even.arc(mesh).map(|arc| arc.height()) else { return false };
    mesh.edges.faces(even.edge as usize).each().all(|face| {
        let own = Vec3::from_array(mesh.face_normals[face as usize]).as_dvec3();
        smooth.corners_of(face).is_some() || height.dot(own).abs() <= MAX_OFF_PLANE_SINE * height.length()
    })
}

/// Even run of lines.
struct Run {
    /// Edges, in order.
    edges: Vec<u32>,
    /// Vertices along it: one more than edges, or as many if it is closed.
    vertices: Vec<u32>,
    closed: bool,
}

impl Run {
    fn even_edges(&self) -> Vec<EvenEdge> {
        let (n, count) = (self.vertices.len(), self.edges.len());
        let vertex = |k: usize, step: isize| {
            let at = k as isize + step;
            if self.closed {
                self.vertices[at.rem_euclid(n as isize) as usize]
            } else {
                usize::try_from(at).ok().and_then(|at| self.vertices.get(at)).copied().unwrap_or(NONE)
            }
        };
        (0..count)
            .map(|k| EvenEdge { edge: self.edges[k], around: [-1, 0, 1, 2].map(|s| vertex(k, s)) })
            .collect()
    }
}

/// Lines of a mesh, with the two that meet at each vertex where exactly two do.
struct LineGraph<'a> {
    mesh: &'a Mesh,
    /// Two lines at each vertex; the first is `NONE` where another number meets.
    at_vertex: Vec<[u32; 2]>,
}

impl<'a> LineGraph<'a> {
    fn new(mesh: &'a Mesh, lines: &EdgeSet) -> Self {
        let mut count = vec![0u8; mesh.positions.len()];
        let mut at_vertex = vec![[NONE; 2]; mesh.positions.len()];
        for edge in lines.iter() {
            for v in mesh.edges.vertices[edge].map(|v| v as usize) {
                if let Some(slot) = at_vertex[v].get_mut(usize::from(count[v])) {
                    *slot = edge as u32;
                }
                count[v] = count[v].saturating_add(1);
            }
        }
        for (pair, count) in at_vertex.iter_mut().zip(count) {
            if count != 2 {
                *pair = [NONE; 2];
            }
        }
        Self { mesh, at_vertex }
    }

    /// The line that continues another through a vertex.
    fn next(&self, edge: u32, vertex: u32) -> Option<u32> {
        let [a, b] = self.at_vertex[vertex as usize];
        (a != NONE).then_some(if a == edge { b } else { a })
    }

    fn other_end(&self, edge: u32, vertex: u32) -> u32 {
        let [a, b] = self.mesh.edges.vertices[edge as usize];
        if a == vertex { b } else { a }
    }

    /// The turn at a vertex between two lines, as a vector along its axis whose length is the angle, degrees.
    /// `None` if their lengths differ too much, or the turn is too large.
    fn turn(&self, first: u32, vertex: u32, second: u32) -> Option<DVec3> {
        let at = |v: u32| self.mesh.positions[v as usize];
        let p = at(vertex) - at(self.other_end(first, vertex));
        let q = at(self.other_end(second, vertex)) - at(vertex);
        let (l, m) = (p.length(), q.length());
        if l.max(m) > MAX_EVEN_RATIO * l.min(m) {
            return None;
        }
        let degrees = p.angle_between(q).to_degrees();
        (degrees < MAX_TURN_DEG).then(|| p.cross(q).normalize_or_zero() * degrees)
    }

    /// The even run that contains a line.
    fn run(&self, edge: u32) -> Run {
        let [from, to] = self.mesh.edges.vertices[edge as usize];
        let mut run = Run { edges: vec![edge], vertices: vec![from, to], closed: false };
        let mut turn = None;
        if self.extend(&mut run, &mut turn) {
            return run;
        }
        run.edges.reverse();
        run.vertices.reverse();
        turn = turn.map(|turn: DVec3| -turn);
        self.extend(&mut run, &mut turn);
        run
    }

    /// Extends a run at its end. Returns whether it closes.
    fn extend(&self, run: &mut Run, turn: &mut Option<DVec3>) -> bool {
        loop {
            let (Some(last), Some(end)) = (run.edges.last().copied(), run.vertices.last().copied()) else {
                return false;
            };
            let Some(next) = self.next(last, end) else { return false };
            let Some(own) = self.turn(last, end, next) else { return false };
            let is_even = |known: DVec3| {
                let (a, b) = (known.length(), own.length());
                a.max(b) <= MAX_EVEN_RATIO * a.min(b) && known.dot(own) >= MIN_PLANE_COSINE * a * b
            };
            if turn.is_some_and(|known| !is_even(known)) || own.length() < MIN_TURN_DEG {
                return false;
            }
            turn.get_or_insert(own);
            if next == run.edges[0] {
                run.closed = true;
                run.vertices.pop();
                return true;
            }
            run.vertices.push(self.other_end(next, end));
            run.edges.push(next);
        }
    }
}
