//! [`face_orientations`]: the outer side of each face, where the mesh determines it.

use glam::DVec3;

use crate::geometry::lists::disjoint_sets::DisjointSets;
use crate::mesh::{EdgeFaces, FaceId, Mesh};

/// Outer side of a face.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FaceOrientation {
    /// The side of its normal.
    Front,
    /// The opposite side: the face belongs to a solid that is wound inside out.
    Back,
    /// Undetermined: the face belongs to a sheet, or to a surface with mixed winding.
    Unknown,
}

/// Largest length of the sum of area-weighted normals of a solid, as a share of its area. The sum is 0 for a
/// closed surface; a few holes are allowed.
const MAX_SOLID_NORMAL_SHARE: f64 = 0.1;

/// Share of edges with inconsistent winding above which the winding is not trusted.
const MAX_MIXED_EDGE_SHARE: f64 = 0.01;

/// Sums over a connected component of the surface.
#[derive(Debug, Clone, Copy, Default)]
struct SurfaceComponent {
    area: f64,
    normal: DVec3,
    volume: f64,
    edges: usize,
    mixed: usize,
    /// A point on it, the reference point of its volume.
    place: DVec3,
}

impl SurfaceComponent {
    fn outside(&self) -> FaceOrientation {
        if self.normal.length() > MAX_SOLID_NORMAL_SHARE * self.area
            || self.mixed as f64 > MAX_MIXED_EDGE_SHARE * self.edges as f64
        {
            FaceOrientation::Unknown
        } else if self.volume > 0.0 {
            FaceOrientation::Front
        } else if self.volume < 0.0 {
            FaceOrientation::Back
        } else {
            FaceOrientation::Unknown
        }
    }
}

/// Outer side of each face of the mesh.
pub(crate) fn face_orientations(mesh: &Mesh) -> Vec<FaceOrientation> {
    let connected = DisjointSets::new(mesh.triangles.len(), |join| {
        for edge in 0..mesh.edges.len() {
            if let EdgeFaces::Two { faces: [a, b], .. } = mesh.edges.faces(edge) {
                join(a, b);
            }
        }
    });
    let mut pieces = vec![SurfaceComponent::default(); mesh.triangles.len()];
    for face in 0..mesh.triangles.len() as u32 {
        let [a, b, c] = mesh.corners(FaceId(face));
        let piece = &mut pieces[connected.representative(face) as usize];
        // The first face of a component gives its reference point.
        if piece.area == 0.0 {
            piece.place = a;
        }
        let normal = (b - a).cross(c - a) / 2.0;
        piece.area += normal.length();
        piece.normal += normal;
        piece.volume += (a - piece.place).dot(normal);
    }
    for edge in 0..mesh.edges.len() {
        if let EdgeFaces::Two { faces, same_way } = mesh.edges.faces(edge) {
            let piece = &mut pieces[connected.representative(faces[0]) as usize];
            piece.edges += 1;
            piece.mixed += usize::from(same_way);
        }
    }
    (0..mesh.triangles.len() as u32)
        .map(|face| pieces[connected.representative(face) as usize].outside())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Soup;

    #[test]
    fn face_orientations_are_known_for_solids_and_unknown_for_sheets() {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
        let solid = [[0u32, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];
        let mut soup = Soup::default();
        // A solid, one inside out, one with mixed winding in the file, and one with a missing side.
        for kind in 0..4_u32 {
            let first = soup.positions.len() as u32;
            soup.positions.extend(corners.map(|p| p + DVec3::splat(5.0 * f64::from(kind))));
            for (k, [a, b, c]) in solid.into_iter().enumerate() {
                let flipped = kind == 1 || (kind == 2 && k == 1);
                if kind != 3 || k != 2 {
                    let t = if flipped { [a, c, b] } else { [a, b, c] };
                    soup.triangles.push(t.map(|v| v + first));
                }
            }
        }
        let found = face_orientations(&Mesh::build(soup));
        let wanted = [vec![FaceOrientation::Front; 12], vec![FaceOrientation::Unknown; 3]].concat();
        assert_eq!(found, wanted);
    }
}
