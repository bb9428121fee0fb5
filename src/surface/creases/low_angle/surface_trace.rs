//! [`SurfaceTracer`]: traces that cross a surface from face to face, in the plane perpendicular to a start
//! edge.
//!
//! A trace reports the edges it crosses and how far each is from the start. From these the callers decide
//! whether the start edge is one of many facet edges of a curve, or a crease.

use std::iter::Take;

use glam::{DVec3, Vec3};

use crate::geometry::numbers::portable_math::{acos, cos};
use crate::mesh::EdgeSet;
use crate::mesh::normals::dihedral::distinct_faces;
use crate::mesh::{Dihedral, DihedralCosines, EdgeFaces, Mesh, VertexEdges};
use crate::surface::HardEdges;
use crate::surface::tolerances::MIN_FLAT_COSINE;

/// Maximum number of faces that a trace crosses. After these, the surface is treated as ended.
const MAX_CROSSED_FACES: usize = 64;

/// Edge between two faces, with the angle between their normals.
#[derive(Clone, Copy)]
pub(crate) struct BentEdge {
    pub edge: usize,
    pub convex: bool,
    /// Angle between the normals of the two faces, radians.
    pub turn: f64,
}

/// A mesh with the data that traces need.
pub(crate) struct SurfaceTracer<'a> {
    pub mesh: &'a Mesh,
    pub turns: &'a DihedralCosines,
    /// Edges inside facets, where the surface is flat.
    pub flat: &'a EdgeSet,
    pub hard: &'a HardEdges,
    /// Cosine of the crease angle.
    pub(crate) crease_cosine: f32,
    /// Edges by their vertices.
    pub(crate) edges: VertexEdges<'a>,
}

impl<'a> SurfaceTracer<'a> {
    /// Indexes the edges by vertex. Creases turn by more than `crease_deg` degrees.
    pub(crate) fn new(
        mesh: &'a Mesh,
        (turns, flat): (&'a DihedralCosines, &'a EdgeSet),
        hard: &'a HardEdges,
        crease_deg: f64,
    ) -> Self {
        let most = cos(crease_deg.to_radians()) as f32;
        let edges = VertexEdges::of(&mesh.edges, mesh.positions.len());
        Self { mesh, turns, flat, hard, crease_cosine: most, edges }
    }

    /// An edge and its two faces. `None` at borders, between inconsistently wound faces, and at faces without
    /// area.
    pub(crate) fn bend(&self, edge: usize) -> Option<(BentEdge, [u32; 2])> {
        let Dihedral { faces, same_way, cosine } = self.turns.dihedral(self.mesh, edge)?;
        let ends = self.mesh.edges.vertices[edge];
        if same_way || faces.iter().any(|face| self.mesh.apex(*face, ends).is_none()) {
            return None;
        }
        let turn = acos(f64::from(cosine));
        Some((BentEdge { edge, convex: self.is_convex(edge)?, turn }, faces))
    }

    /// The edges crossed by a trace that starts at the middle of `edge`, enters `face`, and stays in the
    /// plane perpendicular to the edge. The trace ends where the surface ends. An item is `None` where the
    /// trace cannot be continued reliably, and the trace ends there too.
    pub(crate) fn crossings(&self, edge: usize, face: u32) -> Take<TraceCrossings<'_>> {
        let entry = self.mesh.edges.vertices[edge];
        let [from, to] = entry.map(|v| self.mesh.positions[v as usize]);
        TraceCrossings { walk: self, middle: (from + to) / 2.0, along: to - from, entry, face: Some(face) }
            .take(MAX_CROSSED_FACES)
    }

    /// The face behind one face at an edge. Of a doubled surface, the one in another half plane.
    pub(crate) fn beyond(&self, edge: usize, face: u32) -> Option<u32> {
        match self.mesh.edges.faces(edge) {
            EdgeFaces::One(_) => None,
            EdgeFaces::Two { faces, .. } => Some(faces[usize::from(faces[0] == face)]),
            EdgeFaces::Many(faces) => match *distinct_faces(self.mesh, edge, &[&[face], faces].concat()) {
                [_, other] => Some(other),
                _ => None,
            },
        }
    }

    /// Whether the surface is flat at an edge.
    pub(crate) fn is_flat(&self, edge: usize) -> bool {
        let is_doubled = || matches!(self.mesh.edges.faces(edge), EdgeFaces::Many(_));
        self.flat.contains(edge) || (is_doubled() && self.turns.at(self.mesh, edge) > MIN_FLAT_COSINE)
    }

    /// Whether an edge is convex, seen from the front of its faces.
    pub(crate) fn is_convex(&self, edge: usize) -> Option<bool> {
        let mesh = self.mesh;
        let Dihedral { faces: [a, b], same_way: false, .. } = self.turns.dihedral(mesh, edge)? else {
            return None;
        };
        let ends = mesh.edges.vertices[edge];
        let apex = mesh.apex(b, ends)?;
        let normal = Vec3::from_array(mesh.face_normals[a as usize]).as_dvec3();
        Some((mesh.positions[apex as usize] - mesh.positions[ends[0] as usize]).dot(normal) < 0.0)
    }
}

/// Crossing of a trace with an edge.
pub(crate) struct TraceCrossing {
    pub edge: usize,
    /// The face that the trace leaves.
    pub before: u32,
    /// Distance from the start of the trace, world units.
    pub reach: f64,
}

/// Iterator returned by [`SurfaceTracer::crossings`].
pub(crate) struct TraceCrossings<'w> {
    walk: &'w SurfaceTracer<'w>,
    middle: DVec3,
    along: DVec3,
    /// The edge crossed last, and the face behind it.
    entry: [u32; 2],
    face: Option<u32>,
}

impl TraceCrossings<'_> {
    /// Crosses one face.
    fn step(&mut self, face: u32) -> Option<TraceCrossing> {
        let mesh = self.walk.mesh;
        let along = |v: u32| (mesh.positions[v as usize] - self.middle).dot(self.along);
        let apex = mesh.apex(face, self.entry)?;
        // The end of the entry edge on the other side of the plane from the apex: the trace leaves between
        // these two.
        let kept = *self.entry.iter().find(|v| (along(**v) > 0.0) != (along(apex) > 0.0))?;
        let entry = [kept.min(apex), kept.max(apex)];
        let edge = self.walk.edges.between(entry[0], entry[1])?;
        let [p, q] = entry.map(|v| mesh.positions[v as usize]);
        let [s, t] = entry.map(along);
        let reach = p.lerp(q, (s / (s - t)).clamp(0.0, 1.0)).distance(self.middle);
        self.entry = entry;
        self.face = self.walk.beyond(edge, face);
        Some(TraceCrossing { edge, before: face, reach })
    }
}

impl Iterator for TraceCrossings<'_> {
    type Item = Option<TraceCrossing>;

    fn next(&mut self) -> Option<Self::Item> {
        let face = self.face.take()?;
        Some(self.step(face))
    }
}
