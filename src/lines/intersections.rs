//! Feature lines where surfaces pass through each other.

use super::{FeatureLines, FeatureSegment, LineKind};
use crate::mesh::intersect::{IntersectionInput, intersections};
use crate::mesh::{FaceId, Mesh};
use crate::view::View;

/// Adds the intersection curves of all faces that have area.
pub fn find(mesh: &Mesh, view: &View, lines: &mut FeatureLines) {
    let active: Vec<bool> = if mesh.cleaning.degenerate == 0 {
        Vec::new()
    } else {
        (0..mesh.triangles.len()).map(|f| !mesh.is_degenerate(FaceId::from(f))).collect()
    };
    let input = IntersectionInput { positions: &mesh.positions, triangles: &mesh.triangles, active: &active };
    let curves = intersections(&input);
    let first = (mesh.positions.len() + lines.points.len()) as u32;
    lines.points.extend(curves.points);
    lines.segments.extend(curves.segments.iter().map(|s| {
        let [a, b] = s.faces;
        let nearer = if view.facing[a as usize] { a } else { b } as usize;
        FeatureSegment {
            ends: s.ends.map(|end| first + end),
            hosts: s.faces,
            kind: LineKind::Intersection,
            both_seen: true,
            smooth: false,
            strength: 180.0,
            part: mesh.face_part[nearer],
            material: mesh.face_material[nearer],
        }
    }));
}
