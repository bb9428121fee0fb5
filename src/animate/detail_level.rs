//! [`Level`]: a scene with as many faces as asked for, whatever its pose.

use crate::edit::simplify::{Detail, Levels};
use crate::error::Error;
use crate::scene::Scene;

/// A scene at a level of detail, at rest, and what takes its poses there.
#[derive(Debug, Clone)]
pub struct Level<'a> {
    levels: Levels<'a>,
    pub(crate) rest: Scene,
    faces: u64,
}

impl<'a> Level<'a> {
    /// A scene with no more than so many faces, or with the fewest its levels have.
    ///
    /// # Errors
    /// If the levels are not those of the scene.
    pub fn of(detail: &'a Detail, scene: &Scene, faces: u64) -> Result<Self, Error> {
        let mut levels = detail.levels();
        let faces = levels.seek(scene, faces)?;
        let rest = levels.scene(scene)?;
        Ok(Self { levels, rest, faces })
    }

    /// How many faces it has.
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
