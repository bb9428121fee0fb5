//! [`DetailLevel`]: a scene with a given number of faces, in any pose.

use crate::edit::simplify::{Detail, Levels};
use crate::error::Error;
use crate::scene::Scene;

/// Resting scene at a level of detail, and the data that brings its poses to that level.
#[derive(Debug, Clone)]
pub struct DetailLevel<'a> {
    levels: Levels<'a>,
    pub(crate) rest: Scene,
    faces: u64,
}

impl<'a> DetailLevel<'a> {
    /// The finest level with at most `faces` faces, or the coarsest level.
    ///
    /// # Errors
    /// If the levels belong to another scene.
    pub fn of(detail: &'a Detail, scene: &Scene, faces: u64) -> Result<Self, Error> {
        let mut levels = detail.levels();
        let faces = levels.seek(scene, faces)?;
        let rest = levels.scene(scene)?;
        Ok(Self { levels, rest, faces })
    }

    /// Number of faces of the level.
    #[must_use]
    pub fn faces(&self) -> u64 {
        self.faces
    }

    /// A pose of the scene at this level.
    ///
    /// # Errors
    /// If it is a pose of another scene.
    pub(crate) fn posed(&self, posed: &Scene) -> Result<Scene, Error> {
        self.levels.scene(posed)
    }
}
