//! [`DihedralCosines`]: cosine of the dihedral angle at every edge, computed once.

use crate::parallel::prelude::*;

use crate::mesh::{Dihedral, EdgeFaces, Mesh};
use crate::parallel::task_size::MIN_TASK_ITEMS;

/// Cosines of the turns of the surface at the edges of a mesh.
#[derive(Debug, Clone, Default)]
pub(crate) struct DihedralCosines {
    /// Cosine between the two faces of each edge; NaN where there are not two, 0 next to faces without area.
    cosines: Vec<f32>,
}

impl DihedralCosines {
    /// Computes the cosines of a mesh.
    #[must_use]
    pub(crate) fn of(mesh: &Mesh) -> Self {
        let cosine = |edge: usize| match mesh.edges.faces(edge) {
            EdgeFaces::Two { faces, same_way } => Dihedral::of(mesh, faces, same_way).cosine,
            _ => f32::NAN,
        };
        Self {
            cosines: (0..mesh.edges.len()).into_par_iter().with_min_len(MIN_TASK_ITEMS).map(cosine).collect(),
        }
    }

    /// Cosine at an edge with exactly two faces, NaN elsewhere. Not meaningful next to faces without area.
    #[inline]
    #[must_use]
    pub(crate) fn of_two(&self, edge: usize) -> f32 {
        self.cosines[edge]
    }

    /// Cosine of [`Dihedral::at`], which skips faces without area; NaN where that is `None`.
    #[inline]
    #[must_use]
    pub(crate) fn at(&self, mesh: &Mesh, edge: usize) -> f32 {
        let cosine = self.cosines[edge];
        if cosine.abs() > 0.0 { cosine } else { cosine_across_needle(mesh, edge) }
    }

    /// Same as [`Dihedral::at`], but in most cases without access to the faces.
    #[inline]
    #[must_use]
    pub(crate) fn dihedral(&self, mesh: &Mesh, edge: usize) -> Option<Dihedral> {
        let cosine = self.cosines[edge];
        match mesh.edges.faces(edge) {
            EdgeFaces::Two { faces, same_way } if cosine.abs() > 0.0 => {
                Some(Dihedral { faces, same_way, cosine })
            }
            _ => Dihedral::at(mesh, edge),
        }
    }
}

/// Kept out of line, because borders, faces without area and right angles are rare.
#[cold]
fn cosine_across_needle(mesh: &Mesh, edge: usize) -> f32 {
    Dihedral::at(mesh, edge).map_or(f32::NAN, |dihedral| dihedral.cosine)
}
