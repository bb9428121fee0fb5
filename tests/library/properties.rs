//! What must not change a drawing: motion of scene and camera together, size, order, cuts of flat
//! faces, things that are hidden.

use crate::support::dice::Dice;
use crate::support::pipeline::{counting, exact, orthographic, perspective, scene, stages};
use crate::support::scenes::{random_camera, random_scene};
use crate::support::segments::{cover_alike, doubled, length, uncovered};
use crate::support::solids::cuboid;
use glam::{DMat3, DVec3};
use kurbo::Point;
use ligne::drawing::{Length, Unit};
use ligne::scene::{Camera, Projection, Scene};
use ligne::stages::chain::{self, ChainOptions};
use ligne::stages::lines::HiddenLines;

const KINDS: [&str; 5] = ["boxes", "tori", "soup", "interpenetrating", "mixture"];
const CAMERAS: [&str; 3] = ["perspective", "orthographic", "cutting"];

fn visible(scene: &Scene, camera: &Camera) -> Vec<[Point; 2]> {
    stages(scene, camera, &exact()).visible()
}

/// Runs a check on one random scene of each kind and camera.
fn for_scenes(seed: u64, check: impl Fn(&Scene, &Camera, &mut Dice) -> Result<(), String>) {
    for kind in KINDS {
        for camera_kind in CAMERAS {
            let mut dice = Dice::new(seed);
            let (scene, camera) = (random_scene(kind, &mut dice), random_camera(camera_kind, &mut dice));
            check(&scene, &camera, &mut dice).unwrap_or_else(|m| panic!("{kind}, {camera_kind}: {m}"));
        }
    }
}

/// The scene and the camera turned, scaled and moved.
fn moved(scene: &Scene, camera: &Camera, turn: DMat3, scale: f64, by: DVec3) -> (Scene, Camera) {
    let place = |p: DVec3| turn * p * scale + by;
    let mut scene = scene.clone();
    for geometry in &mut scene.geometries {
        geometry.positions.iter_mut().for_each(|p| *p = place(*p));
    }
    let projection = match camera.projection {
        Projection::Orthographic { height } => Projection::Orthographic { height: height * scale },
        same @ Projection::Perspective { .. } => same,
    };
    let (eye, target, up) = (place(camera.eye), place(camera.target), turn * camera.up);
    let near = camera.near.map(|near| near * scale);
    (scene, Camera { eye, target, up, projection, near, ..*camera })
}

fn unmoved(turned: bool, scale: f64, by: DVec3, nearness: f64, slack: f64) {
    for_scenes(11, |scene, camera, dice| {
        let turn = if turned { dice.turn() } else { DMat3::IDENTITY };
        let (there, camera_there) = moved(scene, camera, turn, scale, by);
        cover_alike(&visible(scene, camera), &visible(&there, &camera_there), nearness, slack)
    });
}

#[test]
fn a_rigid_motion_changes_nothing() {
    unmoved(true, 1.0, DVec3::new(3.0, -2.0, 7.0), 1e-6, 0.02);
}

#[test]
fn size_changes_nothing() {
    unmoved(false, 1e-6, DVec3::ZERO, 1e-6, 0.02);
    unmoved(false, 1e9, DVec3::ZERO, 1e-6, 0.02);
}

#[test]
fn a_place_far_from_the_origin_changes_nothing() {
    // At 1e6 a coordinate is exact to 1e-10, of which each unit takes some hundred px.
    unmoved(false, 1.0, DVec3::new(1e6, -1e6, 1e6), 1e-5, 0.05);
}

#[test]
fn order_of_faces_and_vertices_changes_nothing() {
    for_scenes(12, |scene, camera, dice| {
        let mut mixed = scene.clone();
        for geometry in &mut mixed.geometries {
            let order = dice.shuffled((0..geometry.positions.len() as u32).collect());
            let mut new_id = vec![0; order.len()];
            order.iter().enumerate().for_each(|(new, old)| new_id[*old as usize] = new as u32);
            geometry.positions = order.iter().map(|old| geometry.positions[*old as usize]).collect();
            let turned = |t: &[u32; 3]| {
                let [a, b, c] = t.map(|v| new_id[v as usize]);
                [b, c, a]
            };
            geometry.triangles = dice.shuffled(geometry.triangles.iter().map(turned).collect());
        }
        cover_alike(&visible(scene, camera), &visible(&mixed, camera), 1e-9, 0.02)
    });
}

#[test]
fn splitting_flat_faces_changes_nothing() {
    for_scenes(13, |scene, camera, dice| {
        let mut split = scene.clone();
        for geometry in &mut split.geometries {
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
        // The new vertices lie in their planes up to rounding only.
        cover_alike(&visible(scene, camera), &visible(&split, camera), 1e-6, 0.05)
    });
}

#[test]
fn what_is_hidden_changes_nothing_visible() {
    let mut dice = Dice::new(14);
    for camera in [
        perspective(DVec3::new(1.0, 0.5, 9.0), DVec3::ZERO, 35.0),
        orthographic(DVec3::new(1.0, 0.5, 9.0), DVec3::ZERO, 5.0),
    ] {
        // A closed box with things in it and behind it.
        let shell = || cuboid(DVec3::new(-2.0, -2.0, -1.0), DVec3::new(2.0, 2.0, 1.0));
        let alone = visible(&scene([shell()]), &camera);
        let mut inside = random_scene("mixture", &mut dice);
        for geometry in &mut inside.geometries {
            geometry.positions.iter_mut().for_each(|p| *p *= 0.4);
        }
        let mut full = scene([shell(), cuboid(DVec3::new(-1.0, -1.0, -3.0), DVec3::new(1.0, 1.0, -2.0))]);
        let first = full.geometries.len();
        full.geometries.extend(inside.geometries);
        full.parts.extend(inside.parts.into_iter().map(|mut part| {
            part.geometry += first;
            part
        }));
        cover_alike(&alone, &visible(&full, &camera), 1e-9, 1e-6).unwrap();
    }
}

#[test]
fn plain_chains_are_the_visible_lines_each_once() {
    let off = Length::px(0.0);
    let options =
        ChainOptions { smooth: off, simplify: off, tidy: off, fit: false, ..ChainOptions::default() };
    for_scenes(15, |scene, camera, _| {
        let drawn = stages(scene, camera, &counting());
        let chains = chain::link(&drawn.map, &options, Unit::Px, HiddenLines::None);
        let mut inked = Vec::new();
        for chain in chains.iter().filter(|c| c.invisibility == 0) {
            inked.extend(chain.points.windows(2).map(|w| [w[0], w[1]]));
            if let (true, [first, .., last]) = (chain.closed, chain.points.as_slice()) {
                inked.push([*last, *first]);
            }
        }
        let visible = drawn.visible();
        let lost = uncovered(&visible, &inked, 1e-6);
        let added = uncovered(&inked, &visible, 1e-6);
        if lost > 0.05 || added > 0.05 {
            return Err(format!("{lost} lost, {added} added of {}", length(&visible)));
        }
        let (twice, before) = (doubled(&inked, 1e-4), doubled(&visible, 1e-4));
        if twice > before + 0.05 || (length(&inked) - length(&visible)).abs() > 0.1 {
            return Err(format!("{twice} drawn twice, {before} before chaining"));
        }
        Ok(())
    });
}
