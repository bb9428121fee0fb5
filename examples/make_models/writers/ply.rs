//! Writer of binary little-endian PLY.

use glam::DVec3;

use crate::geometry::part::y_up_from_z_up;
use crate::geometry::solid::Solid;

/// Triangles of a solid, turned to y up, with one normal per point or none.
pub fn bytes(title: &str, solid: &Solid, normals: &[DVec3]) -> Vec<u8> {
    let triangles: Vec<[u32; 3]> = solid.triangles().collect();
    let mut out = format!(
        "ply\nformat binary_little_endian 1.0\ncomment {title}\nelement vertex {}\n",
        solid.points.len()
    );
    let names = ["x", "y", "z", "nx", "ny", "nz"];
    for name in &names[..if normals.is_empty() { 3 } else { 6 }] {
        out.push_str(&format!("property float {name}\n"));
    }
    out.push_str(&format!("element face {}\n", triangles.len()));
    out.push_str("property list uchar int vertex_indices\nend_header\n");
    let mut out = out.into_bytes();
    let up = y_up_from_z_up();
    for (i, point) in solid.points.iter().enumerate() {
        let normal = normals.get(i).map(|normal| up.transform_vector3(*normal));
        let turned = std::iter::once(up.transform_point3(*point)).chain(normal);
        for value in turned.flat_map(|vector| vector.as_vec3().to_array()) {
            out.extend((value + 0.0).to_le_bytes());
        }
    }
    for triangle in triangles {
        out.push(3);
        out.extend(triangle.iter().flat_map(|corner| corner.to_le_bytes()));
    }
    out
}
