//! [`Walk`]: over a surface from face to face, straight across from an edge.

use std::iter::Take;

use glam::{DVec3, Vec3};

use crate::geometry::numbers::portable_math::{acos, cos};
use crate::mesh::edges::edge_set::EdgeSet;
use crate::mesh::{EdgeFaces, FaceId, Mesh, Turns};
use crate::surface::HardEdges;

/// Faces that are crossed at most: what is level for longer is taken to end.
const MOST: usize = 64;

/// An edge between two faces at which the surface turns.
#[derive(Clone, Copy)]
pub(crate) struct Bend {
    pub edge: usize,
    pub convex: bool,
    /// Radians.
    pub turn: f64,
}

/// What a walk over the surface needs.
pub(crate) struct Walk<'a> {
    pub mesh: &'a Mesh,
    pub turns: &'a Turns,
    /// Edges at which faces are of one facet.
    pub flat: &'a EdgeSet,
    pub hard: &'a HardEdges,
    /// The cosine of a crease.
    pub most: f32,
    /// For each vertex the first edge that has no lower one.
    first: Vec<u32>,
}

impl<'a> Walk<'a> {
    /// Made ready to look edges up, by one pass over them; creases turn by more than `crease_deg` degrees.
    pub fn new(
        mesh: &'a Mesh,
        (turns, flat): (&'a Turns, &'a EdgeSet),
        hard: &'a HardEdges,
        crease_deg: f64,
    ) -> Self {
        let most = cos(crease_deg.to_radians()) as f32;
        let mut first = vec![0u32; mesh.positions.len() + 1];
        for [a, _] in &mesh.edges.vertices {
            first[*a as usize + 1] += 1;
        }
        for v in 1..first.len() {
            first[v] += first[v - 1];
        }
        Self { mesh, turns, flat, hard, most, first }
    }

    /// The edge between two vertices, which are in ascending order.
    pub fn edge(&self, ends: [u32; 2]) -> Option<usize> {
        let vertex = ends[0] as usize;
        let [from, to] = [self.first[vertex], self.first[vertex + 1]].map(|edge| edge as usize);
        let of_vertex = &self.mesh.edges.vertices[from..to];
        of_vertex.binary_search_by_key(&ends[1], |[_, b]| *b).ok().map(|at| from + at)
    }

    /// The face on the other side of an edge.
    pub fn over(&self, edge: usize, face: u32) -> Option<u32> {
        match self.mesh.edges.faces(edge) {
            EdgeFaces::Two { faces, same_way: false } => Some(faces[usize::from(faces[0] == face)]),
            _ => None,
        }
    }

    /// An edge and its faces; none where the surface does not go on from one face to another as it lies, or has no area.
    pub fn bend(&self, edge: usize) -> Option<(Bend, [u32; 2])> {
        let EdgeFaces::Two { faces, same_way } = self.mesh.edges.faces(edge) else { return None };
        if same_way || faces.iter().any(|face| self.mesh.is_degenerate(FaceId(*face))) {
            return None;
        }
        let turn = acos(f64::from(self.turns.of_two(edge)));
        Some((Bend { edge, convex: self.is_convex(edge)?, turn }, faces))
    }

    /// The edges that are crossed by a way that begins in the middle of an edge, goes over one of its faces and stays in the
    /// plane square to the edge, until the surface ends; none for what cannot be told, where it ends too.
    pub fn crossings(&self, edge: usize, face: u32) -> Take<Crossings<'_>> {
        let entry = self.mesh.edges.vertices[edge];
        let [from, to] = entry.map(|v| self.mesh.positions[v as usize]);
        Crossings { walk: self, middle: (from + to) / 2.0, along: to - from, entry, face: Some(face) }
            .take(MOST)
    }

    /// Whether the surface bends away at an edge as seen from the front of its faces.
    pub fn is_convex(&self, edge: usize) -> Option<bool> {
        let mesh = self.mesh;
        let EdgeFaces::Two { faces: [a, b], same_way: false } = mesh.edges.faces(edge) else { return None };
        let ends = mesh.edges.vertices[edge];
        let apex = *mesh.triangles[b as usize].iter().find(|v| !ends.contains(v))?;
        let normal = Vec3::from_array(mesh.face_normals[a as usize]).as_dvec3();
        Some((mesh.positions[apex as usize] - mesh.positions[ends[0] as usize]).dot(normal) < 0.0)
    }
}

/// Where a way straight across a surface crosses an edge.
pub(crate) struct Crossing {
    pub edge: usize,
    /// The face that it comes from.
    pub before: u32,
    /// How far away from where it began.
    pub reach: f64,
}

/// What [`Walk::crossings`] finds.
pub(crate) struct Crossings<'w> {
    walk: &'w Walk<'w>,
    middle: DVec3,
    along: DVec3,
    /// The edge that was crossed last, and the face behind it.
    entry: [u32; 2],
    face: Option<u32>,
}

impl Crossings<'_> {
    /// Over a face.
    fn step(&mut self, face: u32) -> Option<Crossing> {
        let mesh = self.walk.mesh;
        let along = |v: u32| (mesh.positions[v as usize] - self.middle).dot(self.along);
        let apex = *mesh.triangles[face as usize].iter().find(|v| !self.entry.contains(v))?;
        // The side of the entry that the plane square to the edge passes between, with the apex.
        let kept = *self.entry.iter().find(|v| (along(**v) > 0.0) != (along(apex) > 0.0))?;
        let entry = [kept.min(apex), kept.max(apex)];
        let edge = self.walk.edge(entry)?;
        let [p, q] = entry.map(|v| mesh.positions[v as usize]);
        let [s, t] = entry.map(along);
        let reach = p.lerp(q, (s / (s - t)).clamp(0.0, 1.0)).distance(self.middle);
        self.entry = entry;
        if let EdgeFaces::Two { faces, .. } = mesh.edges.faces(edge) {
            self.face = Some(faces[usize::from(faces[0] == face)]);
        }
        Some(Crossing { edge, before: face, reach })
    }
}

impl Iterator for Crossings<'_> {
    type Item = Option<Crossing>;

    fn next(&mut self) -> Option<Self::Item> {
        let face = self.face.take()?;
        Some(self.step(face))
    }
}
