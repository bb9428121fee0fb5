//! [`ComponentClasses`]: class of each connected component, looked up by face.

use crate::geometry::lists::disjoint_sets::NumberedSets;
use crate::parallel::prelude::*;

/// Minimum number of faces per task.
const MIN_FACES_PER_TASK: usize = 1 << 16;

/// Class of a connected component.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum SurfaceClass {
    /// Drawn as its faces are.
    #[default]
    Faceted,
    /// Planar regions, with surfaces between them that may be curved.
    Machined,
    /// Curved everywhere except at creases.
    Round,
}

/// Source of a surface, as far as its mesh shows. It decides whether lines may be noise.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, PartialOrd, Ord)]
pub(crate) enum MeshSource {
    /// Constructed: all lines are intended.
    #[default]
    Constructed,
    /// Figure that the normals of the file shade round: small isolated features are artefacts of its few
    /// faces.
    Modelled,
    /// Curved surface without normals: small folds and short creases may be noise.
    Scanned,
}

/// Shape of a component by the normals of its file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum FileShading {
    /// Nothing: there are none, or they do not fit.
    #[default]
    None,
    /// It consists of flat faces.
    Faceted,
    /// It has curved faces.
    Curved,
}

/// Class of a component, with the reliability of its normals.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct ComponentClass {
    pub make: SurfaceClass,
    pub origin: MeshSource,
    pub trusts_file_normals: bool,
    pub shading: FileShading,
}

impl ComponentClass {
    /// Whether the component is constructed, and its normals give it curved faces.
    pub(crate) fn is_shaded_part(&self) -> bool {
        self.shading == FileShading::Curved && self.origin == MeshSource::Constructed
    }
}

/// Classes of the components of a mesh, and the component of each face.
#[derive(Debug, Default)]
pub(crate) struct ComponentClasses {
    /// One entry per component. Every component has a face.
    of_pieces: Vec<ComponentClass>,
    /// Component of each face.
    pieces: Vec<u32>,
}

impl ComponentClasses {
    /// Takes one class per component, in the order of component numbers.
    pub(crate) fn new(of_pieces: Vec<ComponentClass>, pieces: NumberedSets) -> Self {
        Self { of_pieces, pieces: pieces.set_of_face }
    }

    /// The class of the component that a face belongs to.
    #[inline]
    pub(crate) fn class_of_face(&self, face: u32) -> &ComponentClass {
        &self.of_pieces[self.pieces[face as usize] as usize]
    }

    /// Whether at least one component is of a class.
    pub(crate) fn any(&self, make: SurfaceClass) -> bool {
        self.of_pieces.iter().any(|verdict| verdict.make == make)
    }

    /// Whether all components are of a class.
    pub(crate) fn all(&self, make: SurfaceClass) -> bool {
        self.of_pieces.iter().all(|verdict| verdict.make == make)
    }

    /// Maps the class of each face.
    pub(crate) fn map<T: Clone + Send + Sync>(&self, of: impl Fn(&ComponentClass) -> T + Sync) -> Vec<T> {
        if let [only] = &self.of_pieces[..] {
            return vec![of(only); self.pieces.len()];
        }
        let of_face = |piece: &u32| of(&self.of_pieces[*piece as usize]);
        self.pieces.par_iter().with_min_len(MIN_FACES_PER_TASK).map(of_face).collect()
    }

    /// Component of each face, numbered in the order of their first faces; empty if there is at most one.
    pub(crate) fn pieces(&self) -> Vec<u32> {
        if self.of_pieces.len() < 2 { Vec::new() } else { self.pieces.clone() }
    }

    /// Whether some and whether all components are constructed and shaded.
    pub(crate) fn are_shaded(&self) -> (bool, bool) {
        (
            self.of_pieces.iter().any(ComponentClass::is_shaded_part),
            self.of_pieces.iter().all(ComponentClass::is_shaded_part),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn surface_class_of_a_face_is_that_of_its_component() {
        let make = |make| ComponentClass { make, ..ComponentClass::default() };
        let numbered = |of_face: &[u32]| NumberedSets { set_of_face: of_face.to_vec(), first: Vec::new() };
        let two = ComponentClasses::new(
            vec![make(SurfaceClass::Round), make(SurfaceClass::Machined)],
            numbered(&[0, 1, 1, 0]),
        );
        assert_eq!(two.class_of_face(2).make, SurfaceClass::Machined);
        assert!(
            two.any(SurfaceClass::Machined)
                && !two.any(SurfaceClass::Faceted)
                && !two.all(SurfaceClass::Round)
        );
        assert_eq!(two.map(|verdict| verdict.make == SurfaceClass::Round), [true, false, false, true]);
        assert_eq!(two.pieces(), [0, 1, 1, 0]);
        let one = ComponentClasses::new(vec![make(SurfaceClass::Round)], numbered(&[0, 0]));
        assert!(one.all(SurfaceClass::Round));
        assert_eq!(one.map(|verdict| verdict.make), [SurfaceClass::Round; 2]);
        assert!(one.pieces().is_empty());
        let none = ComponentClasses::default();
        assert!(none.all(SurfaceClass::Round) && !none.any(SurfaceClass::Round) && none.pieces().is_empty());
    }
}
