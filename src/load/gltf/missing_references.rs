//! [`Missing`]: counts references to things that the file lacks and that can be left out.

use crate::scene::Warnings;
use crate::scene::warnings::Spots;

/// Missing things by kind: the first location, and the number of others.
#[derive(Debug, Clone, Default)]
pub struct Missing {
    /// Meshes of nodes; their parts are left out.
    pub meshes: Spots,
    /// Skins of nodes; their meshes are drawn without a skin.
    pub skins: Spots,
    /// Materials of primitives.
    pub materials: Spots,
    /// Texture coordinates required by the texture of a primitive.
    pub uvs: Spots,
}

impl Missing {
    /// Adds one warning for each kind.
    pub fn warn(self, warnings: &mut Warnings) {
        for spots in [self.meshes, self.skins, self.materials, self.uvs] {
            spots.warn(warnings);
        }
    }
}
