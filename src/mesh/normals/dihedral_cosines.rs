//! [`Turns`]: by how much the surface turns at every edge, found once for all who ask.

use crate::parallel::prelude::*;

use crate::mesh::{Dihedral, EdgeFaces, Mesh};
use crate::parallel::task_size::GRAIN;

/// The cosines of the angles by which the surface of a mesh turns at its edges.
#[derive(Debug, Clone, Default)]
pub struct Turns {
    /// Between the two faces of each edge, NaN where there are not two; 0 beside faces without area as well.
    cosines: Vec<f32>,
}

impl Turns {
    /// Those of a mesh.
    #[must_use]
    pub fn of(mesh: &Mesh) -> Self {
        let cosine = |edge: usize| match mesh.edges.faces(edge) {
            EdgeFaces::Two { faces, same_way } => Dihedral::of(mesh, faces, same_way).cosine,
            _ => f32::NAN,
        };
        Self { cosines: (0..mesh.edges.len()).into_par_iter().with_min_len(GRAIN).map(cosine).collect() }
    }

    /// The cosine at an edge where just two faces meet, NaN elsewhere. Meaningless beside faces without area.
    #[inline]
    #[must_use]
    pub fn of_two(&self, edge: usize) -> f32 {
        self.cosines[edge]
    }

    /// The cosine of [`Dihedral::at`], which looks through faces without area; NaN where that finds none.
    #[inline]
    #[must_use]
    pub fn at(&self, mesh: &Mesh, edge: usize) -> f32 {
        let cosine = self.cosines[edge];
        if cosine.abs() > 0.0 { cosine } else { looked_through(mesh, edge) }
    }

    /// [`Dihedral::at`], mostly without a look at the faces.
    #[inline]
    #[must_use]
    pub fn dihedral(&self, mesh: &Mesh, edge: usize) -> Option<Dihedral> {
        let cosine = self.cosines[edge];
        match mesh.edges.faces(edge) {
            EdgeFaces::Two { faces, same_way } if cosine.abs() > 0.0 => {
                Some(Dihedral { faces, same_way, cosine })
            }
            _ => Dihedral::at(mesh, edge),
        }
    }
}

/// Out of line: borders, faces without area and right angles are rare.
#[cold]
fn looked_through(mesh: &Mesh, edge: usize) -> f32 {
    Dihedral::at(mesh, edge).map_or(f32::NAN, |dihedral| dihedral.cosine)
}
