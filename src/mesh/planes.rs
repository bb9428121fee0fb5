//! [`Planes`]: the flats of a mesh, regions of several faces that lie in one plane.
//!
//! Machined parts have them, scans and figures do not: their triangles turn a little at almost every
//! edge.

use glam::Vec3;
use rustc_hash::FxHashMap;

use super::edge_set::EdgeSet;
use super::groups::Groups;
use super::{EdgeFaces, FaceId, Mesh};

/// The cosine above which an edge counts as flat: a tenth of a degree.
const FLAT_COSINE: f32 = 0.999_998_5;
/// Fewer faces than this in one plane are chance: two halves of a quad, three where a corner was cut.
const LEAST_FACES: u32 = 4;
/// The least area of a compact flat, as a part of its outline squared: a circle has 0.08, a square
/// 0.0625, a strip that is ten times as long as wide 0.02.
const COMPACT: f64 = 0.025;

/// The flats of a mesh.
#[derive(Debug, Clone, Default)]
pub(super) struct Planes {
    /// Edges at which the surface does not turn.
    pub flat: EdgeSet,
    groups: Groups,
    /// Of each flat, by the least of its faces, whether it is compact.
    compact: FxHashMap<u32, bool>,
}

impl Planes {
    pub fn new(mesh: &Mesh) -> Self {
        let flat = EdgeSet::collect(mesh.edges.len(), |edge| is_flat(mesh, edge));
        let groups = Groups::new(mesh.triangles.len(), |join| {
            for edge in flat.iter() {
                if let EdgeFaces::Two { faces: [a, b], .. } = mesh.edges.faces(edge) {
                    join(a, b);
                }
            }
        });
        let mut counts: FxHashMap<u32, (u32, f64)> = FxHashMap::default();
        for face in (0..mesh.triangles.len() as u32).filter(|face| groups.of(*face) != *face) {
            let count = counts.entry(groups.of(face)).or_default();
            count.0 += 1;
            count.1 += area(mesh, face);
        }
        counts.retain(|_, count| count.0 + 1 >= LEAST_FACES);
        let mut outlines: FxHashMap<u32, f64> = counts.keys().map(|first| (*first, 0.0)).collect();
        if !outlines.is_empty() {
            for edge in (0..mesh.edges.len()).filter(|edge| !flat.contains(*edge)) {
                for face in mesh.edges.faces(edge).list() {
                    if let Some(outline) = outlines.get_mut(&groups.of(*face)) {
                        let [a, b] = mesh.edges.vertices[edge].map(|v| mesh.positions[v as usize]);
                        *outline += a.distance(b);
                    }
                }
            }
        }
        let compact = counts
            .into_iter()
            .map(|(first, (_, others))| {
                let outline = outlines.get(&first).copied().unwrap_or_default();
                (first, others + area(mesh, first) >= COMPACT * outline * outline)
            })
            .collect();
        Self { flat, groups, compact }
    }

    /// The flat that a face is in, by the least of its faces.
    #[inline]
    pub fn of(&self, face: u32) -> Option<u32> {
        let first = self.groups.of(face);
        self.compact.contains_key(&first).then_some(first)
    }

    /// The same where it is no strip.
    #[inline]
    pub fn compact(&self, face: u32) -> Option<u32> {
        let first = self.groups.of(face);
        self.compact.get(&first).is_some_and(|compact| *compact).then_some(first)
    }
}

/// The area of a face, world units squared.
pub(super) fn area(mesh: &Mesh, face: u32) -> f64 {
    let [a, b, c] = mesh.corners(FaceId(face));
    (b - a).cross(c - a).length() / 2.0
}

fn is_flat(mesh: &Mesh, edge: usize) -> bool {
    let EdgeFaces::Two { faces, same_way } = mesh.edges.faces(edge) else { return false };
    let [n, m] = faces.map(|f| Vec3::from_array(mesh.face_normals[f as usize]));
    (if same_way { -n.dot(m) } else { n.dot(m) }) > FLAT_COSINE
}
