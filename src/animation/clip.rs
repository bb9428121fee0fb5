//! [`Clip`]: an animation of a file: tracks for what changes in it.

use super::track::Track;

/// An animation of a file.
#[derive(Debug, Clone, PartialEq)]
pub struct Clip {
    /// The name in the file; `animation 0` and so on where it has none.
    pub name: String,
    /// What changes.
    pub channels: Vec<Channel>,
}

/// How a value of a file changes.
#[derive(Debug, Clone, PartialEq)]
pub struct Channel {
    /// Which value.
    pub target: Target,
    /// What it is in time.
    pub track: Track,
}

/// A value of a file that may change; things count as they stand in the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Target {
    /// Of a node.
    Node(usize, Property),
    /// Of a camera, whichever nodes hold it.
    Camera(usize, Lens),
    /// Of a light, whichever nodes hold it.
    Light(usize, Shine),
    /// Of a material.
    Material(usize, Finish),
}

impl Target {
    /// The node whose property it is, and which.
    #[must_use]
    pub fn of_node(self) -> Option<(usize, Property)> {
        match self {
            Self::Node(node, property) => Some((node, property)),
            Self::Camera(..) | Self::Light(..) | Self::Material(..) => None,
        }
    }
}

/// What may change of a node.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Property {
    /// Where it is moved to: three numbers.
    Translation,
    /// How it is turned: a quaternion, four numbers.
    Rotation,
    /// By how much it is stretched along its axes: three numbers.
    Scale,
    /// How much of each morph target is in its mesh.
    Weights,
    /// Whether it is shown: a number that is not 0.
    Visible,
}

/// What may change of a camera: one number each.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Lens {
    /// The vertical angle of view of a perspective camera, in radians.
    FieldOfView,
    /// Its width in heights.
    Aspect,
    /// Half the width of what a parallel view shows.
    HalfWidth,
    /// Half its height.
    HalfHeight,
    /// The nearest depth that is drawn.
    Near,
}

/// What may change of a light.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Shine {
    /// Its colour: three numbers, linear.
    Colour,
    /// How bright it is.
    Intensity,
    /// How far it shines.
    Range,
    /// The half angle of its cone inside which it is full, in radians.
    InnerAngle,
    /// That outside which it is none.
    OuterAngle,
}

/// What may change of a material.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Finish {
    /// Its base colour and how opaque it is: four numbers, linear.
    Base,
    /// The light of its own: three numbers, linear.
    Emissive,
    /// The least alpha that is not cut away.
    Cutoff,
    /// How rough it is.
    Roughness,
    /// How much light goes through it.
    Transmission,
}

impl Clip {
    /// When it begins and ends, in seconds: its first and its last key. An empty clip is at 0.
    #[must_use]
    pub fn span(&self) -> [f64; 2] {
        let keys = self.channels.iter().map(|channel| channel.track.times());
        let ends = keys.filter_map(|times| Some((*times.first()?, *times.last()?)));
        let none = (f64::INFINITY, f64::NEG_INFINITY);
        let (first, last) = ends.fold(none, |(low, high), (from, to)| (low.min(from), high.max(to)));
        if first <= last { [first, last] } else { [0.0, 0.0] }
    }

    /// How many keys a second its tracks have, where they have most; none if no track has two keys.
    #[must_use]
    pub fn rate(&self) -> Option<f64> {
        let rate = |channel: &Channel| {
            let times = channel.track.times();
            let long = times.last()? - times.first()?;
            (long > 0.0).then(|| (times.len() - 1) as f64 / long)
        };
        self.channels.iter().filter_map(rate).reduce(f64::max)
    }
}

/// A clip that is played, at a time, and how much of it is seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Playing {
    /// The number of the clip.
    pub clip: usize,
    /// In seconds; before its begin and behind its end the clip stands still.
    pub time: f64,
    /// Weights of several clips are shares of 1, or what is left to 1 belongs to the stored pose; more than 1 in all are divided by
    /// their sum.
    pub weight: f64,
}

impl Playing {
    /// All of a clip at a time.
    #[must_use]
    pub const fn all(clip: usize, time: f64) -> Self {
        Self { clip, time, weight: 1.0 }
    }
}
