//! Vertex normals that are smooth over gentle edges and split at sharp ones, as renderers need them.

use std::collections::BTreeMap;

use glam::DVec3;

use super::solid::Solid;

/// Cosine of the minimum angle of a sharp edge, 35 degrees.
const SHARP_COSINE: f64 = 0.819;

/// Vertices: one per distinct pair of point and normal.
pub struct Vertices {
    pub positions: Vec<DVec3>,
    pub normals: Vec<DVec3>,
    pub triangles: Vec<[u32; 3]>,
}

/// Corner normals of a solid: the area-weighted mean of the adjacent faces within the angle.
pub fn vertices(solid: &Solid) -> Vertices {
    let faces: Vec<[u32; 3]> = solid.triangles().collect();
    let areas: Vec<DVec3> = faces
        .iter()
        .map(|face| face.map(|corner| solid.points[corner as usize]))
        .map(|[a, b, c]| (b - a).cross(c - a))
        .collect();
    let mut around = vec![Vec::new(); solid.points.len()];
    for (id, face) in faces.iter().enumerate() {
        for corner in face {
            around[*corner as usize].push(id);
        }
    }
    let mut out = Vertices { positions: Vec::new(), normals: Vec::new(), triangles: Vec::new() };
    let mut known = BTreeMap::new();
    for (id, face) in faces.iter().enumerate() {
        let own = areas[id].normalize();
        out.triangles.push(face.map(|corner| {
            let sum: DVec3 = around[corner as usize]
                .iter()
                .map(|&other| areas[other])
                .filter(|area| area.normalize().dot(own) > SHARP_COSINE)
                .sum();
            let normal = sum.normalize();
            let key = (corner, (normal * 1e4).round().to_array().map(|value| value as i64));
            *known.entry(key).or_insert_with(|| {
                out.positions.push(solid.points[corner as usize]);
                out.normals.push(normal);
                out.positions.len() as u32 - 1
            })
        }));
    }
    out
}
