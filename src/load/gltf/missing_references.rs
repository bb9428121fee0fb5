//! [`Missing`]: references of the file to things that it does not have, and that can be left out.

use crate::scene::Warnings;
use crate::scene::warnings::Spots;

/// The first place of each kind, and how many others there are.
#[derive(Debug, Clone, Default)]
pub struct Missing {
    /// Meshes of nodes, whose parts are left out.
    pub meshes: Spots,
    /// Skins of nodes, whose meshes stay unchanged stored.
    pub skins: Spots,
    /// Materials of primitives.
    pub materials: Spots,
    /// Texture coordinates that the texture of a primitive's material wants.
    pub uvs: Spots,
}

impl Missing {
    /// One warning for each kind.
    pub fn warn(self, warnings: &mut Warnings) {
        for spots in [self.meshes, self.skins, self.materials, self.uvs] {
            spots.warn(warnings);
        }
    }
}
