//! [`Clip`]: an animation of a file, as tracks for the values that change.

use super::track::Track;

/// An animation of a file.
#[derive(Debug, Clone, PartialEq)]
pub struct Clip {
    /// Name in the file, or `animation 0` and so on.
    pub name: String,
    /// Values that change.
    pub(crate) channels: Vec<ClipChannel>,
}

/// A value of the file that changes over time.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ClipChannel {
    /// The value.
    pub target: AnimationTarget,
    /// Its keys.
    pub track: Track,
}

/// A value of a file that may change. Numbers are indices in the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum AnimationTarget {
    /// Property of a node.
    Node(usize, NodeProperty),
    /// Property of a camera, shared by all nodes with that camera.
    Camera(usize, CameraProperty),
    /// Property of a light, shared by all nodes with that light.
    Light(usize, LightProperty),
    /// Property of a material.
    Material(usize, MaterialProperty),
}

impl AnimationTarget {
    /// Node and property, if the target is a node.
    #[must_use]
    pub(crate) fn of_node(self) -> Option<(usize, NodeProperty)> {
        match self {
            Self::Node(node, property) => Some((node, property)),
            Self::Camera(..) | Self::Light(..) | Self::Material(..) => None,
        }
    }
}

/// Animated property of a node.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum NodeProperty {
    /// Translation: three numbers.
    Translation,
    /// Rotation: a quaternion, four numbers.
    Rotation,
    /// Scale along the axes: three numbers.
    Scale,
    /// Weights of the morph targets of its mesh.
    Weights,
    /// Visibility: visible unless the number is 0.
    Visible,
}

/// Animated property of a camera, one number each.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum CameraProperty {
    /// Vertical field of view of a perspective camera, in radians.
    FieldOfView,
    /// Aspect ratio, width by height.
    Aspect,
    /// Half the width of a parallel view.
    HalfWidth,
    /// Half the height of a parallel view.
    HalfHeight,
    /// Depth of the near plane.
    Near,
}

/// Animated property of a light.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum LightProperty {
    /// Colour: three numbers, linear.
    Colour,
    /// Intensity.
    Intensity,
    /// Range of the light.
    Range,
    /// Half angle of the cone within which a spot light has full intensity, in radians.
    InnerAngle,
    /// Half angle of the cone outside which a spot light is dark, in radians.
    OuterAngle,
}

/// Animated property of a material.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum MaterialProperty {
    /// Base colour and opacity: four numbers, linear.
    Base,
    /// Emitted light: three numbers, linear.
    Emissive,
    /// Alpha cutoff.
    Cutoff,
    /// Roughness.
    Roughness,
    /// Transmission: share of light that passes through.
    Transmission,
}

impl Clip {
    /// Start and end in seconds: times of the first and last key. Zero for an empty clip.
    #[must_use]
    pub fn span(&self) -> [f64; 2] {
        let keys = self.channels.iter().map(|channel| channel.track.times());
        let ends = keys.filter_map(|times| Some((*times.first()?, *times.last()?)));
        let none = (f64::INFINITY, f64::NEG_INFINITY);
        let (first, last) = ends.fold(none, |(low, high), (from, to)| (low.min(from), high.max(to)));
        if first <= last { [first, last] } else { [0.0, 0.0] }
    }

    /// Greatest number of keys a second of any track; `None` if no track has two keys.
    #[must_use]
    pub fn rate(&self) -> Option<f64> {
        let rate = |channel: &ClipChannel| {
            let times = channel.track.times();
            let long = times.last()? - times.first()?;
            (long > 0.0).then(|| (times.len() - 1) as f64 / long)
        };
        self.channels.iter().filter_map(rate).reduce(f64::max)
    }
}

/// A clip that plays, with its time and weight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Playing {
    /// Number of the clip.
    pub clip: usize,
    /// Time in seconds, clamped to the start and end of the clip.
    pub time: f64,
    /// Weight of the clip. If the weights of all clips add up to less than 1, the rest pose has the
    /// remainder; if to more than 1, they are divided by their sum.
    pub weight: f64,
}

impl Playing {
    /// A clip at full weight.
    #[must_use]
    pub const fn all(clip: usize, time: f64) -> Self {
        Self { clip, time, weight: 1.0 }
    }
}
