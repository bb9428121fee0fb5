//! Writer of binary STL.

use crate::geometry::solid::Solid;

/// Triangles of a solid with their face normals.
pub fn bytes(title: &str, solid: &Solid) -> Vec<u8> {
    let mut header = [b' '; 80];
    for (slot, letter) in header.iter_mut().zip(title.bytes()) {
        *slot = letter;
    }
    let triangles: Vec<[u32; 3]> = solid.triangles().collect();
    let mut out = header.to_vec();
    out.extend((triangles.len() as u32).to_le_bytes());
    for triangle in triangles {
        let [a, b, c] = triangle.map(|corner| solid.points[corner as usize]);
        let normal = (b - a).cross(c - a).normalize();
        for value in [normal, a, b, c].into_iter().flat_map(|vector| vector.as_vec3().to_array()) {
            // Adding zero turns a negative zero into zero, so equal corners have equal bytes.
            out.extend((value + 0.0).to_le_bytes());
        }
        out.extend([0, 0]);
    }
    out
}
