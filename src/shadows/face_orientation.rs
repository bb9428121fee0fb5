//! [`outside`]: on which side of each face it is outside, as far as the mesh tells.

use glam::DVec3;

use crate::mesh::{EdgeFaces, FaceId, Groups, Mesh};

/// On which side of a face it is outside.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Outside {
    /// Where its normal points.
    Front,
    /// Behind it: the face belongs to a solid that is wound inside out.
    Back,
    /// The face belongs to a sheet, or to a surface that is wound both ways.
    Unknown,
}

/// The sum of the normals of a solid, each as long as its face is large, is 0. A surface whose sum is
/// no longer than this share of its area is a solid, perhaps with a few holes.
const OPEN: f64 = 0.1;

/// More edges than this share across which faces are wound against each other, and the winding says
/// nothing.
const MIXED: f64 = 0.01;

/// What is known of a connected piece of the surface.
#[derive(Debug, Clone, Copy, Default)]
struct Component {
    area: f64,
    normal: DVec3,
    volume: f64,
    edges: usize,
    mixed: usize,
    /// A point on it.
    place: DVec3,
}

impl Component {
    fn outside(&self) -> Outside {
        if self.normal.length() > OPEN * self.area || self.mixed as f64 > MIXED * self.edges as f64 {
            Outside::Unknown
        } else if self.volume > 0.0 {
            Outside::Front
        } else if self.volume < 0.0 {
            Outside::Back
        } else {
            Outside::Unknown
        }
    }
}

/// On which side of each face it is outside: one for each face of the mesh.
pub(crate) fn outside(mesh: &Mesh) -> Vec<Outside> {
    let connected = Groups::new(mesh.triangles.len(), |join| {
        for edge in 0..mesh.edges.len() {
            if let EdgeFaces::Two { faces: [a, b], .. } = mesh.edges.faces(edge) {
                join(a, b);
            }
        }
    });
    let mut pieces = vec![Component::default(); mesh.triangles.len()];
    for face in 0..mesh.triangles.len() as u32 {
        let [a, b, c] = mesh.corners(FaceId(face));
        let piece = &mut pieces[connected.of(face) as usize];
        // The least face of a piece comes first.
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
            let piece = &mut pieces[connected.of(faces[0]) as usize];
            piece.edges += 1;
            piece.mixed += usize::from(same_way);
        }
    }
    (0..mesh.triangles.len() as u32).map(|face| pieces[connected.of(face) as usize].outside()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Soup;

    #[test]
    fn solids_have_an_outside_and_sheets_have_none() {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
        let solid = [[0u32, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];
        let mut soup = Soup::default();
        // A solid, one inside out and one wound both ways in the file, and one without a side.
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
        let found = outside(&Mesh::build(soup));
        let wanted = [vec![Outside::Front; 12], vec![Outside::Unknown; 3]].concat();
        assert_eq!(found, wanted);
    }
}
