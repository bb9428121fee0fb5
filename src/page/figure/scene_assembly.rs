//! Moves whole scenes and joins scenes to one.

use glam::{DAffine3, DVec3};

use crate::scene::{Camera, LightKind, Projection, Scene};

/// Transforms everything in a scene: parts, lights, cameras and motion trails.
pub(crate) fn move_scene(scene: &mut Scene, to: DAffine3) {
    if to == DAffine3::IDENTITY {
        return;
    }
    let way = |v: DVec3| to.transform_vector3(v).try_normalize().unwrap_or(v);
    for part in &mut scene.parts {
        part.world_from_part = to * part.world_from_part;
    }
    for light in &mut scene.lights {
        light.kind = match light.kind {
            LightKind::Directional { direction } => LightKind::Directional { direction: way(direction) },
            LightKind::Point { position } => LightKind::Point { position: to.transform_point3(position) },
            LightKind::Spot { position, direction, inner_angle, outer_angle } => LightKind::Spot {
                position: to.transform_point3(position),
                direction: way(direction),
                inner_angle,
                outer_angle,
            },
        };
    }
    let scale = to.matrix3.determinant().abs().cbrt();
    for named in &mut scene.cameras {
        let Camera { eye, target, up, projection, near, .. } = named.camera;
        let projection = match projection {
            Projection::Orthographic { height } => Projection::Orthographic { height: height * scale },
            perspective => perspective,
        };
        named.camera = Camera {
            eye: to.transform_point3(eye),
            target: to.transform_point3(target),
            up: way(up),
            projection,
            near: near.map(|near| near * scale),
            ..named.camera
        };
    }
    for mover in scene.movers.iter_mut().flatten() {
        let points = mover.trails.iter_mut().flat_map(|trail| &mut trail.points);
        for point in points.chain(mover.body.iter_mut().flatten()) {
            *point = to.transform_point3(*point);
        }
    }
}

/// Appends everything in a scene to another one.
pub(crate) fn append_scene(all: &mut Scene, mut scene: Scene) {
    let materials = u32::try_from(all.materials.len()).unwrap_or(u32::MAX);
    let (geometries, parts) = (all.geometries.len(), all.parts.len());
    for geometry in &mut scene.geometries {
        // `u32::MAX` means the default material, which is not in the list.
        for material in geometry.triangle_material.iter_mut().chain(&mut geometry.material) {
            if *material != u32::MAX {
                *material = material.saturating_add(materials);
            }
        }
    }
    for part in &mut scene.parts {
        part.geometry += geometries;
    }
    let above = all.movers.as_ref().map_or(0, Vec::len);
    for mover in scene.movers.iter_mut().flatten() {
        mover.part += parts;
        mover.material = mover.material.map(|material| material.saturating_add(materials));
        mover.above = mover.above.map(|mover| mover + above);
    }
    all.geometries.append(&mut scene.geometries);
    all.parts.append(&mut scene.parts);
    all.materials.append(&mut scene.materials);
    all.lights.append(&mut scene.lights);
    all.cameras.append(&mut scene.cameras);
    all.warnings.extend(&scene.warnings);
    match (&mut all.movers, scene.movers) {
        (Some(all), Some(mut movers)) => all.append(&mut movers),
        (all @ None, movers) => *all = movers,
        (Some(_), None) => {}
    }
}
