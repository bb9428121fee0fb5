//! Reads the animations of a glTF file as [`Clip`]s.
//!
//! A channel animates one property of a node, light, material or camera. Its sampler gives key times in
//! seconds, values and an interpolation. Invalid channels are skipped with a warning.

use super::animation_pointers::{node_property, pointed};
use crate::animation::rig::Node;
use crate::animation::{
    AnimationTarget, Clip, ClipChannel, Interpolation, LightProperty, MaterialProperty, NodeProperty, Track,
};
use crate::error::Error;
use crate::load::gltf::json::{Animation, AnimationSampler, Channel as JsonChannel, ChannelTarget};
use crate::load::gltf::storage::buffers::Buffers;
use crate::scene::Warnings;

/// The clips of a file, in file order. Invalid channels, and channels that change nothing visible, are left
/// out with a warning.
pub(crate) fn clips(buffers: &Buffers, nodes: &[Node], warnings: &mut Warnings) -> Vec<Clip> {
    let mut clips = Vec::new();
    for (number, animation) in buffers.root.animations.iter().enumerate() {
        let mut clip = Clip { name: name(number, animation), channels: Vec::new() };
        for (index, channel) in animation.channels.iter().enumerate() {
            match read(buffers, nodes, animation, channel) {
                Ok(Some(channel)) => clip.channels.push(channel),
                Ok(None) => warnings.count("animated properties that are not drawn", 1),
                Err(error) => {
                    let place = error.place.as_ref().map_or_else(String::new, |place| format!("{place}: "));
                    warnings.note(format!(
                        "animation `{}`: channel {index} is left out: {place}{}",
                        clip.name, error.message
                    ));
                }
            }
        }
        clips.push(clip);
    }
    clips
}

/// Name of an animation; a number if the file gives none.
fn name(number: usize, animation: &Animation) -> String {
    animation.name.clone().unwrap_or_else(|| format!("animation {number}"))
}

/// Reads one channel; `None` if it changes nothing visible.
fn read(
    buffers: &Buffers,
    nodes: &[Node],
    animation: &Animation,
    channel: &JsonChannel,
) -> Result<Option<ClipChannel>, Error> {
    let Some(target) = target(buffers, &channel.target)? else { return Ok(None) };
    let width = width(nodes, target)?;
    let number = channel.sampler.ok_or_else(|| Error::new("it has no sampler"))?;
    let Some(sampler) = animation.samplers.get(number) else {
        return Err(Error::new(format!("it has sampler {number} of {}", animation.samplers.len())));
    };
    let track = track(buffers, sampler, width)?;
    let numbers = width.numbers();
    if track.width() != numbers || numbers == 0 {
        return Err(Error::new(format!("{} numbers a key, where {numbers} are needed", track.width())));
    }
    Ok(Some(ClipChannel { target, track }))
}

/// Shape of a value: how many numbers it has, and how the file stores them.
#[derive(Clone, Copy)]
enum ValueShape {
    /// This many scalars, each stored separately: morph weights, or one for a single number.
    Scalars(usize),
    /// A vector of three numbers.
    Three,
    /// A vector of four numbers.
    Four,
}

impl ValueShape {
    fn numbers(self) -> usize {
        match self {
            Self::Scalars(count) => count,
            Self::Three => 3,
            Self::Four => 4,
        }
    }
}

/// Shape of the values that a target takes.
fn width(nodes: &[Node], target: AnimationTarget) -> Result<ValueShape, Error> {
    Ok(match target {
        AnimationTarget::Node(node, property) => {
            let Some(own) = nodes.get(node) else {
                return Err(Error::new(format!("it moves node {node}, but the file has {}", nodes.len())));
            };
            match property {
                NodeProperty::Translation | NodeProperty::Scale => ValueShape::Three,
                NodeProperty::Rotation => ValueShape::Four,
                NodeProperty::Weights => ValueShape::Scalars(own.weights.len()),
                NodeProperty::Visible => ValueShape::Scalars(1),
            }
        }
        AnimationTarget::Light(_, LightProperty::Colour)
        | AnimationTarget::Material(_, MaterialProperty::Emissive) => ValueShape::Three,
        AnimationTarget::Material(_, MaterialProperty::Base) => ValueShape::Four,
        AnimationTarget::Camera(..) | AnimationTarget::Light(..) | AnimationTarget::Material(..) => {
            ValueShape::Scalars(1)
        }
    })
}

/// Target of a channel; `None` if it changes nothing visible.
fn target(buffers: &Buffers, target: &ChannelTarget) -> Result<Option<AnimationTarget>, Error> {
    if let Some(pointer) = &target.extensions.pointer {
        return pointed(buffers.root, &pointer.pointer);
    }
    let Some(property) = node_property(&target.path) else {
        let path = crate::load::gltf::uri::shortened(&target.path);
        return Err(Error::new(format!("its path `{path}` is unknown")));
    };
    // A channel without a node belongs to an extension.
    Ok(target.node.map(|node| AnimationTarget::Node(node, property)))
}

/// Reads the keys of a sampler.
fn track(buffers: &Buffers, sampler: &AnimationSampler, width: ValueShape) -> Result<Track, Error> {
    let interpolation = match sampler.interpolation.as_deref() {
        None | Some("LINEAR") => Interpolation::Linear,
        Some("STEP") => Interpolation::Step,
        Some("CUBICSPLINE") => Interpolation::CubicSpline,
        Some(other) => {
            return Err(Error::new(format!(
                "its interpolation `{}` is unknown",
                crate::load::gltf::uri::shortened(other)
            )));
        }
    };
    let (Some(input), Some(output)) = (sampler.input, sampler.output) else {
        return Err(Error::new("its sampler has no input or no output"));
    };
    let times = buffers.read(input, |[time]: [f64; 1]| time)?;
    let values = match width {
        ValueShape::Three => buffers.read(output, |v: [f64; 3]| v)?.into_flattened(),
        ValueShape::Four => buffers.read(output, |v: [f64; 4]| v)?.into_flattened(),
        ValueShape::Scalars(_) => buffers.read(output, |[value]: [f64; 1]| value)?,
    };
    Track::new(times, values, interpolation).map_err(Error::new)
}
