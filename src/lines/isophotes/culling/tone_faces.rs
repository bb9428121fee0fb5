//! Faces that may hold a tone border, found in a tree over their normals instead of one by one.
//!
//! With one parallel light the light at a point depends on the angle between normal and light alone. A level
//! of tone is then a plane in the space of normals, and only faces whose corner normals it may separate hold
//! a border.
//!
//! Source: Claes, Di Fiore, Vansichem and Van Reeth, "Fast 3D cartoon rendering with improved quality by
//! exploiting graphics hardware", IVCNZ 2001, section 4.

use crate::light::tolerances::MAX_SEPARATE_LEVELS;
use crate::light::{Shading, ShadingNormals};
use crate::mesh::bvh::ToneTree;

/// Tree over the shading normals of a surface.
#[must_use]
pub(crate) fn tree_of(normals: &ShadingNormals) -> ToneTree {
    let corners: Vec<_> = (0..normals.corners.len() as u32).map(|face| normals.of(face)).collect();
    ToneTree::new(&corners)
}

/// Numbers of the faces that may hold a tone border, ascending.
///
/// `None` if the light does not depend on the normal alone, or if there are more levels than
/// [`MAX_SEPARATE_LEVELS`]: then most faces hold one.
#[must_use]
pub(crate) fn faces_with_borders(shading: &Shading, tree: &ToneTree) -> Option<Vec<u32>> {
    let (towards, cosines) = shading.border_cosines()?;
    if cosines.len() > MAX_SEPARATE_LEVELS {
        return None;
    }
    // A face that shows its inside is lit with its normals reversed.
    let both_sides = cosines.into_iter().flat_map(|cosine| [cosine, -cosine]);
    let mut faces: Vec<u32> = both_sides.flat_map(|cosine| tree.candidates(towards, cosine).items).collect();
    faces.sort_unstable();
    faces.dedup();
    Some(faces)
}
