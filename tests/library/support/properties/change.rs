//! The changes that must not be seen in a drawing, each by name.

use glam::{DMat3, DVec3};
use ligne::scene::Scene;

use super::numbering::{renumbered, with_faces_turned, with_parts_shuffled};
use super::shape::{moved, with_faces_split, with_hidden_things};
use super::subject::Subject;
use crate::support::scenes::random_dice::Dice;

/// What is done to a scene and its camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Change {
    /// Scene and camera are turned at random or not, scaled, and moved.
    Moved { turned: bool, scale: f64, by: DVec3 },
    /// Vertices, faces and wires are numbered anew, and triangles begin elsewhere.
    Renumbered,
    /// Parts stand in another order, a different one for each seed.
    PartsShuffled { seed: u64 },
    /// Parts stand in the order from last to first.
    PartsReversed,
    /// Vertices, faces and wires are numbered anew, and parts stand in another order.
    AllShuffled,
    /// Faces are cut in three.
    FacesSplit,
    /// Faces are wound the other way: all of them, all of every other part, or some at random.
    FacesTurned(Turned),
    /// Things are put into the first places of which nothing is seen.
    HiddenThings { places: usize },
    /// Nothing is done, and so many threads draw.
    Threads(usize),
    /// The scene grows by two hundredths under a camera that stays: no property, for it must be seen.
    Grown,
}

/// Which faces are wound the other way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Turned {
    All,
    OfEveryOtherShape,
    Some,
}

/// What a change is about; each is one test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Property {
    /// Where scene and camera are, how they are turned, and how large.
    Place,
    /// How vertices and faces are numbered; parts may stand in another order as well.
    Numbering,
    /// In which order parts stand.
    OrderOfParts,
    /// How flat faces are cut.
    Cuts,
    /// Which way round the file gives the corners of faces.
    Winding,
    /// What is not seen.
    HiddenThings,
    /// How many threads draw.
    Threads,
}

impl Change {
    /// Turned and moved.
    pub const RIGID: Self = Self::Moved { turned: true, scale: 1.0, by: DVec3::new(3.0, -2.0, 7.0) };
    /// Moved so far that coordinates lose digits.
    pub const FAR: Self = Self::Moved { turned: false, scale: 1.0, by: DVec3::new(1e6, -1e6, 1e6) };

    /// Of another size.
    pub const fn size(scale: f64) -> Self {
        Self::Moved { turned: false, scale, by: DVec3::ZERO }
    }

    /// Turned, and of another size.
    pub const fn turned_size(scale: f64) -> Self {
        Self::Moved { turned: true, scale, by: DVec3::ZERO }
    }

    pub fn property(self) -> Property {
        match self {
            Self::Moved { .. } | Self::Grown => Property::Place,
            Self::Renumbered | Self::AllShuffled => Property::Numbering,
            Self::PartsShuffled { .. } | Self::PartsReversed => Property::OrderOfParts,
            Self::FacesSplit => Property::Cuts,
            Self::FacesTurned(_) => Property::Winding,
            Self::HiddenThings { .. } => Property::HiddenThings,
            Self::Threads(_) => Property::Threads,
        }
    }

    /// The subject after the change.
    pub fn apply(self, subject: &Subject, dice: &mut Dice) -> Subject {
        let scene = &subject.scene;
        let with = |scene: Scene| Subject { scene, ..subject.clone() };
        match self {
            Self::Moved { turned, scale, by } => {
                let turn = if turned { dice.turn() } else { DMat3::IDENTITY };
                moved(subject, turn, scale, by)
            }
            Self::Renumbered => with(renumbered(scene, dice)),
            Self::PartsShuffled { seed } => with(with_parts_shuffled(scene, &mut Dice::new(seed))),
            Self::PartsReversed => {
                let parts = scene.parts.iter().rev().cloned().collect();
                with(Scene { parts, ..scene.clone() })
            }
            Self::AllShuffled => with(with_parts_shuffled(&renumbered(scene, dice), dice)),
            Self::FacesSplit => with(with_faces_split(scene, dice)),
            Self::FacesTurned(turned) => with(with_faces_turned(scene, |shape| match turned {
                Turned::All => true,
                Turned::OfEveryOtherShape => shape % 2 == 0,
                Turned::Some => dice.below(2) == 0,
            })),
            Self::HiddenThings { places } => with(with_hidden_things(subject, places, dice)),
            Self::Threads(_) => subject.clone(),
            Self::Grown => {
                let mut scene = scene.clone();
                scene.geometries.iter_mut().flat_map(|g| &mut g.positions).for_each(|p| *p *= 1.02);
                scene.parts.iter_mut().for_each(|part| part.world_from_part.translation *= 1.02);
                with(scene)
            }
        }
    }

    /// How many threads draw; none where that does not matter.
    pub fn threads(self) -> Option<usize> {
        if let Self::Threads(count) = self { Some(count) } else { None }
    }
}
