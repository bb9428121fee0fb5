//! [`Clip`]: an animation of a file: tracks for properties of its nodes.

use super::track::Track;

/// An animation of a file.
#[derive(Debug, Clone, PartialEq)]
pub struct Clip {
    /// The name in the file; `animation 0` and so on where it has none.
    pub name: String,
    /// What changes.
    pub channels: Vec<Channel>,
}

/// How a property of a node changes.
#[derive(Debug, Clone, PartialEq)]
pub struct Channel {
    /// The number of the node.
    pub node: usize,
    /// Which of its properties.
    pub property: Property,
    /// Its values in time.
    pub track: Track,
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
