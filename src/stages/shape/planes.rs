//! [`Planes`]: the flats of a mesh, regions of several faces that lie in one plane.
//!
//! Machined parts have them, scans and figures do not: their triangles turn a little at almost every
//! edge.

use crate::mesh::edge_set::EdgeSet;
use crate::mesh::groups::Groups;
use crate::mesh::{EdgeFaces, FaceId, Mesh, Turns};

/// The cosine above which an edge counts as flat: a tenth of a degree.
const FLAT_COSINE: f32 = 0.999_998_5;
/// Fewer faces than this in one plane are chance: two halves of a quad, three where a corner was cut.
const LEAST_FACES: u32 = 4;
/// The least area of a compact flat, as a part of its outline squared: a circle has 0.08, a square
/// 0.0625, a strip that is ten times as long as wide 0.02.
const COMPACT: f64 = 0.025;

/// In [`Planes::of_face`]: the face is in no flat.
const NONE: u32 = u32::MAX;
/// In [`Planes::of_face`]: the face lies in one plane with a neighbour, but they are too few for a flat.
const FEW: u32 = u32::MAX - 1;

/// The flats of a mesh.
#[derive(Debug, Clone, Default)]
pub(super) struct Planes {
    /// Edges at which the surface does not turn.
    pub flat: EdgeSet,
    /// The number of the flat each face is in.
    of_face: Vec<u32>,
    /// Whether each flat is no strip.
    compact: Vec<bool>,
}

impl Planes {
    pub fn new(mesh: &Mesh, turns: &Turns) -> Self {
        let faces = mesh.triangles.len();
        let flat = EdgeSet::collect(mesh.edges.len(), |edge| turns.of_two(edge) > FLAT_COSINE);
        let groups = Groups::new(faces, |join| {
            for edge in flat.iter() {
                if let EdgeFaces::Two { faces: [a, b], .. } = mesh.edges.faces(edge) {
                    join(a, b);
                }
            }
        });
        let mut sizes = vec![0u32; faces];
        (0..faces as u32).for_each(|face| sizes[groups.of(face) as usize] += 1);
        // The least face of a group comes first, and its flat is numbered there.
        let mut of_face = vec![NONE; faces];
        let mut areas: Vec<f64> = Vec::new();
        for face in 0..faces as u32 {
            let first = groups.of(face) as usize;
            if sizes[first] < LEAST_FACES {
                if sizes[first] > 1 {
                    of_face[face as usize] = FEW;
                }
                continue;
            }
            if first == face as usize {
                of_face[first] = areas.len() as u32;
                areas.push(0.0);
            }
            of_face[face as usize] = of_face[first];
            areas[of_face[first] as usize] += area(mesh, face);
        }
        let mut outlines = vec![0.0; areas.len()];
        if !areas.is_empty() {
            for edge in (0..mesh.edges.len()).filter(|edge| !flat.contains(*edge)) {
                for face in mesh.edges.faces(edge).list() {
                    if let Some(outline) = outlines.get_mut(of_face[*face as usize] as usize) {
                        let [a, b] = mesh.edges.vertices[edge].map(|v| mesh.positions[v as usize]);
                        *outline += a.distance(b);
                    }
                }
            }
        }
        let is_compact = |(area, outline): (f64, f64)| area >= COMPACT * outline * outline;
        let compact = areas.into_iter().zip(outlines).map(is_compact).collect();
        Self { flat, of_face, compact }
    }

    /// The number of the flat that a face is in.
    #[inline]
    pub fn of(&self, face: u32) -> Option<u32> {
        Some(self.of_face[face as usize]).filter(|flat| *flat < FEW)
    }

    /// Whether a face lies in one plane with a neighbour.
    #[inline]
    pub fn is_level(&self, face: u32) -> bool {
        self.of_face[face as usize] != NONE
    }

    /// The flat that holds a face, unless it is a strip.
    #[inline]
    pub fn compact(&self, face: u32) -> Option<u32> {
        self.of(face).filter(|flat| self.compact[*flat as usize])
    }
}

/// The area of a face, world units squared.
pub(super) fn area(mesh: &Mesh, face: u32) -> f64 {
    let [a, b, c] = mesh.corners(FaceId(face));
    (b - a).cross(c - a).length() / 2.0
}
