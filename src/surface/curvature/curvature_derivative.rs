//! Derivative of the curvature tensor at the smooth vertices of a mesh.
//!
//! Source: Rusinkiewicz 2004, section 4. The method for curvatures is applied again, to the differences of
//! the tensors at the corners of each face.

use crate::parallel::prelude::*;
use glam::DVec3;

use super::principal_curvatures::{PrincipalCurvatures, in_axes, turned};
use super::vertex_fans::{VertexFans, sides};
use crate::geometry::numbers::linear_solver::solve;
use crate::mesh::{FaceId, Mesh};
use crate::parallel::task_size::MIN_TASK_ITEMS;
use crate::surface::SmoothNormals;

/// Derivatives along the principal directions, entries 111, 112, 122, 222.
pub(crate) fn derivative(
    mesh: &Mesh,
    smooth: &SmoothNormals,
    fans: &VertexFans,
    normals: &[DVec3],
    principal: &[PrincipalCurvatures],
) -> Vec<[f64; 4]> {
    let of_faces: Vec<[f64; 4]> = (0..smooth.corners.len())
        .into_par_iter()
        .with_min_len(MIN_TASK_ITEMS)
        .map(|face| of_face(mesh, smooth, fans, normals, principal, face).unwrap_or_default())
        .collect();
    (0..smooth.vertices.len())
        .into_par_iter()
        .with_min_len(MIN_TASK_ITEMS)
        .map(|vertex| {
            let axes = [principal[vertex].dir1, principal[vertex].dir2];
            let (mut sum, mut area) = ([0.0; 4], 0.0);
            for (face, corner) in fans.around(vertex) {
                let frame = &fans.frames[face];
                let share = frame.areas[corner];
                let turned = turned(axes, normals[vertex], frame.normal());
                let own = in_axes3(of_faces[face], [frame.u, frame.v], turned);
                (0..4).for_each(|i| sum[i] += own[i] * share);
                area += share;
            }
            if area > 0.0 { sum.map(|entry| entry / area) } else { sum }
        })
        .collect()
}

/// Derivative over a face in its frame, by least squares.
fn of_face(
    mesh: &Mesh,
    smooth: &SmoothNormals,
    fans: &VertexFans,
    normals: &[DVec3],
    principal: &[PrincipalCurvatures],
    face: usize,
) -> Option<[f64; 4]> {
    if !fans.holds(face) {
        return None;
    }
    let frame = &fans.frames[face];
    let normal = frame.normal();
    let tensors = smooth.corners[face].map(|v| {
        let p = &principal[v as usize];
        let axes = turned([p.dir1, p.dir2], normals[v as usize], normal);
        in_axes([p.k1, 0.0, p.k2], axes, [frame.u, frame.v])
    });
    let mut right = [0.0; 4];
    let (mut uu, mut uv, mut vv) = (0.0, 0.0, 0.0);
    for (corner, side) in sides(&mesh.corners(FaceId::from(face))).into_iter().enumerate() {
        let (from, to) = (tensors[(corner + 1) % 3], tensors[(corner + 2) % 3]);
        let change = [0, 1, 2].map(|i| to[i] - from[i]);
        let (u, v) = (side.dot(frame.u), side.dot(frame.v));
        uu += u * u;
        uv += u * v;
        vv += v * v;
        right[0] += u * change[0];
        right[1] += v * change[0] + 2.0 * u * change[1];
        right[2] += 2.0 * v * change[1] + u * change[2];
        right[3] += v * change[2];
    }
    let matrix = [
        [uu, uv, 0.0, 0.0],
        [uv, 2.0 * uu + vv, 2.0 * uv, 0.0],
        [0.0, 2.0 * uv, uu + 2.0 * vv, uv],
        [0.0, 0.0, uv, vv],
    ];
    solve(matrix, right)
}

/// Transforms a symmetric tensor of rank three from axes `old` to axes `new` of the same plane.
fn in_axes3([a, b, c, d]: [f64; 4], old: [DVec3; 2], new: [DVec3; 2]) -> [f64; 4] {
    let [[p, q], [r, s]] = new.map(|axis| [axis.dot(old[0]), axis.dot(old[1])]);
    // The tensor applied to the first and to the second axis: two tensors of rank two.
    let first = [a * p + b * q, b * p + c * q, c * p + d * q];
    let second = [a * r + b * s, b * r + c * s, c * r + d * s];
    let twice = |[x, y, z]: [f64; 3], i: [f64; 2], j: [f64; 2]| {
        x * i[0] * j[0] + y * (i[0] * j[1] + i[1] * j[0]) + z * i[1] * j[1]
    };
    let (u, v) = ([p, q], [r, s]);
    [twice(first, u, u), twice(first, u, v), twice(first, v, v), twice(second, v, v)]
}
