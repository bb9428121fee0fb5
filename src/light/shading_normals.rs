//! [`ShadingNormals`]: the normals used for lighting a mesh, three for each face.
//!
//! 1. Rounded surfaces use the normals that also give their contour.
//! 2. Other faces use the normals of the file, if there are any.
//! 3. Otherwise, the faces around a vertex that no hard edge separates share one normal. So tessellation does
//!    not show, and corners stay sharp.

use crate::parallel::prelude::*;
use glam::{DVec3, Vec3};

use crate::mesh::{FaceId, Mesh, VertexRange, vertex_ranges};
use crate::surface::{HardEdges, SmoothNormals};

/// Normals used for lighting a mesh. Inside a face they are interpolated and normalized.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct ShadingNormals {
    /// Unit normals, local space, on the outer side of their faces.
    pub normals: Vec<DVec3>,
    /// Indices of the normals at the corners of each face.
    pub corners: Vec<[u32; 3]>,
}

impl ShadingNormals {
    /// Normals of a mesh with these hard edges. `smooth` gives the normals of its rounded parts, which also
    /// give their contour.
    #[must_use]
    pub(crate) fn new(mesh: &Mesh, hard: &HardEdges, smooth: &SmoothNormals) -> Self {
        if smooth.corners_of_all() {
            let mut shaded = Self { normals: smooth.normals.clone(), corners: smooth.corners.clone() };
            shaded.mend(mesh);
            return shaded;
        }
        let all = SmoothNormals::without_straight_edges(mesh, |_| true, |edge| hard.is_hard(edge));
        let mut shaded = Self { normals: all.normals, corners: all.corners };
        shaded.weigh_by_area(mesh, smooth);
        if !mesh.corner_normals.is_empty() {
            shaded.take_from_file(mesh);
        }
        shaded.take_rounded(smooth);
        shaded.mend(mesh);
        shaded
    }

    /// Replaces the normals of rounded faces by those of the rounded surface.
    fn take_rounded(&mut self, smooth: &SmoothNormals) {
        let first = self.normals.len() as u32;
        self.normals.extend(&smooth.normals);
        for (face, corners) in self.corners.iter_mut().enumerate() {
            if let Some(rounded_ids) = smooth.corners_of(face as u32) {
                *corners = rounded_ids.map(|id| first + id);
            }
        }
    }

    /// Normals at the corners of a face.
    #[inline]
    #[must_use]
    pub(crate) fn of(&self, face: u32) -> [DVec3; 3] {
        self.corners[face as usize].map(|id| self.normals[id as usize])
    }

    /// Gives each normal the direction of the faces that share it, weighted by their area.
    ///
    /// Large faces then keep their shading, and the narrow faces of a rim do not bend the light on them.
    /// Normals used by `rounded` faces alone are left unchanged, because these faces have other normals.
    fn weigh_by_area(&mut self, mesh: &Mesh, rounded: &SmoothNormals) {
        let mut is_asked = vec![false; self.normals.len()];
        for (face, ids) in (0..).zip(&self.corners) {
            if rounded.corners_of(face).is_none() {
                ids.iter().for_each(|id| is_asked[*id as usize] = true);
            }
        }
        let workers =
            if self.normals.len() < FACES_PER_TASK { 1 } else { rayon_core::current_num_threads().min(8) };
        let shares = vertex_ranges(self.normals.len(), &self.corners, workers);
        let of_share = |share: &VertexRange| {
            let mut sums = vec![DVec3::ZERO; share.vertices.len()];
            for face in share.faces.iter().flat_map(Clone::clone) {
                let ids = self.corners[face];
                let is_in_share = |id: u32| share.vertices.contains(&(id as usize)) && is_asked[id as usize];
                if !ids.iter().any(|id| is_in_share(*id)) {
                    continue;
                }
                let cross = mesh.area_vector(FaceId(face as u32));
                for id in ids.into_iter().filter(|id| is_in_share(*id)) {
                    sums[id as usize - share.vertices.start] += cross;
                }
            }
            let normals = &self.normals[share.vertices.clone()];
            sums.iter()
                .zip(normals)
                .map(|(sum, original)| sum.try_normalize().unwrap_or(*original))
                .collect::<Vec<_>>()
        };
        let weighed: Vec<Vec<DVec3>> = shares.par_iter().with_max_len(1).map(of_share).collect();
        self.normals = weighed.concat();
    }

    /// Uses the file's normals where it has some, flipped to the outer side of their face by majority.
    fn take_from_file(&mut self, mesh: &Mesh) {
        let first = self.normals.len() as u32;
        let count = mesh.normals.len() as u32;
        let unit: Vec<DVec3> =
            mesh.normals.iter().map(|n| Vec3::from_array(*n).as_dvec3().normalize_or_zero()).collect();
        self.normals.extend(&unit);
        self.normals.extend(unit.iter().map(|n| -*n));
        for (face, ids) in mesh.corner_normals.iter().enumerate() {
            if ids.iter().any(|id| *id >= count || unit[*id as usize] == DVec3::ZERO) {
                continue;
            }
            let face_normal = Vec3::from_array(mesh.face_normals[face]).as_dvec3();
            let sum: DVec3 = ids.iter().map(|id| unit[*id as usize]).sum();
            let turned = if sum.dot(face_normal) < 0.0 { count } else { 0 };
            self.corners[face] = ids.map(|id| first + turned + id);
        }
    }

    /// Replaces corner normals that are zero or turned away from the face by the normal of the face.
    fn mend(&mut self, mesh: &Mesh) {
        let normal_of_face = |face: usize| Vec3::from_array(mesh.face_normals[face]).as_dvec3();
        let bad = |normal: DVec3, face_normal: DVec3| {
            normal == DVec3::ZERO || normal.dot(face_normal) < MIN_FACE_COSINE
        };
        let is_bad = |face: &u32| {
            let outward = normal_of_face(*face as usize);
            outward != DVec3::ZERO && self.of(*face).iter().any(|normal| bad(*normal, outward))
        };
        let faces = (0..self.corners.len() as u32).into_par_iter().with_min_len(FACES_PER_TASK);
        let faces: Vec<u32> = faces.filter(is_bad).collect();
        for face in faces {
            let (face, outer_normal) = (face as usize, normal_of_face(face as usize));
            let id = self.normals.len() as u32;
            self.normals.push(outer_normal);
            let normals = &self.normals;
            self.corners[face] =
                self.corners[face].map(|k| if bad(normals[k as usize], outer_normal) { id } else { k });
        }
    }
}

/// Faces per task.
const FACES_PER_TASK: usize = 1 << 12;

/// Smallest cosine between a corner normal and the normal of its face.
const MIN_FACE_COSINE: f64 = -0.2;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Soup;

    #[test]
    fn shading_normals_are_flat_at_hard_edges_and_smooth_elsewhere() {
        let at = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
        let sheet = |rise: f64| {
            let positions = vec![
                at(0., 0., 0.),
                at(0., 1., 0.),
                at(1., 0., 0.),
                at(1., 1., 0.),
                at(2., 0., rise),
                at(2., 1., rise),
            ];
            let triangles = vec![[0, 2, 3], [0, 3, 1], [2, 4, 5], [2, 5, 3]];
            let mesh = Mesh::build(Soup { positions, triangles, ..Soup::default() });
            let hard = HardEdges::above(&mesh, 40.0);
            let shaded = ShadingNormals::new(&mesh, &hard, &SmoothNormals::default());
            (mesh, shaded)
        };
        let (mesh, steep) = sheet(2.0);
        for face in 0..4 {
            let face_normal = Vec3::from_array(mesh.face_normals[face]).as_dvec3();
            assert!(steep.of(face as u32).iter().all(|n| n.distance(face_normal) < 1e-6));
        }
        let (_, shallow) = sheet(0.3);
        let ends: Vec<[DVec3; 3]> = (0..4).map(|face| shallow.of(face)).collect();
        assert!(ends.iter().flatten().any(|n| n.x < -0.05 && n.x > -0.2), "{ends:?}");
    }

    #[test]
    fn file_normals_are_flipped_to_the_side_of_their_face() {
        let positions = vec![DVec3::ZERO, DVec3::X, DVec3::Y];
        let normals = vec![[0.0, 0.6, -0.8]; 3];
        let soup = Soup {
            positions,
            triangles: vec![[0, 1, 2]],
            normals,
            corner_normals: vec![[0, 1, 2]],
            ..Soup::default()
        };
        let mesh = Mesh::build(soup);
        let shaded = ShadingNormals::new(&mesh, &HardEdges::default(), &SmoothNormals::default());
        assert!(shaded.of(0).iter().all(|n| n.distance(DVec3::new(0.0, -0.6, 0.8)) < 1e-6));
    }
}
