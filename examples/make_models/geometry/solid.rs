//! A solid under construction: points and polygons, which share corners by index.

use glam::{DAffine3, DVec2, DVec3};

use super::polygon;

/// Points and flat or nearly flat faces, counter-clockwise as seen from outside.
#[derive(Debug, Clone, Default)]
pub struct Solid {
    pub points: Vec<DVec3>,
    pub faces: Vec<Vec<u32>>,
}

impl Solid {
    /// Adds a point and returns its index.
    pub fn point(&mut self, position: DVec3) -> u32 {
        self.points.push(position);
        self.points.len() as u32 - 1
    }

    /// Adds the points of a loop and returns their indices.
    pub fn ring(&mut self, positions: impl IntoIterator<Item = DVec3>) -> Vec<u32> {
        positions.into_iter().map(|position| self.point(position)).collect()
    }

    /// Joins two rings of equal size with quads. With `upper` above, the outside is to the right of the
    /// direction of `lower`. A ring of one point is a pole.
    pub fn band(&mut self, lower: &[u32], upper: &[u32]) {
        let count = lower.len().max(upper.len());
        for i in 0..count {
            self.patch(lower, upper, i, (i + 1) % count);
        }
    }

    /// Like [`Solid::band`], for two open rows of points.
    pub fn strip(&mut self, lower: &[u32], upper: &[u32]) {
        for i in 1..lower.len().max(upper.len()) {
            self.patch(lower, upper, i - 1, i);
        }
    }

    fn patch(&mut self, lower: &[u32], upper: &[u32], i: usize, j: usize) {
        let at = |row: &[u32], k: usize| row[k.min(row.len() - 1)];
        let mut face = vec![at(lower, i), at(lower, j), at(upper, j), at(upper, i)];
        face.dedup();
        if face.first() == face.last() {
            face.pop();
        }
        self.faces.push(face);
    }

    /// Adds a flat face with holes, triangulated. It faces the side where `outer` runs counter-clockwise.
    pub fn plate(&mut self, outer: &[u32], holes: &[&[u32]]) {
        let corners: Vec<u32> =
            outer.iter().chain(holes.iter().flat_map(|hole| hole.iter())).copied().collect();
        let normal = self.area_vector(outer).normalize();
        let u = normal.any_orthonormal_vector();
        let v = normal.cross(u);
        let flat: Vec<DVec2> = corners
            .iter()
            .map(|&corner| self.points[corner as usize])
            .map(|point| DVec2::new(point.dot(u), point.dot(v)))
            .collect();
        let mut start = outer.len();
        let mut rims = vec![(0..outer.len()).collect::<Vec<_>>()];
        for hole in holes {
            rims.push((start..start + hole.len()).collect());
            start += hole.len();
        }
        for triangle in polygon::triangulate(&flat, rims) {
            self.faces.push(triangle.iter().map(|&corner| corners[corner]).collect());
        }
    }

    /// Area vector of a closed loop: twice its area along its normal.
    fn area_vector(&self, outer: &[u32]) -> DVec3 {
        let origin = self.points[outer[0] as usize];
        outer
            .windows(2)
            .map(|pair| {
                (self.points[pair[0] as usize] - origin).cross(self.points[pair[1] as usize] - origin)
            })
            .sum()
    }

    /// The solid with a transform. Mirroring reverses the faces, so they still face outward.
    #[must_use]
    pub fn moved(mut self, world_from_local: DAffine3) -> Solid {
        for point in &mut self.points {
            *point = world_from_local.transform_point3(*point);
        }
        if world_from_local.matrix3.determinant() < 0.0 {
            for face in &mut self.faces {
                face.reverse();
            }
        }
        self
    }

    /// The solid with a translation.
    #[must_use]
    pub fn shifted(self, x: f64, y: f64, z: f64) -> Solid {
        self.moved(DAffine3::from_translation(DVec3::new(x, y, z)))
    }

    /// Adds another solid without joining points.
    pub fn append(&mut self, other: &Solid) {
        let base = self.points.len() as u32;
        self.points.extend_from_slice(&other.points);
        self.faces.extend(other.faces.iter().map(|face| face.iter().map(|corner| corner + base).collect()));
    }

    /// Welds points in the same cell of a grid of size `grain`.
    #[must_use]
    pub fn welded(self, grain: f64) -> Solid {
        let mut places = std::collections::BTreeMap::new();
        let mut points = Vec::new();
        let renamed: Vec<u32> = self
            .points
            .iter()
            .map(|point| {
                let key = (*point / grain).round().to_array().map(|steps| steps as i64);
                *places.entry(key).or_insert_with(|| {
                    points.push(*point);
                    points.len() as u32 - 1
                })
            })
            .collect();
        let faces = self
            .faces
            .into_iter()
            .map(|face| face.into_iter().map(|corner| renamed[corner as usize]).collect())
            .collect();
        Solid { points, faces }
    }

    /// All faces as triangles. Larger faces become fans.
    pub fn triangles(&self) -> impl Iterator<Item = [u32; 3]> + '_ {
        self.faces
            .iter()
            .flat_map(|face| face.windows(2).skip(1).map(move |pair| [face[0], pair[0], pair[1]]))
    }
}
