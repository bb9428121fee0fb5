//! [`Dihedral`]: the two faces that meet at an edge, and by how much the surface turns there.
//!
//! Told from geometry, not from winding alone, so that meshes of mixed winding are judged right;
//! faces without area are looked through.

use glam::DVec3;

use super::degenerate_faces::{Beyond, seen_from};
use super::normal_carriers;
use crate::geometry::numbers::portable_math::acos;
use crate::geometry::numbers::tolerance;
use crate::mesh::{EdgeFaces, EdgeMark, FaceId, Mesh};

/// Two faces with area that meet at an edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dihedral {
    /// The two faces.
    pub faces: [u32; 2],
    /// Whether both run along the edge the same way, as no well-wound surface does.
    pub same_way: bool,
    /// Cosine of the angle by which the surface turns from one face to the other: 1 where it is
    /// flat.
    pub cosine: f32,
}

impl Dihedral {
    /// The two faces of an edge; `None` at borders, where three or more faces with area meet, and
    /// at the long edge of a needle, whose short edges speak for it.
    #[inline]
    #[must_use]
    pub fn at(mesh: &Mesh, edge: usize) -> Option<Self> {
        match mesh.edges.faces(edge) {
            EdgeFaces::Two { faces, same_way } => {
                if faces.iter().any(|f| mesh.is_degenerate(FaceId(*f))) {
                    return beside_needle(mesh, edge, faces);
                }
                Some(Self::of(mesh, faces, same_way))
            }
            EdgeFaces::One(_) => None,
            EdgeFaces::Many(faces) => {
                let mut real = faces.iter().copied().filter(|f| !mesh.is_degenerate(FaceId(*f)));
                let (first, second, third) = (real.next()?, real.next()?, real.next());
                let same_way = runs_up(mesh, edge, first) == runs_up(mesh, edge, second);
                third.is_none().then(|| Self::of(mesh, [first, second], same_way))
            }
        }
    }

    /// Two faces that are known to meet.
    #[inline]
    #[must_use]
    pub fn of(mesh: &Mesh, faces: [u32; 2], same_way: bool) -> Self {
        let [a, b] = faces.map(|f| mesh.face_normals[f as usize]);
        let dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        Self { faces, same_way, cosine: if same_way { -dot } else { dot } }
    }

    /// Degrees by which the surface turns: 0 where it is flat, 180 where it folds back on itself.
    #[must_use]
    pub fn turn(&self) -> f32 {
        turn_of(self.cosine)
    }

    /// Degrees by which the surface turns for sure: the rest may come from the rounding of the corners. Limits of angles are
    /// compared with this, so that what turns by the limit itself is never above it, however it is written.
    #[must_use]
    pub fn sure_turn(&self, mesh: &Mesh) -> f32 {
        self.turn() - self.doubt(mesh)
    }

    /// Degrees by which the angle may be off.
    fn doubt(&self, mesh: &Mesh) -> f32 {
        let [a, b] = self.faces.map(|face| Self::doubt_of(mesh, face));
        (a + b) as f32
    }

    /// Degrees by which rounding may have turned the normal of a face.
    #[must_use]
    pub fn doubt_of(mesh: &Mesh, face: u32) -> f64 {
        let least = tolerance::ANGLE_DEG / 2.0;
        let rounding = mesh.extent(FaceId(face)).rounding;
        if rounding == 0.0 {
            return least;
        }
        let mut height = normal_carriers::height(&mesh.corners(FaceId(face)));
        if normal_carriers::is_narrow(height, rounding)
            && let Ok(at) = mesh.carriers.binary_search_by_key(&face, |pair| pair[0])
        {
            height = normal_carriers::height(&mesh.corners(FaceId(mesh.carriers[at][1])));
        }
        // Doubts are small, and an arc is as long as its sine there.
        least + (2.0 * rounding / height).min(1.0).to_degrees()
    }

    /// Whether the surface is flat at an edge of the mesh, within the rounding of the file: the corners of both faces that
    /// are not on the edge lie within `contact` of a plane through it.
    #[must_use]
    pub fn is_flat(&self, mesh: &Mesh, edge: usize) -> bool {
        let [first, second] = self.faces;
        let ends = mesh.edges.vertices[edge];
        let [a, b] = ends.map(|v| mesh.positions[v as usize]);
        let third = |face: u32| {
            let corner = mesh.triangles[face as usize].iter().find(|v| !ends.contains(v));
            corner.map_or(a, |v| mesh.positions[*v as usize])
        };
        // Twice the areas of both faces are their heights over the edge, and the volume is how far the second corner lies from the plane of
        // the first face, times the area of that: each times the length of the edge.
        let (across, over) = ((b - a).cross(third(first) - a), third(second) - a);
        let contact = [first, second].map(|face| mesh.extent(FaceId(face)).contact);
        let contact = contact[0].max(contact[1]);
        let (volume, area) = (across.dot(over).abs(), across.length());
        let is_near = volume <= contact * area || volume <= contact * (area + (b - a).cross(over).length());
        self.cosine > 0.0 && is_near
    }

    /// The normals of the two faces, both on the side that the first one calls outside.
    #[must_use]
    pub fn normals(&self, mesh: &Mesh) -> [DVec3; 2] {
        let [a, b] = self.faces.map(|f| DVec3::from(mesh.face_normals[f as usize].map(f64::from)));
        [a, if self.same_way { -b } else { b }]
    }
}

/// Degrees of the angle with a cosine.
#[must_use]
pub fn turn_of(cosine: f32) -> f32 {
    acos(f64::from(cosine)).to_degrees() as f32
}

/// Out of line: needles are rare.
#[cold]
fn beside_needle(mesh: &Mesh, edge: usize, faces: [u32; 2]) -> Option<Dihedral> {
    let seen = |face: u32| match seen_from(mesh, face, mesh.edges.vertices[edge]) {
        Beyond::Face(seen) => Some(seen),
        Beyond::LongEdge | Beyond::Nothing => None,
    };
    let [first, second] = [seen(faces[0])?, seen(faces[1])?];
    (first != second).then(|| Dihedral::of(mesh, [first, second], false))
}

/// Whether an edge is a diagonal of a polygon of the file that turns there, by so many degrees, too little to be folded.
#[must_use]
pub fn is_unfolded_diagonal(mark: EdgeMark, turn: f32) -> bool {
    mark == EdgeMark::Diagonal && f64::from(turn) <= tolerance::FOLDED_POLYGON_DEG
}

/// Whether a face runs along one of its edges from the smaller vertex to the larger one.
#[must_use]
pub fn runs_up(mesh: &Mesh, edge: usize, face: u32) -> bool {
    let [lo, hi] = mesh.edges.vertices[edge];
    let [a, b, c] = mesh.triangles[face as usize];
    [(a, b), (b, c), (c, a)].contains(&(lo, hi))
}

/// The mark that the file gives an edge through some of its faces; the strongest mark counts. It is a diagonal only if all of these faces
/// that have it as a side say so: a diagonal of one polygon may be a side of another.
#[must_use]
pub fn mark(mesh: &Mesh, edge: usize, faces: impl IntoIterator<Item = u32>) -> EdgeMark {
    if mesh.edge_marks.is_empty() {
        return EdgeMark::Unmarked;
    }
    let [lo, hi] = mesh.edges.vertices[edge];
    let mut strongest = None;
    for face in faces {
        let [a, b, c] = mesh.triangles[face as usize];
        for (side, (u, v)) in [(a, b), (b, c), (c, a)].into_iter().enumerate() {
            if (u.min(v), u.max(v)) != (lo, hi) {
                continue;
            }
            let mark = mesh.edge_marks[face as usize][side];
            strongest = match strongest {
                None | Some(EdgeMark::Diagonal) => Some(mark),
                Some(before) if mark == EdgeMark::Diagonal => Some(before),
                Some(before) => Some(if mark as u8 > before as u8 { mark } else { before }),
            };
        }
    }
    strongest.unwrap_or_default()
}
