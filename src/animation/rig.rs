//! [`Rig`]: all that moves a scene: its nodes, skins, bodies and clips.

use glam::{DAffine3, DQuat, DVec3};

use super::clip::{Clip, Playing, Property};
use super::deformable_mesh::Body;
use super::material_factors::Factors;

/// All that moves a scene.
#[derive(Debug, Clone, Default)]
pub struct Rig {
    /// The nodes, each behind its parent in `order`.
    pub nodes: Vec<Node>,
    /// The numbers of all nodes, parents first.
    pub order: Vec<usize>,
    /// The skins.
    pub skins: Vec<Skin>,
    /// For each geometry of the scene, what of it moves by itself.
    pub forms: Vec<Form>,
    /// For each part of the scene, in order, its node and where it lies in that.
    pub parts: Vec<(usize, DAffine3)>,
    /// For each camera of the scene, which of the file it is, and its node.
    pub cameras: Vec<Held>,
    /// The same for each light.
    pub lights: Vec<Held>,
    /// The values of the materials of the file.
    pub materials: Vec<Factors>,
    /// The animations of the file.
    pub clips: Vec<Clip>,
}

/// A camera or a light of a file, in a node.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Held {
    /// The number of the camera or light in the file: several nodes may hold the same.
    pub number: usize,
    /// The node that holds it.
    pub node: usize,
}

/// A place that others hang on.
#[derive(Debug, Clone, PartialEq)]
pub struct Node {
    /// The name it is known by.
    pub name: String,
    /// Whether the file says that it leaves motion lines, with all that hangs on it.
    pub leaves_lines: bool,
    /// The number of the one it hangs on.
    pub parent: Option<usize>,
    /// Where it rests in that.
    pub rest: Placement,
    /// How much of each morph target its mesh has at rest.
    pub weights: Vec<f64>,
    /// Whether it is shown at rest.
    pub visible: bool,
}

/// Where something lies in what it hangs on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Placement {
    /// As a matrix, which no clip moves.
    Matrix(DAffine3),
    /// Scaled, then turned, then moved.
    Parts {
        /// Moved by this.
        translation: DVec3,
        /// Turned by this, of unit length.
        rotation: DQuat,
        /// Stretched by this along its axes.
        scale: DVec3,
    },
}

impl Placement {
    /// The transform.
    #[must_use]
    pub fn transform(&self) -> DAffine3 {
        match *self {
            Self::Matrix(matrix) => matrix,
            Self::Parts { translation, rotation, scale } => {
                DAffine3::from_scale_rotation_translation(scale, rotation, translation)
            }
        }
    }

    /// Its translation, rotation and scale; what no such parts make is lost.
    fn parts(&self) -> (DVec3, DQuat, DVec3) {
        match *self {
            Self::Matrix(matrix) => {
                let (scale, rotation, translation) = matrix.to_scale_rotation_translation();
                (translation, rotation, scale)
            }
            Self::Parts { translation, rotation, scale } => (translation, rotation, scale),
        }
    }
}

/// Nodes that carry vertices.
#[derive(Debug, Clone, PartialEq)]
pub struct Skin {
    /// The numbers of the nodes.
    pub joints: Vec<usize>,
    /// From where vertices rest to each joint.
    pub binds: Vec<DAffine3>,
}

impl Skin {
    /// From where vertices rest to the world, for each joint, given where all nodes are.
    #[must_use]
    pub fn transforms(&self, world: &[DAffine3]) -> Vec<DAffine3> {
        let own = |joint: &usize| world.get(*joint).copied().unwrap_or(DAffine3::IDENTITY);
        self.joints.iter().zip(&self.binds).map(|(joint, bind)| own(joint) * *bind).collect()
    }
}

/// What of a geometry moves by itself.
#[derive(Debug, Clone, Default)]
pub struct Form {
    /// The node whose weights and skin it has.
    pub node: usize,
    /// The number of its skin.
    pub skin: Option<usize>,
    /// Its vertices; none if they do not move.
    pub bodies: Vec<Body>,
}

/// Where nodes are at a moment.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Stance {
    pub world: Vec<DAffine3>,
    pub weights: Vec<Vec<f64>>,
    pub visible: Vec<bool>,
}

impl Rig {
    /// The number of the clip of a name.
    #[must_use]
    pub fn clip(&self, name: &str) -> Option<usize> {
        self.clips.iter().position(|clip| clip.name == name)
    }

    /// Where the nodes are while clips play.
    pub(crate) fn stance(&self, playing: &[Playing]) -> Stance {
        let mut weights: Vec<Vec<f64>> = self.nodes.iter().map(|node| node.weights.clone()).collect();
        let mut visible: Vec<bool> = self.nodes.iter().map(|node| node.visible).collect();
        let mut local: Vec<DAffine3> = self.nodes.iter().map(|node| node.rest.transform()).collect();
        for (number, moved) in self.moved(playing) {
            let node = &self.nodes[number];
            let of = |property: Property| moved.iter().filter(move |(own, ..)| *own == property);
            let (translation, rotation, scale) = node.rest.parts();
            let vector = |property, rest: DVec3| {
                let values = of(property).filter_map(|(_, track, time, weight)| {
                    Some((DVec3::from_array(track.at(*time).try_into().ok()?), *weight))
                });
                mixed(rest, values)
            };
            let moves = |property| of(property).next().is_some();
            if [Property::Translation, Property::Rotation, Property::Scale].into_iter().any(moves) {
                let turns = of(Property::Rotation)
                    .filter_map(|(_, track, time, weight)| Some((track.rotation_at(*time)?, *weight)));
                local[number] = DAffine3::from_scale_rotation_translation(
                    vector(Property::Scale, scale),
                    mixed_turn(rotation, turns),
                    vector(Property::Translation, translation),
                );
            }
            if moves(Property::Weights) {
                for (target, own) in weights[number].iter_mut().enumerate() {
                    let values = of(Property::Weights).filter_map(|(_, track, time, weight)| {
                        Some((*track.at(*time).get(target)?, *weight))
                    });
                    *own = mixed(*own, values);
                }
            }
            if let Some((_, track, time, _)) = of(Property::Visible).max_by(|a, b| a.3.total_cmp(&b.3)) {
                visible[number] = track.at(*time).first().is_none_or(|value| *value != 0.0);
            }
        }
        let mut world = vec![DAffine3::IDENTITY; self.nodes.len()];
        for &number in &self.order {
            let parent = self.nodes[number].parent;
            world[number] = parent.map_or(DAffine3::IDENTITY, |parent| world[parent]) * local[number];
            visible[number] &= parent.is_none_or(|parent| visible[parent]);
        }
        Stance { world, weights, visible }
    }

    /// The nodes that clips move, and by which tracks, at which time and weight.
    fn moved(&self, playing: &[Playing]) -> std::collections::BTreeMap<usize, Vec<Moved<'_>>> {
        let mut moved: std::collections::BTreeMap<usize, Vec<Moved<'_>>> = std::collections::BTreeMap::new();
        for Playing { clip, time, weight } in playing.iter().filter(|playing| playing.weight > 0.0) {
            for channel in self.clips.get(*clip).into_iter().flat_map(|clip| &clip.channels) {
                let Some((node, property)) = channel.target.of_node() else { continue };
                moved.entry(node).or_default().push((property, &channel.track, *time, *weight));
            }
        }
        moved
    }
}

/// A property, a track of it, and when and how much it plays.
type Moved<'a> = (Property, &'a super::track::Track, f64, f64);

/// The mean of values by their weights; what these lack to 1 has the value at rest.
pub(crate) fn mixed<T>(rest: T, values: impl Iterator<Item = (T, f64)>) -> T
where
    T: std::ops::Mul<f64, Output = T> + std::ops::Add<Output = T> + Copy,
{
    let mut sum: Option<(T, f64)> = None;
    let mut alone = None;
    for (value, weight) in values {
        alone = if sum.is_none() { Some(value) } else { None };
        sum =
            Some(sum.map_or((value * weight, weight), |(so_far, total)| {
                (so_far + value * weight, total + weight)
            }));
    }
    match (sum, alone) {
        (None, _) => rest,
        // One alone at full weight stays as it is, to the last bit.
        (Some((_, total)), Some(value)) if total >= 1.0 => value,
        (Some((sum, total)), _) if total >= 1.0 => sum * (1.0 / total),
        (Some((sum, total)), _) => sum + rest * (1.0 - total),
    }
}

/// The same of rotations: their normalised mean, each by the shorter way from the first.
fn mixed_turn(rest: DQuat, turns: impl Iterator<Item = (DQuat, f64)>) -> DQuat {
    let mut first = None;
    let near = turns.map(|(turn, weight)| {
        let to = *first.get_or_insert(turn);
        (if to.dot(turn) < 0.0 { -turn } else { turn }, weight)
    });
    let all: Vec<(DQuat, f64)> = near.collect();
    let Some(first) = first else { return rest };
    let rest = if first.dot(rest) < 0.0 { -rest } else { rest };
    let mean = mixed(rest, all.into_iter());
    if mean.length_squared() > 0.0 { mean.normalize() } else { first }
}
