//! [`MissingReferences`]: counts references to things that the file lacks and that can be left out.

use crate::scene::Warnings;
use crate::scene::warnings::WarningExamples;

/// Missing things by kind: the first location, and the number of others.
#[derive(Debug, Clone, Default)]
pub(crate) struct MissingReferences {
    /// Meshes of nodes; their parts are left out.
    pub meshes: WarningExamples,
    /// Skins of nodes; their meshes are drawn without a skin.
    pub skins: WarningExamples,
    /// Materials of primitives.
    pub materials: WarningExamples,
    /// Texture coordinates required by the texture of a primitive.
    pub uvs: WarningExamples,
}

impl MissingReferences {
    /// Adds one warning for each kind.
    pub(crate) fn warn(self, warnings: &mut Warnings) {
        for spots in [self.meshes, self.skins, self.materials, self.uvs] {
            spots.warn(warnings);
        }
    }
}
