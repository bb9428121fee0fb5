//! What is wrong with a mesh, as warnings.

use std::collections::BTreeMap;

use crate::mesh::{EdgeFaces, Mesh};
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
        let mut by_part: BTreeMap<&str, u64> = BTreeMap::new();
        for edge in 0..mesh.edges.len() {
            if let EdgeFaces::Many([face, ..]) = mesh.edges.faces(edge) {
                let part = mesh.face_part.get(*face as usize).and_then(|p| scene.parts.get(p.index()));
                *by_part.entry(part.map_or("", |p| p.name.as_str())).or_default() += 1;
            }
        }
        for (part, n) in by_part {
            warnings.count(format!("non-manifold edges in part '{part}'"), n);
        }
    }
    warnings
}
