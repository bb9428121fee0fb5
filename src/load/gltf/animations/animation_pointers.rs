//! Resolves the targets of animation pointers (KHR_animation_pointer).
//!
//! Source: Khronos Group, KHR_animation_pointer, and the glTF 2.0 asset object model.

use crate::animation::material_factors::AlphaMode;
use crate::animation::{AnimationTarget, CameraProperty, LightProperty, MaterialProperty, NodeProperty};
use crate::error::Error;
use crate::load::gltf::json::Root;
use crate::load::gltf::material_reader;

/// Target of a pointer; `None` if it has no visible effect.
///
/// # Errors
/// If it refers to something that the file lacks, or that has no such value.
pub(crate) fn pointed(root: &Root, pointer: &str) -> Result<Option<AnimationTarget>, Error> {
    let mut steps = pointer.strip_prefix('/').unwrap_or_default().splitn(2, '/');
    let (list, rest) = (steps.next().unwrap_or_default(), steps.next().unwrap_or_default());
    let numbered = |rest: &str| {
        let (number, path) = rest.split_once('/')?;
        Some((number.parse::<usize>().ok()?, path.to_owned()))
    };
    match list {
        "nodes" => Ok(numbered(rest).and_then(|(number, path)| node(number, &path))),
        "cameras" => numbered(rest).map_or(Ok(None), |(number, path)| camera(root, number, &path)),
        "materials" => numbered(rest).map_or(Ok(None), |(number, path)| material(root, number, &path)),
        "extensions" => {
            let rest = rest.strip_prefix("KHR_lights_punctual/lights/");
            rest.and_then(numbered).map_or(Ok(None), |(number, path)| light(root, number, &path))
        }
        _ => Ok(None),
    }
}

fn node(number: usize, path: &str) -> Option<AnimationTarget> {
    let property = match path {
        "extensions/KHR_node_visibility/visible" => NodeProperty::Visible,
        _ => node_property(path)?,
    };
    Some(AnimationTarget::Node(number, property))
}

/// The property of a node that a channel changes without a pointer.
pub(crate) fn node_property(path: &str) -> Option<NodeProperty> {
    Some(match path {
        "translation" => NodeProperty::Translation,
        "rotation" => NodeProperty::Rotation,
        "scale" => NodeProperty::Scale,
        "weights" => NodeProperty::Weights,
        _ => return None,
    })
}

fn camera(root: &Root, number: usize, path: &str) -> Result<Option<AnimationTarget>, Error> {
    let (lens, is_perspective) = match path {
        "perspective/yfov" => (CameraProperty::FieldOfView, true),
        "perspective/aspectRatio" => (CameraProperty::Aspect, true),
        "perspective/znear" => (CameraProperty::Near, true),
        "orthographic/xmag" => (CameraProperty::HalfWidth, false),
        "orthographic/ymag" => (CameraProperty::HalfHeight, false),
        "orthographic/znear" => (CameraProperty::Near, false),
        // There is no far plane.
        _ => return Ok(None),
    };
    let own = root.cameras.get(number).ok_or_else(|| absent("camera", number, root.cameras.len()))?;
    if own.perspective.is_some() != is_perspective {
        let kind = if is_perspective { "perspective" } else { "orthographic" };
        return Err(Error::new(format!("it moves `{path}` of camera {number}, which is not {kind}")));
    }
    Ok(Some(AnimationTarget::Camera(number, lens)))
}

fn light(root: &Root, number: usize, path: &str) -> Result<Option<AnimationTarget>, Error> {
    let shine = match path {
        "color" => LightProperty::Colour,
        "intensity" => LightProperty::Intensity,
        "range" => LightProperty::Range,
        "spot/innerConeAngle" => LightProperty::InnerAngle,
        "spot/outerConeAngle" => LightProperty::OuterAngle,
        _ => return Ok(None),
    };
    let lights = root.extensions.lights.as_ref().map_or(&[][..], |lights| &lights.lights);
    let own = lights.get(number).ok_or_else(|| absent("light", number, lights.len()))?;
    if matches!(shine, LightProperty::InnerAngle | LightProperty::OuterAngle) && own.kind != "spot" {
        return Err(Error::new(format!("it moves `{path}` of light {number}, which is not a spot light")));
    }
    Ok(Some(AnimationTarget::Light(number, shine)))
}

fn material(root: &Root, number: usize, path: &str) -> Result<Option<AnimationTarget>, Error> {
    let finish = match path {
        "pbrMetallicRoughness/baseColorFactor" => MaterialProperty::Base,
        "pbrMetallicRoughness/roughnessFactor" => MaterialProperty::Roughness,
        "emissiveFactor" => MaterialProperty::Emissive,
        "alphaCutoff" => MaterialProperty::Cutoff,
        "extensions/KHR_materials_transmission/transmissionFactor" => MaterialProperty::Transmission,
        _ => return Ok(None),
    };
    let own = root.materials.get(number).ok_or_else(|| absent("material", number, root.materials.len()))?;
    let rest = material_reader::factors(own);
    let is_drawn = match finish {
        MaterialProperty::Base => !material_reader::is_glossy(own),
        MaterialProperty::Emissive => rest.emissive.is_some(),
        MaterialProperty::Cutoff => rest.mode == AlphaMode::Mask,
        MaterialProperty::Roughness | MaterialProperty::Transmission => true,
    };
    Ok(is_drawn.then_some(AnimationTarget::Material(number, finish)))
}

fn absent(kind: &str, number: usize, count: usize) -> Error {
    Error::new(format!("it moves {kind} {number}, but the file has {count}"))
}
