//! A scene as triangles welded by position, with connected components.

use glam::DVec3;
use ligne::scene::Scene;
use rustc_hash::FxHashMap;

/// World-space triangles that share vertices with bitwise equal positions.
#[derive(Default)]
pub(crate) struct TriangleScene {
    pub points: Vec<DVec3>,
    pub faces: Vec<[u32; 3]>,
    /// The part, the material and the connected component of each face.
    pub part: Vec<u32>,
    pub material: Vec<u32>,
    pub component: Vec<u32>,
    /// Diagonal of the bounding box.
    pub size: f64,
}

impl TriangleScene {
    /// Collects the triangles of a scene; triangles with two equal vertices are dropped.
    pub(crate) fn of(scene: &Scene) -> Self {
        let mut all = Self::default();
        let mut known: FxHashMap<[u64; 3], u32> = FxHashMap::default();
        for (part, shown) in scene.parts.iter().enumerate() {
            let geometry = &scene.geometries[shown.geometry];
            let ids: Vec<u32> = geometry
                .positions
                .iter()
                .map(|position| {
                    let point = shown.world_from_part.transform_point3(*position) + DVec3::ZERO;
                    *known.entry(point.to_array().map(f64::to_bits)).or_insert_with(|| {
                        all.points.push(point);
                        all.points.len() as u32 - 1
                    })
                })
                .collect();
            for (face, corners) in geometry.triangles.iter().enumerate() {
                let corners = corners.map(|corner| ids[corner as usize]);
                let [a, b, c] = corners;
                if a == b || b == c || c == a {
                    continue;
                }
                all.faces.push(corners);
                all.part.push(part as u32);
                let own = geometry.triangle_material.get(face).copied().or(geometry.material);
                all.material.push(own.unwrap_or(u32::MAX));
            }
        }
        let (low, high) = all
            .points
            .iter()
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(*p), high.max(*p)));
        all.size = low.distance(high);
        all.label_components();
        all
    }

    pub(crate) fn corners(&self, face: usize) -> [DVec3; 3] {
        self.faces[face].map(|corner| self.points[corner as usize])
    }

    /// Whether a face is too thin to hide anything.
    pub(crate) fn is_degenerate(&self, face: usize) -> bool {
        let [a, b, c] = self.corners(face);
        let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
        (b - a).cross(c - a).length() <= 1e-12 * self.size * longest
    }

    /// Labels connected components by union-find over the vertices.
    fn label_components(&mut self) {
        let mut leader: Vec<u32> = (0..self.points.len() as u32).collect();
        for face in &self.faces {
            let [a, b, c] = face.map(|corner| find_root(&mut leader, corner));
            leader[b as usize] = a;
            let c = find_root(&mut leader, c);
            leader[c as usize] = a;
        }
        self.component = self.faces.iter().map(|face| find_root(&mut leader, face[0])).collect();
    }
}

fn find_root(leader: &mut [u32], mut id: u32) -> u32 {
    while leader[id as usize] != id {
        leader[id as usize] = leader[leader[id as usize] as usize];
        id = leader[id as usize];
    }
    id
}
