//! Cameras and lights of the scene, placed in the world by their nodes.

use std::f64::consts::{FRAC_PI_4, PI};

use glam::{DAffine3, DVec3};

use super::hierarchy::Hierarchy;
use crate::animation::rig::NodeAttachment;
use crate::load::gltf::json::lenient_index::DisplayIndex;
use crate::load::gltf::json::{Camera as JsonCamera, Light as JsonLight, Root};
use crate::scene::warnings::WarningExamples;
use crate::scene::{Camera, Light, LightKind, NamedCamera, Projection, Warnings};

/// Height of the frame of a file's camera, px.
const FRAME_HEIGHT_PX: f64 = 1000.0;

/// Cameras of visible nodes, with their number in the file and their node.
pub(crate) fn cameras(
    root: &Root,
    nodes: &Hierarchy,
    warnings: &mut Warnings,
) -> (Vec<NamedCamera>, Vec<NodeAttachment>) {
    let (mut cameras, mut holders) = (Vec::new(), Vec::new());
    let mut missing = WarningExamples::default();
    for (index, node, world) in shown(root, nodes) {
        let Some(number) = node.camera else { continue };
        let Some(camera) = root.cameras.get(number) else {
            missing.add(|| {
                let (camera, count) = (DisplayIndex(number), root.cameras.len());
                format!(
                    "node {index}: has camera {camera}, but the file has {count}; there is no view from it"
                )
            });
            continue;
        };
        let named = [&camera.name, &node.name].into_iter().flatten().find(|name| !name.is_empty());
        let name = named.cloned().unwrap_or_else(|| format!("camera {number}"));
        match camera_of_node(camera, world) {
            Some(camera) => {
                cameras.push(NamedCamera { name, camera });
                holders.push(NodeAttachment { number, node: index });
            }
            None => warnings.note(format!("camera `{name}` sees nothing and is left out")),
        }
    }
    missing.warn(warnings);
    (cameras, holders)
}

/// Camera of a node: at its origin, looking along -z with y up. As glTF specifies, the node's scale has no
/// other effect.
fn camera_of_node(camera: &JsonCamera, world: DAffine3) -> Option<Camera> {
    let (projection, aspect, near) = if let Some(lens) = &camera.perspective {
        let fov_y_deg = Some(lens.yfov).filter(|angle| *angle > 0.0 && *angle < PI)?.to_degrees();
        (Projection::Perspective { fov_y_deg }, lens.aspect_ratio, lens.znear.filter(|near| *near > 0.0))
    } else {
        let lens = camera.orthographic.as_ref()?;
        let height = Some(2.0 * lens.ymag.abs()).filter(|height| *height > 0.0)?;
        (Projection::Orthographic { height }, Some((lens.xmag / lens.ymag).abs()), lens.znear)
    };
    let aspect = aspect.filter(|aspect| aspect.is_finite() && *aspect > 0.0).unwrap_or(1.0);
    let eye = world.translation;
    Some(Camera {
        eye,
        target: eye + world.transform_vector3(DVec3::NEG_Z).try_normalize()?,
        up: world.transform_vector3(DVec3::Y).try_normalize()?,
        projection,
        width: FRAME_HEIGHT_PX * aspect,
        height: FRAME_HEIGHT_PX,
        near: near.filter(|near| near.is_finite()),
    })
}

/// Lights of visible nodes (KHR_lights_punctual), with their number in the file and their node.
pub(crate) fn lights(
    root: &Root,
    nodes: &Hierarchy,
    warnings: &mut Warnings,
) -> (Vec<Light>, Vec<NodeAttachment>) {
    let known = root.extensions.lights.as_ref().map_or(&[][..], |lights| &lights.lights);
    let (mut lights, mut holders) = (Vec::new(), Vec::new());
    let mut missing = WarningExamples::default();
    for (index, node, world) in shown(root, nodes) {
        let Some(number) = node.extensions.light.as_ref().map(|light| light.light) else { continue };
        let Some(light) = known.get(number) else {
            missing.add(|| {
                let (light, count) = (DisplayIndex(number), known.len());
                format!("node {index}: has light {light}, but the file has {count}; it gives no light")
            });
            continue;
        };
        match kind(light, world) {
            Some(kind) => {
                lights.push(Light {
                    name: light.name.clone().or_else(|| node.name.clone()).unwrap_or_default(),
                    kind,
                    colour: light.color.unwrap_or([1.0; 3]),
                    intensity: light.intensity.unwrap_or(1.0),
                    range: light.range,
                });
                holders.push(NodeAttachment { number, node: index });
            }
            None => warnings.note(format!("light {number} of unknown kind or without direction is left out")),
        }
    }
    missing.warn(warnings);
    (lights, holders)
}

fn kind(light: &JsonLight, world: DAffine3) -> Option<LightKind> {
    let position = world.translation;
    let direction = world.transform_vector3(DVec3::NEG_Z).try_normalize();
    Some(match light.kind.as_str() {
        "directional" => LightKind::Directional { direction: direction? },
        "point" => LightKind::Point { position },
        "spot" => LightKind::Spot {
            position,
            direction: direction?,
            inner_angle: light.spot.inner_cone_angle.unwrap_or(0.0),
            outer_angle: light.spot.outer_cone_angle.unwrap_or(FRAC_PI_4),
        },
        _ => return None,
    })
}

fn shown<'a>(
    root: &'a Root,
    nodes: &'a Hierarchy,
) -> impl Iterator<Item = (usize, &'a crate::load::gltf::json::Node, DAffine3)> {
    nodes.shown.iter().filter_map(|&index| Some((index, root.nodes.get(index)?, *nodes.world.get(index)?)))
}
