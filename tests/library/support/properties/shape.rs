//! Changes to the shapes of a scene: similarity transforms, face splits and hidden objects.

use glam::{DAffine3, DMat3, DVec3};
use ligne::scene::{Camera, Geometry, Part, Projection, Scene};

use super::subject::Subject;
use crate::library::support::scenes::random_dice::Dice;

/// Scene and camera, rotated, scaled and moved together.
pub(crate) fn transformed(subject: &Subject, turn: DMat3, scale: f64, by: DVec3) -> Subject {
    let Subject { scene, camera, .. } = subject;
    assert!(scene.lights.is_empty(), "lights would have to move as well");
    let place = |p: DVec3| turn * p * scale + by;
    let mut scene = scene.clone();
    for part in &scene.parts {
        assert_eq!(part.world_from_part, DAffine3::IDENTITY, "shapes are moved, not their parts");
    }
    for geometry in &mut scene.geometries {
        geometry.positions.iter_mut().for_each(|p| *p = place(*p));
        for normal in &mut geometry.normals {
            *normal = (turn.as_mat3() * glam::Vec3::from(*normal)).to_array();
        }
    }
    let projection = match camera.projection {
        Projection::Orthographic { height } => Projection::Orthographic { height: height * scale },
        same @ Projection::Perspective { .. } => same,
    };
    let (eye, target, up) = (place(camera.eye), place(camera.target), turn * camera.up);
    let near = camera.near.map(|near| near * scale);
    let camera = Camera { eye, target, up, projection, near, ..*camera };
    Subject::new(subject.name.clone(), scene, camera)
}

/// The scene with each face split into three at a random point inside.
pub(crate) fn with_faces_split(scene: &Scene, dice: &mut Dice) -> Scene {
    let mut split = scene.clone();
    for geometry in &mut split.geometries {
        let of_faces = geometry.triangle_material.len() + geometry.edge_marks.len();
        let of_corners = geometry.corner_normals.len() + geometry.corner_uvs.len();
        assert!(of_faces + of_corners + geometry.colours.len() == 0, "this would have to be cut as well");
        let mut triangles = Vec::new();
        for &[a, b, c] in &geometry.triangles {
            let corners = [a, b, c].map(|v| geometry.positions[v as usize]);
            let (u, v) = (dice.between(0.2, 0.4), dice.between(0.2, 0.4));
            let middle = geometry.positions.len() as u32;
            geometry.positions.push(corners[0] * (1.0 - u - v) + corners[1] * u + corners[2] * v);
            triangles.extend([[a, b, middle], [b, c, middle], [c, a, middle]]);
        }
        geometry.triangles = triangles;
    }
    split
}

/// The scene with the subject's hideable objects added in its first hidden boxes.
pub(crate) fn with_hidden_objects(subject: &Subject, boxes: usize, dice: &mut Dice) -> Scene {
    let mut scene = subject.scene.clone();
    let is_room = (1..=subject.hidden_boxes.len()).contains(&boxes) && !subject.hideable.is_empty();
    assert!(is_room, "{} hides nothing there", subject.name);
    for unseen in &subject.hidden_boxes[..boxes] {
        let mut things = subject.hideable.clone();
        fit_into_box(*unseen, &mut things, dice);
        for thing in things {
            let geometry = scene.geometries.len();
            let name = format!("hidden {geometry}");
            scene.geometries.push(thing);
            scene.parts.push(Part { name, geometry, world_from_part: DAffine3::IDENTITY });
        }
    }
    scene
}

/// Rotates objects together and scales them to fit into a box.
fn fit_into_box([low, high]: [DVec3; 2], things: &mut [Geometry], dice: &mut Dice) {
    let turn = dice.turn();
    things.iter_mut().flat_map(|thing| &mut thing.positions).for_each(|p| *p = turn * *p);
    let all = || things.iter().flat_map(|thing| thing.positions.iter().copied());
    let (from, to) = (all().reduce(DVec3::min).unwrap(), all().reduce(DVec3::max).unwrap());
    let scale = ((high - low) / (to - from)).min_element();
    let place = |p: DVec3| (p - from.midpoint(to)) * scale + low.midpoint(high);
    things.iter_mut().flat_map(|thing| &mut thing.positions).for_each(|p| *p = place(*p));
}
