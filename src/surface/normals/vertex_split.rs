//! Splits vertices on separating edges: each fan of faces between these edges becomes a smooth vertex.

use crate::geometry::lists::disjoint_sets::UnionFind;
use crate::parallel::prelude::*;
use glam::DVec3;

use super::file_normals::{file_normals, preferred_normal};
use super::normal_sum::{FaceWeights, NormalSum};
use super::smooth_normals::{NO_NORMAL, SmoothNormals};
use crate::mesh::{FaceId, Mesh};

/// Corner of a face in a fan around a vertex.
#[derive(Debug, Clone, Copy)]
pub(super) struct FanCorner {
    pub vertex: u32,
    pub face: u32,
    /// Index of the corner in its face.
    pub which: u8,
}

/// Gives each fan around a vertex on a separating edge its smooth vertex. The first fan keeps the number of
/// the vertex; the others get new numbers.
pub(crate) fn part(mesh: &Mesh, smooth: &mut SmoothNormals) {
    if smooth.separating_edges.is_empty() {
        return;
    }
    let mut cuts: Vec<[u32; 2]> = smooth
        .separating_edges
        .iter()
        .map(|e| mesh.edges.vertices[e])
        .flat_map(|[a, b]| [[a, b], [b, a]])
        .collect();
    cuts.sort_unstable();
    let mut is_parted = vec![false; mesh.positions.len()];
    cuts.iter().for_each(|[vertex, _]| is_parted[*vertex as usize] = true);

    let mut corners = corners(mesh, smooth, &is_parted);
    let mut added = AddedVertices::default();
    corners.sort_unstable_by_key(|c| (c.vertex, c.face));
    let mut sides: Vec<(u32, usize)> = Vec::new();
    for around in corners.chunk_by(|a, b| a.vertex == b.vertex) {
        let vertex = around[0].vertex;
        // Two corners that share a side are in the same fan, unless the side separates them.
        sides.clear();
        for (k, corner) in around.iter().enumerate() {
            let triangle = mesh.triangles[corner.face as usize];
            let which = usize::from(corner.which);
            sides.extend([1, 2].map(|step| (triangle[(which + step) % 3], k)));
        }
        sides.sort_unstable();
        let fans = UnionFind::new(around.len());
        for pair in sides.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
            if cuts.binary_search(&[vertex, pair[0].0]).is_err() {
                fans.join(pair[0].1 as u32, pair[1].1 as u32);
            }
        }
        for fan in 0..around.len() {
            let root = |k: usize| fans.root(k as u32) as usize;
            if root(fan) == fan {
                let own: Vec<FanCorner> =
                    (fan..around.len()).filter(|k| root(*k) == fan).map(|k| around[k]).collect();
                add(mesh, smooth, &mut added, (vertex, fan == 0), &own);
            }
        }
    }
    // The additions are few; amortised growth would double the memory.
    smooth.normals.reserve_exact(added.normals.len());
    smooth.normals.append(&mut added.normals);
    smooth.vertices.reserve_exact(added.vertices.len());
    smooth.vertices.append(&mut added.vertices);
}

/// New smooth vertices, numbered after the existing ones.
#[derive(Default)]
struct AddedVertices {
    normals: Vec<DVec3>,
    vertices: Vec<u32>,
}

fn corners(mesh: &Mesh, smooth: &SmoothNormals, is_parted: &[bool]) -> Vec<FanCorner> {
    const CHUNK: usize = 1 << 12;
    let found: Vec<Vec<FanCorner>> = mesh
        .triangles
        .par_chunks(CHUNK)
        .with_max_len(1)
        .enumerate()
        .map(|(chunk, triangles)| {
            let mut found = Vec::new();
            for (k, triangle) in triangles.iter().enumerate() {
                let face = (chunk * CHUNK + k) as u32;
                if smooth.corners[face as usize][0] == NO_NORMAL {
                    continue;
                }
                for (which, vertex) in triangle.iter().enumerate() {
                    if is_parted[*vertex as usize] {
                        found.push(FanCorner { vertex: *vertex, face, which: which as u8 });
                    }
                }
            }
            found
        })
        .collect();
    found.concat()
}

/// Computes the normal of a fan. All fans except the first get a new smooth vertex.
fn add(
    mesh: &Mesh,
    smooth: &mut SmoothNormals,
    added: &mut AddedVertices,
    (vertex, keeps): (u32, bool),
    fan: &[FanCorner],
) {
    let (mut of_faces, mut of_file) = (NormalSum::default(), DVec3::ZERO);
    for corner in fan {
        let which = usize::from(corner.which);
        if let Some(weights) = FaceWeights::new(mesh.corners(FaceId(corner.face))) {
            of_faces.add(&weights, which);
        }
        of_file += file_normals(mesh, corner.face as usize)[which];
    }
    let normal = preferred_normal(of_faces.normal(), of_file);
    let id = if keeps { vertex } else { (smooth.vertices.len() + added.vertices.len()) as u32 };
    if keeps {
        smooth.normals[id as usize] = normal;
    } else {
        added.normals.push(normal);
        added.vertices.push(vertex);
    }
    for corner in fan {
        smooth.corners[corner.face as usize][usize::from(corner.which)] = id;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Soup;

    #[test]
    fn hard_edges_split_the_vertex_normals_of_a_cube_by_face() {
        let positions =
            (0..8).map(|k| DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2)));
        let quads = [[0u32, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles = quads.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
        let mesh = Mesh::build(Soup { positions: positions.collect(), triangles, ..Soup::default() });
        let diagonal = |e: usize| {
            let [a, b] = mesh.edges.vertices[e];
            mesh.positions[a as usize].distance(mesh.positions[b as usize]) > 1.1
        };
        let smooth = SmoothNormals::new(&mesh, |_| true, |e| !diagonal(e));
        assert_eq!(smooth.normals.len(), 24);
        for (face, corners) in smooth.corners.iter().enumerate() {
            let own = glam::Vec3::from_array(mesh.face_normals[face]).as_dvec3();
            for (corner, vertex) in corners.iter().zip(mesh.triangles[face]) {
                assert!(smooth.normals[*corner as usize].distance(own) < 1e-6);
                assert_eq!(smooth.vertices[*corner as usize], vertex);
            }
        }
        // A single hard edge inside a surface splits no fan, but interrupts the surface.
        let one = (0..mesh.edges.len()).find(|e| diagonal(*e)).expect("faces are cut along diagonals");
        let dart = SmoothNormals::new(&mesh, |_| true, |e| e == one);
        assert_eq!(dart.normals.len(), 8);
        assert!(dart.across(&mesh, one).is_none() && !dart.seamless);
        // If one side is flat, its corners have no normals, and its edges separate.
        let below = |face: u32| mesh.face_normals[face as usize][2] < -0.5;
        let [outside, inside] = [true, false].map(|side| (0..12).find(|f| below(*f) == side).unwrap());
        let flat = SmoothNormals::new(&mesh, |face| !below(face), |_| false);
        assert_eq!(flat.corners_of(outside), None);
        assert_eq!(flat.corners_of(inside), Some(mesh.triangles[inside as usize]));
        assert_eq!(flat.separating_edges.iter().count(), 4);
    }
}
