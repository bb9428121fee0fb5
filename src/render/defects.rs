//! What is wrong with a mesh, as warnings.

use std::collections::BTreeMap;

use crate::mesh::{EdgeFaces, Mesh, PartId};
use crate::scene::{Scene, Warnings};

/// The defects that cleaning found and drew around, counted and named by part.
#[must_use]
pub fn of_mesh(mesh: &Mesh, scene: &Scene) -> Warnings {
    let mut warnings = Warnings::default();
    let c = &mesh.cleaning;
    warnings.count("faces with two corners at one place were left out", c.collapsed);
    warnings.count("doubled faces were left out", c.doubled);
    warnings.count("faces without area", c.degenerate);
    if c.non_manifold > 0 {
        for (part, n) in non_manifold_by_part(mesh) {
            let name = scene.parts.get(part.index()).map_or("", |p| p.name.as_str());
            warnings.count(format!("non-manifold edges in part '{name}'"), n);
        }
    }
    warnings
}

/// Number of edges at which one part alone has three faces or more. Where parts touch, each has
/// its own two faces, and nothing is wrong.
fn non_manifold_by_part(mesh: &Mesh) -> BTreeMap<PartId, u64> {
    let mut counts: BTreeMap<PartId, u64> = BTreeMap::new();
    for edge in 0..mesh.edges.len() {
        if let EdgeFaces::Many(faces) = mesh.edges.faces(edge) {
            let mut parts: Vec<PartId> = faces.iter().map(|f| mesh.face_part[*f as usize]).collect();
            parts.sort_unstable();
            for own in parts.chunk_by(|a, b| a == b).filter(|own| own.len() > 2) {
                *counts.entry(own[0]).or_default() += 1;
            }
        }
    }
    counts
}
