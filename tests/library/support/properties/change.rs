//! Changes to a scene that must not change its drawing.

use glam::{DMat3, DVec3};
use ligne::scene::Scene;

use super::numbering::{renumbered, with_faces_reversed, with_parts_shuffled};
use super::shape::{transformed, with_faces_split, with_hidden_objects};
use super::subject::Subject;
use crate::library::support::scenes::random_dice::Dice;

/// A change to a scene and its camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Change {
    /// Scene and camera are scaled and moved, and rotated randomly if `turned`.
    Moved { turned: bool, scale: f64, by: DVec3 },
    /// Vertices, faces and wires are renumbered, and the corners of triangles are rotated.
    Renumbered,
    /// Parts are shuffled with a seed.
    PartsShuffled { seed: u64 },
    /// Parts are listed in reverse order.
    PartsReversed,
    /// Vertices, faces and wires are renumbered, and parts are shuffled.
    AllShuffled,
    /// Each face is split into three.
    FacesSplit,
    /// The winding of faces is reversed.
    FacesReversed(ReversedFaces),
    /// Objects are added in the first `places` hidden boxes of the subject.
    HiddenObjects { places: usize },
    /// The scene stays the same and is drawn with this number of threads.
    Threads(usize),
    /// The scene grows by 2 % under a fixed camera. This must change the drawing: it tests the harness.
    Grown,
}

/// Faces whose winding is reversed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum ReversedFaces {
    All,
    OfEveryOtherGeometry,
    Random,
}

/// The property that a change tests; there is one test per property.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Property {
    /// Invariance under similarity transforms of scene and camera.
    SimilarityTransform,
    /// Invariance under renumbering of vertices and faces, also combined with a new order of parts.
    Numbering,
    /// Invariance under the order of parts.
    PartOrder,
    /// Invariance under the subdivision of flat faces.
    FaceSubdivision,
    /// Invariance under the winding of faces.
    Winding,
    /// Invariance under hidden objects.
    HiddenObjects,
    /// Invariance under the number of threads.
    Threads,
}

impl Change {
    /// A random rotation and a translation.
    pub(crate) const RIGID_MOTION: Self =
        Self::Moved { turned: true, scale: 1.0, by: DVec3::new(3.0, -2.0, 7.0) };
    /// A translation so far that coordinates lose digits.
    pub(crate) const FAR_TRANSLATION: Self =
        Self::Moved { turned: false, scale: 1.0, by: DVec3::new(1e6, -1e6, 1e6) };

    /// A uniform scaling.
    pub(crate) const fn scaled(scale: f64) -> Self {
        Self::Moved { turned: false, scale, by: DVec3::ZERO }
    }

    /// A random rotation and a uniform scaling.
    pub(crate) const fn turned_and_scaled(scale: f64) -> Self {
        Self::Moved { turned: true, scale, by: DVec3::ZERO }
    }

    pub(crate) fn property(self) -> Property {
        match self {
            Self::Moved { .. } | Self::Grown => Property::SimilarityTransform,
            Self::Renumbered | Self::AllShuffled => Property::Numbering,
            Self::PartsShuffled { .. } | Self::PartsReversed => Property::PartOrder,
            Self::FacesSplit => Property::FaceSubdivision,
            Self::FacesReversed(_) => Property::Winding,
            Self::HiddenObjects { .. } => Property::HiddenObjects,
            Self::Threads(_) => Property::Threads,
        }
    }

    /// The subject after the change.
    pub(crate) fn apply(self, subject: &Subject, dice: &mut Dice) -> Subject {
        let scene = &subject.scene;
        let with = |scene: Scene| Subject { scene, ..subject.clone() };
        match self {
            Self::Moved { turned, scale, by } => {
                let turn = if turned { dice.turn() } else { DMat3::IDENTITY };
                transformed(subject, turn, scale, by)
            }
            Self::Renumbered => with(renumbered(scene, dice)),
            Self::PartsShuffled { seed } => with(with_parts_shuffled(scene, &mut Dice::new(seed))),
            Self::PartsReversed => {
                let parts = scene.parts.iter().rev().cloned().collect();
                with(Scene { parts, ..scene.clone() })
            }
            Self::AllShuffled => with(with_parts_shuffled(&renumbered(scene, dice), dice)),
            Self::FacesSplit => with(with_faces_split(scene, dice)),
            Self::FacesReversed(turned) => with(with_faces_reversed(scene, |shape| match turned {
                ReversedFaces::All => true,
                ReversedFaces::OfEveryOtherGeometry => shape % 2 == 0,
                ReversedFaces::Random => dice.below(2) == 0,
            })),
            Self::HiddenObjects { places } => with(with_hidden_objects(subject, places, dice)),
            Self::Threads(_) => subject.clone(),
            Self::Grown => {
                let mut scene = scene.clone();
                scene.geometries.iter_mut().flat_map(|g| &mut g.positions).for_each(|p| *p *= 1.02);
                scene.parts.iter_mut().for_each(|part| part.world_from_part.translation *= 1.02);
                with(scene)
            }
        }
    }

    /// The number of threads to draw with; `None` if it does not matter.
    pub(crate) fn threads(self) -> Option<usize> {
        if let Self::Threads(count) = self { Some(count) } else { None }
    }
}
