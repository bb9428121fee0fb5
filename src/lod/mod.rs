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
mod flat;
mod heap;
mod kinds;
mod levels;
mod order;
mod quadric;
mod record;
mod weld;

pub use levels::Levels;

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

    /// The scene in full, to go from there to any level.
    #[must_use]
    pub fn levels(&self) -> Levels<'_> {
        Levels::new(&self.record)
    }
}
