//! [`Detail`]: a scene with as many faces as asked for, from all it has to the fewest that keep its shape.
//!
//! ```
//! use ligne::Scene;
//! use ligne::lod::Detail;
//!
//! let scene = Scene::open("examples/models/horn.obj")?;
//! let detail = Detail::of(&scene);
//! let mut levels = detail.levels();
//! let faces = levels.seek(&scene, 200)?;
//! let coarse = levels.scene(&scene)?;
//! assert_eq!(coarse.triangle_count() as u64, faces);
//! assert!(faces <= 200);
//! # Ok::<(), ligne::Error>(())
//! ```

mod collapse;
mod fans;
mod file;
mod flat;
mod heap;
mod kinds;
mod levels;
mod order;
mod quadric;
mod record;
mod weld;

pub use levels::Levels;

use std::path::{Path, PathBuf};

use crate::error::Error;
use crate::scene::Scene;
use flat::Flat;
use levels::shown;
use order::{Budget, collapses};
use record::Record;

/// The collapses that take a scene from all its faces to few, in the order of the error that they add.
#[derive(Debug, Clone, PartialEq)]
pub struct Detail {
    record: Record,
}

impl Detail {
    /// All collapses that a scene allows.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        Self::down_to(scene, 0)
    }

    /// Those until it has no more than so many faces; the first of [`Self::of`].
    #[must_use]
    pub fn down_to(scene: &Scene, faces: u64) -> Self {
        let budget = Budget { shown: &shown(scene), most: faces };
        Self { record: collapses(Flat::of(scene), &budget) }
    }

    /// The bytes of a file that [`Self::read`] reads faster than they were found. `scene` is the one they were found for.
    #[must_use]
    pub fn to_bytes(&self, scene: &Scene) -> Vec<u8> {
        file::written(&self.record, scene)
    }

    /// The collapses of a scene from the bytes of a file.
    ///
    /// # Errors
    /// If the bytes are no such file, are damaged, or are of another scene.
    pub fn read(bytes: &[u8], scene: &Scene) -> Result<Self, Error> {
        Ok(Self { record: file::read(bytes, scene)? })
    }

    /// Where such a file is looked for: beside the model, with its name and the ending `.ligne-lod`.
    #[must_use]
    pub fn beside(model: &Path) -> PathBuf {
        model.with_extension("ligne-lod")
    }

    /// The scene in full, to go from there to any level.
    #[must_use]
    pub fn levels(&self) -> Levels<'_> {
        Levels::new(&self.record)
    }
}
