//! [`PrincipalCurvatures`]: principal curvatures at the smooth vertices of a mesh.
//!
//! 1. A curvature tensor is fitted to each face, from the differences of the normals at its corners.
//! 2. The tensors of the faces around a vertex are rotated into its tangent plane and averaged by Voronoi
//!    area.
//! 3. The average is diagonalised.
//!
//! Source: Szymon Rusinkiewicz, "Estimating curvatures and their derivatives on triangle meshes", 3DPVT 2004.

use crate::parallel::prelude::*;
use glam::DVec3;

use super::vertex_fans::{VertexFans, sides};
use crate::geometry::numbers::linear_solver::solve;
use crate::mesh::{FaceId, Mesh};
use crate::parallel::task_size::MIN_TASK_ITEMS;
use crate::surface::SmoothNormals;
use crate::surface::tolerances;

/// The principal curvatures at a point of a surface, and their directions.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct PrincipalCurvatures {
    /// Curvature of larger magnitude, per world unit; positive where the surface is convex, as on a sphere.
    pub k1: f64,
    /// Curvature of smaller magnitude, per world unit.
    pub k2: f64,
    /// Unit vector of the direction with curvature `k1`; its sign is arbitrary. Zero where the curvature is
    /// unknown.
    pub dir1: DVec3,
    /// Unit vector of the direction with curvature `k2`. The normal, `dir1` and `dir2` are right-handed.
    pub dir2: DVec3,
}

/// The principal curvatures at all smooth vertices.
pub(crate) fn principal(
    mesh: &Mesh,
    smooth: &SmoothNormals,
    fans: &VertexFans,
    normals: &[DVec3],
) -> Vec<PrincipalCurvatures> {
    let tensors: Vec<[f64; 3]> = (0..smooth.corners.len())
        .into_par_iter()
        .with_min_len(MIN_TASK_ITEMS)
        .map(|face| tensor(mesh, smooth, fans, normals, face).unwrap_or_default())
        .collect();
    (0..smooth.vertices.len())
        .into_par_iter()
        .with_min_len(MIN_TASK_ITEMS)
        .map(|vertex| {
            let normal = normals[vertex];
            let u = normal.try_normalize().map_or(DVec3::ZERO, DVec3::any_orthonormal_vector);
            let axes = [u, normal.cross(u)];
            let (mut sum, mut area) = ([0.0; 3], 0.0);
            for (face, corner) in fans.around(vertex) {
                let frame = &fans.frames[face];
                let share = frame.areas[corner];
                let turned = turned(axes, normal, frame.normal());
                let own = in_axes(tensors[face], [frame.u, frame.v], turned);
                (0..3).for_each(|i| sum[i] += own[i] * share);
                area += share;
            }
            if area > 0.0 {
                diagonal(sum.map(|entry| entry / area), axes)
            } else {
                PrincipalCurvatures::default()
            }
        })
        .collect()
}

/// Curvature tensor of a face in its frame, entries 11, 12, 22: the least-squares fit to the differences of
/// its corner normals.
fn tensor(
    mesh: &Mesh,
    smooth: &SmoothNormals,
    fans: &VertexFans,
    normals: &[DVec3],
    face: usize,
) -> Option<[f64; 3]> {
    if !fans.holds(face) {
        return None;
    }
    let frame = &fans.frames[face];
    let corners = smooth.corners[face].map(|v| normals[v as usize]);
    let mut right = [0.0; 3];
    let (mut uu, mut uv, mut vv) = (0.0, 0.0, 0.0);
    for (side, change) in sides(&mesh.corners(FaceId::from(face))).into_iter().zip(sides(&corners)) {
        let (u, v) = (side.dot(frame.u), side.dot(frame.v));
        let (du, dv) = (change.dot(frame.u), change.dot(frame.v));
        uu += u * u;
        uv += u * v;
        vv += v * v;
        right[0] += u * du;
        right[1] += u * dv + v * du;
        right[2] += v * dv;
    }
    solve([[uu, uv, 0.0], [uv, uu + vv, uv], [0.0, uv, vv]], right)
}

/// Axes in the plane normal to `from`, rotated by the shortest rotation into the plane normal to `to`.
#[inline]
pub(crate) fn turned(axes: [DVec3; 2], from: DVec3, to: DVec3) -> [DVec3; 2] {
    let cosine = from.dot(to);
    if cosine <= tolerances::MAX_OPPOSITE_COSINE {
        return axes.map(|axis| -axis);
    }
    let across = to - from * cosine;
    let half = (from + to) / (1.0 + cosine);
    axes.map(|axis| axis - half * axis.dot(across))
}

/// Transforms a symmetric tensor (11, 12, 22) from axes `old` to axes `new` of the same plane.
#[inline]
pub(crate) fn in_axes([a, b, c]: [f64; 3], old: [DVec3; 2], new: [DVec3; 2]) -> [f64; 3] {
    let [[p, q], [r, s]] = new.map(|axis| [axis.dot(old[0]), axis.dot(old[1])]);
    [
        a * p * p + 2.0 * b * p * q + c * q * q,
        a * p * r + b * (p * s + q * r) + c * q * s,
        a * r * r + 2.0 * b * r * s + c * s * s,
    ]
}

/// Eigenvalues and eigenvectors of a tensor given in axes.
fn diagonal([a, b, c]: [f64; 3], [u, v]: [DVec3; 2]) -> PrincipalCurvatures {
    let (mean, half) = ((a + c) / 2.0, (a - c) / 2.0);
    let spread = (half * half + b * b).sqrt();
    let (high, low) = (mean + spread, mean - spread);
    // The eigenvector of `high`, from the row with less cancellation.
    let (x, y) = if half >= 0.0 { (half + spread, b) } else { (b, spread - half) };
    let along = (u * x + v * y).try_normalize().unwrap_or(u);
    let across = v * x - u * y;
    let across = across.try_normalize().unwrap_or(v);
    if high.abs() >= low.abs() {
        PrincipalCurvatures { k1: high, k2: low, dir1: along, dir2: across }
    } else {
        PrincipalCurvatures { k1: low, k2: high, dir1: across, dir2: -along }
    }
}
