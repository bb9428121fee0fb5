//! [`Curvature`]: principal curvatures of the curved surfaces of a mesh, and their derivatives.
//!
//! Source: Rusinkiewicz 2004 (see [`PrincipalCurvatures`]). Here the normals are smoothed first (see `diffuse`).

use glam::DVec3;

use super::curvature_derivative;
use super::feature_size;
use super::normal_diffusion::diffuse;
use super::principal_curvatures::{PrincipalCurvatures, principal};
use super::vertex_fans::VertexFans;
use crate::mesh::{Mesh, PartId};
use crate::surface::SmoothNormals;

/// Curvatures and their derivatives at the smooth vertices of a mesh.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Curvature {
    /// The faces around each smooth vertex.
    pub fans: VertexFans,
    /// Smoothed unit normals, one per smooth vertex.
    pub normals: Vec<DVec3>,
    /// Principal curvatures, one per smooth vertex.
    pub principal: Vec<PrincipalCurvatures>,
    /// Derivative of the curvature tensor along `dir1` and `dir2`, per world unit squared, one per smooth
    /// vertex. The entries 111, 112, 122, 222 of a symmetric 2 × 2 × 2 tensor.
    pub derivative: Vec<[f64; 4]>,
    /// Feature size of each part, world units; see `feature_size::feature_sizes`.
    pub feature_sizes: Vec<f64>,
    /// Body of each smooth vertex, by its first part.
    part_of: Vec<PartId>,
}

impl Curvature {
    /// Measures a surface. Normals are smoothed over `smoothing` times the scale of each part.
    #[must_use]
    pub(crate) fn new(mesh: &Mesh, smooth: &SmoothNormals, smoothing: f64) -> Self {
        let fans = VertexFans::new(mesh, smooth);
        let part_of = fans.bodies(mesh, smooth.vertices.len());
        let length = |part: PartId| smoothing * mesh.extents.part(part).scale;
        let normals = diffuse(smooth, &fans, &part_of, length);
        let principal = principal(mesh, smooth, &fans, &normals);
        let derivative = curvature_derivative::derivative(mesh, smooth, &fans, &normals, &principal);
        let feature_sizes = feature_size::feature_sizes(mesh, &fans, &principal, &part_of);
        Self { fans, normals, principal, derivative, feature_sizes, part_of }
    }

    /// Feature size around a smooth vertex, world units.
    #[inline]
    #[must_use]
    pub(crate) fn feature_size(&self, vertex: u32) -> f64 {
        self.feature_sizes[self.part_of[vertex as usize].index()]
    }
}
