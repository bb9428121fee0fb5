//! [`Detail`]: a scene at any level of detail, from all its faces down to the fewest that keep its shape.
//!
//! ```
//! use ligne::Scene;
//! use ligne::edit::simplify::Detail;
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
//!
//! Half-edge collapses in order of the error they add. Source: Garland and Heckbert, *Surface simplification
//! using quadric error metrics*, SIGGRAPH 1997.
//!
//! 1. [`flat_surface`] copies the drawn triangles into arrays and welds corners at one position
//!    ([`point_weld`]).
//! 2. [`point_faces`] lists the faces of each point. [`point_constraints`] finds borders, seams and creases
//!    and gives each point its [`error_quadric`].
//! 3. [`collapse_order`] takes the cheapest collapse from a [`cost_heap`]; [`edge_collapse`] checks and
//!    applies it.
//! 4. [`collapse_record`] stores all collapses; [`detail_levels`] replays or undoes them to reach a face
//!    count.
//! 5. [`collapse_file`] writes and reads them as a `.ligne-lod` file.

mod collapse_file;
mod collapse_order;
mod collapse_record;
mod cost_heap;
mod detail_levels;
mod edge_collapse;
mod error_quadric;
mod flat_surface;
mod point_constraints;
mod point_faces;
mod point_weld;

pub use detail_levels::Levels;

use std::path::{Path, PathBuf};

use crate::error::Error;
use crate::scene::Scene;
use collapse_order::{FaceBudget, record_collapses};
use collapse_record::CollapseRecord;
use detail_levels::shown;
use flat_surface::IndexedSurface;

/// The collapses that reduce a scene to its fewest faces, in the order of the error that they add.
#[derive(Debug, Clone, PartialEq)]
pub struct Detail {
    record: CollapseRecord,
}

impl Detail {
    /// Finds all collapses that a scene allows.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        Self::down_to(scene, 0)
    }

    /// Finds collapses until at most `faces` remain: a prefix of those of [`Self::of`].
    #[must_use]
    pub fn down_to(scene: &Scene, faces: u64) -> Self {
        let budget = FaceBudget { shown: &shown(scene), max_faces: faces };
        Self { record: record_collapses(IndexedSurface::of(scene), &budget) }
    }

    /// Writes the collapses of `scene`, the scene for which they were found, to the bytes of a file. Reading
    /// it with [`Self::read`] is faster than finding them again.
    #[must_use]
    pub fn to_bytes(&self, scene: &Scene) -> Vec<u8> {
        collapse_file::written(&self.record, scene)
    }

    /// Reads the collapses of a scene from the bytes of a file.
    ///
    /// # Errors
    /// If the bytes have another format, are damaged, or belong to another scene.
    pub fn read(bytes: &[u8], scene: &Scene) -> Result<Self, Error> {
        Ok(Self { record: collapse_file::read(bytes, scene)? })
    }

    /// Path of the file of collapses for a model: next to it, with the same name and the ending `.ligne-lod`.
    #[must_use]
    pub fn beside(model: &Path) -> PathBuf {
        model.with_extension("ligne-lod")
    }

    /// The levels of detail, positioned at the full scene.
    #[must_use]
    pub fn levels(&self) -> Levels<'_> {
        Levels::new(&self.record)
    }
}
