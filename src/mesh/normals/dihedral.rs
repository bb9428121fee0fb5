//! [`Dihedral`]: two faces that meet at an edge, and the angle between them.
//!
//! The angle takes the direction of both faces along the edge into account, so that it is correct for mixed
//! winding. Faces without area are skipped.

use glam::DVec3;

use super::degenerate_faces::{OppositeFace, opposite_face};
use super::face_normals;
use crate::geometry::numbers::portable_math::acos;
use crate::geometry::space::triangles;
use crate::mesh::edges::triangle_sides::{runs_along, sorted_sides};
use crate::mesh::tolerances;
use crate::mesh::{EdgeFaces, EdgeMark, FaceId, Mesh};

/// Two faces with area that meet at an edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Dihedral {
    /// The two faces.
    pub faces: [u32; 2],
    /// Whether both run along the edge in the same direction, which does not occur on a consistently wound
    /// surface.
    pub same_way: bool,
    /// Cosine of the turn from one face to the other: 1 where the surface is flat.
    pub cosine: f32,
}

impl Dihedral {
    /// The two faces at an edge. `None` at borders, where three or more different faces meet, and at the long
    /// edge of a needle, which shorter edges represent.
    #[inline]
    #[must_use]
    pub(crate) fn at(mesh: &Mesh, edge: usize) -> Option<Self> {
        match mesh.edges.faces(edge) {
            EdgeFaces::Two { faces, same_way } => {
                if faces.iter().any(|f| mesh.is_degenerate(FaceId(*f))) {
                    return dihedral_across_needle(mesh, edge, faces);
                }
                Some(Self::of(mesh, faces, same_way))
            }
            EdgeFaces::One(_) => None,
            EdgeFaces::Many(faces) => {
                let [first, second] = *distinct_faces(mesh, edge, faces) else { return None };
                let same_way = runs_up(mesh, edge, first) == runs_up(mesh, edge, second);
                Some(Self::of(mesh, [first, second], same_way))
            }
        }
    }

    /// Two faces known to be adjacent.
    #[inline]
    #[must_use]
    pub(crate) fn of(mesh: &Mesh, faces: [u32; 2], same_way: bool) -> Self {
        let [a, b] = faces.map(|f| mesh.face_normals[f as usize]);
        let dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        Self { faces, same_way, cosine: if same_way { -dot } else { dot } }
    }

    /// Turn of the surface, degrees: 0 where it is flat, 180 where it folds back on itself.
    #[must_use]
    pub(crate) fn turn(&self) -> f32 {
        turn_degrees(self.cosine)
    }

    /// Turn of the surface minus its error bound, degrees. Compare angle limits with this value, so that a
    /// turn equal to the limit never exceeds it because of rounding.
    #[must_use]
    pub(crate) fn sure_turn(&self, mesh: &Mesh) -> f32 {
        self.turn() - self.angle_error(mesh)
    }

    /// Error bound of the angle, degrees.
    fn angle_error(&self, mesh: &Mesh) -> f32 {
        let [a, b] = self.faces.map(|face| Self::normal_error(mesh, face));
        (a + b) as f32
    }

    /// Error bound of a face normal due to rounding, degrees.
    #[must_use]
    pub(crate) fn normal_error(mesh: &Mesh, face: u32) -> f64 {
        let least = tolerances::DIHEDRAL_ROUNDING_DEG / 2.0;
        let rounding = mesh.extent(FaceId(face)).rounding;
        if rounding == 0.0 {
            return least;
        }
        let mut height = triangles::height(&mesh.corners(FaceId(face)));
        if face_normals::is_narrow(height, rounding)
            && let Ok(at) = mesh.carriers.binary_search_by_key(&face, |pair| pair[0])
        {
            height = triangles::height(&mesh.corners(FaceId(mesh.carriers[at][1])));
        }
        // The error is small, so the angle equals its sine.
        least + (2.0 * rounding / height).min(1.0).to_degrees()
    }

    /// Whether the surface is flat at an edge, within the rounding of the file. The opposite corners of both
    /// faces must lie within `contact` of a plane through the edge.
    #[must_use]
    pub(crate) fn is_flat(&self, mesh: &Mesh, edge: usize) -> bool {
        let [first, second] = self.faces;
        let ends = mesh.edges.vertices[edge];
        let [a, b] = mesh.ends(edge);
        let third = |face: u32| mesh.apex(face, ends).map_or(a, |v| mesh.positions[v as usize]);
        // Twice the areas of both faces are their heights over the edge, times the length of the edge. The
        // volume is the distance of the second corner from the plane of the first face, times the area of
        // that face.
        let (across, over) = ((b - a).cross(third(first) - a), third(second) - a);
        let contact = [first, second].map(|face| mesh.extent(FaceId(face)).contact);
        let contact = contact[0].max(contact[1]);
        let (volume, area) = (across.dot(over).abs(), across.length());
        let is_near = volume <= contact * area || volume <= contact * (area + (b - a).cross(over).length());
        self.cosine > 0.0 && is_near
    }

    /// The normals of the two faces, both on the front side of the first.
    #[must_use]
    pub(crate) fn normals(&self, mesh: &Mesh) -> [DVec3; 2] {
        let [a, b] = self.faces.map(|f| DVec3::from(mesh.face_normals[f as usize].map(f64::from)));
        [a, if self.same_way { -b } else { b }]
    }
}

/// Cosine (0.1 degrees) above which two faces at an edge lie in one half plane.
const MIN_SAME_COSINE: f64 = 0.999_998_5;

/// The faces with area at an edge, without those that lie in one half plane with an earlier one: of a doubled
/// surface, one layer.
pub(crate) fn distinct_faces(mesh: &Mesh, edge: usize, faces: &[u32]) -> Vec<u32> {
    let ends = mesh.edges.vertices[edge];
    let [from, to] = mesh.ends(edge);
    let away = |face: u32| {
        let apex = mesh.apex(face, ends).map_or(from, |apex| mesh.positions[apex as usize]);
        (apex - from).reject_from(to - from).normalize_or_zero()
    };
    let mut distinct: Vec<(u32, DVec3)> = Vec::new();
    for face in faces.iter().copied().filter(|face| !mesh.is_degenerate(FaceId(*face))) {
        let own = away(face);
        if !distinct.iter().any(|(_, other)| other.dot(own) > MIN_SAME_COSINE) {
            distinct.push((face, own));
        }
    }
    distinct.into_iter().map(|(face, _)| face).collect()
}

/// Angle with a cosine, degrees.
#[must_use]
pub(crate) fn turn_degrees(cosine: f32) -> f32 {
    acos(f64::from(cosine)).to_degrees() as f32
}

/// Kept out of line, because needles are rare.
#[cold]
fn dihedral_across_needle(mesh: &Mesh, edge: usize, faces: [u32; 2]) -> Option<Dihedral> {
    let seen = |face: u32| match opposite_face(mesh, face, mesh.edges.vertices[edge]) {
        OppositeFace::Face(seen) => Some(seen),
        OppositeFace::LongEdge | OppositeFace::Nothing => None,
    };
    let [first, second] = [seen(faces[0])?, seen(faces[1])?];
    (first != second).then(|| Dihedral::of(mesh, [first, second], false))
}

/// Whether an edge is a diagonal of a polygon of the file whose turn (degrees) is too small for a fold.
#[must_use]
pub(crate) fn is_unfolded_diagonal(mark: EdgeMark, turn: f32) -> bool {
    mark == EdgeMark::Diagonal && f64::from(turn) <= tolerances::FOLDED_POLYGON_DEG
}

/// Whether a face runs along one of its edges from the smaller vertex to the larger one.
#[must_use]
pub(crate) fn runs_up(mesh: &Mesh, edge: usize, face: u32) -> bool {
    runs_along(mesh.triangles[face as usize], mesh.edges.vertices[edge])
}

/// The strongest mark that the file gives an edge through some of its faces. It is a diagonal only if all of
/// these faces say so, because the diagonal of one polygon may be a side of another.
#[must_use]
pub(crate) fn mark(mesh: &Mesh, edge: usize, faces: impl IntoIterator<Item = u32>) -> EdgeMark {
    if mesh.edge_marks.is_empty() {
        return EdgeMark::Unmarked;
    }
    let ends = mesh.edges.vertices[edge];
    let mut strongest = None;
    for face in faces {
        for (side, mark) in
            sorted_sides(mesh.triangles[face as usize]).into_iter().zip(mesh.edge_marks[face as usize])
        {
            if side != ends {
                continue;
            }
            strongest = match strongest {
                None | Some(EdgeMark::Diagonal) => Some(mark),
                Some(before) if mark == EdgeMark::Diagonal => Some(before),
                Some(before) => Some(if mark as u8 > before as u8 { mark } else { before }),
            };
        }
    }
    strongest.unwrap_or_default()
}
