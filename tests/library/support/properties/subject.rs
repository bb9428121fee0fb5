//! Scenes with cameras that the properties are tested on: random, constructed, or read from files.

use std::ops::Range;
use std::path::{Path, PathBuf};

use glam::{DAffine3, DVec3};
use ligne::scene::{Camera, Geometry, Part, Scene};

use crate::library::support::pipeline::{orthographic, perspective, scene, solid_geometry};
use crate::library::support::readers::shared_folder;
use crate::library::support::scenes::hard_scenes::{
    HARD_SCENE_KINDS, camera_from_any_side, hard_scene, hard_solids,
};
use crate::library::support::scenes::random_dice::Dice;
use crate::library::support::scenes::random_scenes::{random_camera, random_scene};
use crate::library::support::scenes::round_solids::{icosphere, saddle};
use crate::library::support::scenes::solids::{Solid, cuboid, sphere, torus, tube};

/// A scene and its camera.
#[derive(Debug, Clone)]
pub(crate) struct Subject {
    pub name: String,
    pub scene: Scene,
    pub camera: Camera,
    /// World-space boxes that are hidden from the camera, as opposite corners.
    pub hidden_boxes: Vec<[DVec3; 2]>,
    /// Objects that may be put into the hidden boxes.
    pub hideable: Vec<Geometry>,
}

impl Subject {
    pub(crate) fn new(name: impl Into<String>, scene: Scene, camera: Camera) -> Self {
        Self { name: name.into(), scene, camera, hidden_boxes: Vec::new(), hideable: Vec::new() }
    }

    /// A scene from the default view, in a square frame with sides of `side` px.
    pub(crate) fn framed(name: impl Into<String>, scene: Scene, side: f64) -> Self {
        let mut camera = Camera::three_quarter_of(scene.up);
        (camera.width, camera.height) = (side, side);
        let camera = camera.fit(&scene);
        Self::new(name, scene, camera)
    }
}

/// One random scene for each kind and each kind of camera.
pub(crate) fn random_subjects(kinds: &[&str], cameras: &[&str], seed: u64) -> Vec<Subject> {
    let one = |kind: &str, camera: &str| {
        let mut dice = Dice::new(seed);
        let (scene, seen) = (random_scene(kind, &mut dice), random_camera(camera, &mut dice));
        Subject::new(format!("{kind}, {camera}, seed {seed}"), scene, seen)
    };
    kinds.iter().flat_map(|kind| cameras.iter().map(|camera| one(kind, camera))).collect()
}

/// A random scene of each kind in `HARD_SCENE_KINDS`, for each seed.
pub(crate) fn hard_subjects(seeds: Range<u64>) -> Vec<Subject> {
    let one = |kind: &str, seed: u64| {
        let mut dice = Dice::new(seed);
        let (scene, camera) = (hard_scene(kind, &mut dice), camera_from_any_side(&mut dice));
        Subject::new(format!("{kind}, seed {seed}"), scene, camera)
    };
    HARD_SCENE_KINDS.iter().flat_map(|kind| seeds.clone().map(|seed| one(kind, seed))).collect()
}

/// Every second subject on a small page, for styles that draw slowly.
pub(crate) fn every_second_on_small_page(subjects: Vec<Subject>) -> Vec<Subject> {
    let mut few: Vec<Subject> = subjects.into_iter().step_by(2).collect();
    few.iter_mut().for_each(|few| (few.camera.width, few.camera.height) = (400.0, 400.0));
    few
}

/// The scenes of `HARD_SCENE_KINDS`, shrunk to the right half, with a wall on the left.
///
/// Copies of their parts can be hidden behind the wall, near and far.
pub(crate) fn next_to_wall(seed: u64) -> Vec<Subject> {
    let one = |kind: &str| {
        let parts = hard_solids(kind, &mut Dice::new(seed));
        let wall = cuboid(DVec3::new(-1.4, -0.8, 0.3), DVec3::new(-0.2, 0.8, 0.4));
        let hideable = parts.iter().cloned().map(solid_geometry).collect();
        let small = parts.into_iter().map(|part| part.moved(|p| p * 0.4 + DVec3::X * 0.75));
        let camera = orthographic(DVec3::new(0.0, 0.0, 9.0), DVec3::ZERO, 3.6);
        let behind = |from: f64, to: f64| [DVec3::new(-1.3, -0.7, from), DVec3::new(-0.3, 0.7, to)];
        let unseen = vec![behind(-1.6, 0.2), behind(-21.0, -19.0)];
        let name = format!("{kind} beside a wall, seed {seed}");
        Subject { hidden_boxes: unseen, hideable, ..Subject::new(name, scene(small.chain([wall])), camera) }
    };
    HARD_SCENE_KINDS.iter().map(|kind| one(kind)).collect()
}

/// A closed box with hidden space inside and behind, in perspective and orthographic views.
pub(crate) fn box_shells() -> Vec<Subject> {
    let eye = DVec3::new(1.0, 0.5, 9.0);
    let mut dice = Dice::new(14);
    let mut one = |name: &str, camera: Camera| {
        let hideable = random_scene("mixture", &mut dice).geometries;
        let shell = cuboid(DVec3::new(-2.0, -2.0, -1.0), DVec3::new(2.0, 2.0, 1.0));
        let inside = [DVec3::new(-1.9, -1.9, -0.9), DVec3::new(1.9, 1.9, 0.9)];
        let behind = [DVec3::new(-1.0, -1.0, -3.0), DVec3::new(1.0, 1.0, -2.0)];
        let unseen = vec![inside, behind];
        Subject { hidden_boxes: unseen, hideable, ..Subject::new(name, scene([shell]), camera) }
    };
    vec![
        one("a shell, perspective", perspective(eye, DVec3::ZERO, 35.0)),
        one("a shell, orthographic", orthographic(eye, DVec3::ZERO, 5.0)),
    ]
}

fn round_solids() -> Vec<(&'static str, Solid)> {
    let mut two = icosphere(2);
    two.add(torus(24, 12, 1.0, 0.3).moved(|p| DVec3::new(p.x + 0.7, p.z, p.y)));
    vec![
        ("torus", torus(24, 12, 1.0, 0.4)),
        ("sphere", icosphere(2)),
        ("ellipsoid", icosphere(3).moved(|p| p * DVec3::new(1.5, 1.0, 0.5))),
        ("saddle", saddle(16)),
        ("ring through a sphere", two),
        ("bulging tube", tube(24, 24, 0.6, 1.0).moved(|p| p * DVec3::new(1.0 + 0.4 * p.z * p.z, 1.0, 1.0))),
    ]
}

/// Rounded solids from the first `cameras` of three cameras.
pub(crate) fn rounded(cameras: usize) -> Vec<Subject> {
    round_solids().into_iter().flat_map(|solid| rounded_from_cameras(solid, cameras)).collect()
}

/// The closed rounded solids, from one camera.
pub(crate) fn rounded_closed() -> Vec<Subject> {
    let closed = round_solids().into_iter().filter(|(name, _)| !["saddle", "bulging tube"].contains(name));
    closed.flat_map(|solid| rounded_from_cameras(solid, 1)).collect()
}

/// Open surfaces from one camera that sees both sides.
pub(crate) fn open_surfaces() -> Vec<Subject> {
    let tubes = round_solids().into_iter().filter(|(name, _)| *name == "bulging tube");
    let uneven = |p: DVec3| p + DVec3::Z * (0.05 * p.x + 0.03 * p.y + (0.1 * p.x + 0.2 * p.y) * p.x * p.x);
    let uneven_saddle = ("uneven saddle", saddle(16).moved(uneven));
    tubes.chain([uneven_saddle]).flat_map(|solid| rounded_from_cameras(solid, 1)).collect()
}

fn rounded_from_cameras((name, solid): (&str, Solid), cameras: usize) -> Vec<Subject> {
    let all = [
        perspective(DVec3::new(3.1, -4.2, 2.3), DVec3::new(0.1, 0.0, -0.1), 35.0),
        perspective(DVec3::new(-2.0, 0.9, 5.4), DVec3::ZERO, 40.0),
        orthographic(DVec3::new(1.3, 4.0, 1.9), DVec3::ZERO, 4.5),
    ];
    let one = |camera: &Camera| {
        Subject::new(format!("{name} from {}", camera.eye), scene([solid.clone()]), *camera)
    };
    all[..cameras].iter().map(one).collect()
}

/// Two boxes and a ball, seen along the faces of the boxes and obliquely.
pub(crate) fn along_faces() -> Vec<Subject> {
    let all = || {
        [
            cuboid(DVec3::new(-1.5, -0.5, -1.0), DVec3::new(1.5, 0.5, 0.0)),
            cuboid(DVec3::new(-1.0, -0.5, 0.0), DVec3::new(0.0, 0.5, 0.8)),
            sphere(16, 0.6).moved(|p| p + DVec3::new(0.9, -0.1, 0.6)),
        ]
    };
    let seen = |name: &str, eye: DVec3| {
        let mut camera = orthographic(eye, DVec3::ZERO, 4.0);
        (camera.width, camera.height) = (300.0, 300.0);
        Subject::new(name, scene(all()), camera)
    };
    vec![
        seen("boxes and a ball, front", DVec3::NEG_Y * 9.0),
        seen("boxes and a ball, slanting", DVec3::new(4.0, -7.0, 5.0)),
    ]
}

/// Flat sheets side by side, some with their back to the camera.
pub(crate) fn upright_sheets() -> Subject {
    let sheet = |k: u32| {
        let left = DVec3::X * 1.5 * f64::from(k);
        let positions = [[0.0, 0.0], [1.0, 0.0], [1.0, 2.0], [0.0, 2.0]];
        let positions = positions.map(|[x, z]| left + DVec3::new(x, 0.2 * x, z)).to_vec();
        let triangles =
            if k.is_multiple_of(3) { vec![[0, 1, 2], [0, 2, 3]] } else { vec![[0, 2, 1], [0, 3, 2]] };
        Solid { positions, triangles }
    };
    let mut camera = perspective(DVec3::new(2.0, -8.0, 3.0), DVec3::new(2.5, 0.0, 1.0), 40.0);
    (camera.width, camera.height) = (400.0, 400.0);
    Subject::new("upright sheets", scene((0..4).map(sheet)), camera)
}

/// A torus.
pub(crate) fn ring() -> Subject {
    Subject::framed("a ring", scene([torus(64, 32, 1.0, 0.4)]), 1000.0)
}

pub(crate) fn ring_with_box() -> Subject {
    let solids = [torus(40, 20, 1.0, 0.4), cuboid(DVec3::splat(-0.3), DVec3::splat(0.3))];
    Subject::framed("a ring around a box", scene(solids), 400.0)
}

pub(crate) fn ring_with_ball() -> Subject {
    let solids = [torus(96, 48, 1.0, 0.4), sphere(40, 0.5)];
    Subject::framed("a ring around a ball", scene(solids), 1000.0)
}

/// Intersecting solids, each placed by its part's transform.
pub(crate) fn intersecting_solids() -> Vec<Subject> {
    let mut dice = Dice::new(5);
    let one = |round: usize| {
        let mut scene = Scene::default();
        for k in 0..8 {
            let half = DVec3::new(dice.between(0.3, 1.0), dice.between(0.3, 1.0), dice.between(0.3, 1.0));
            let solid = match k % 3 {
                0 => cuboid(-half, half),
                1 => sphere(24, half.x),
                _ => tube(24, 3, half.x / 2.0, 2.0 * half.y),
            };
            let place = DAffine3::from_mat3_translation(dice.turn(), dice.point(0.9));
            scene.geometries.push(solid_geometry(solid));
            scene.parts.push(Part { name: format!("part {k}"), geometry: k, world_from_part: place });
        }
        Subject::framed(format!("solids through each other, {round}"), scene, 500.0)
    };
    (0..4).map(one).collect()
}

/// Cubes that differ only in position.
pub(crate) fn equal_cubes() -> Subject {
    let mut dice = Dice::new(6);
    let cube = |k: usize| Part {
        name: format!("cube {k}"),
        geometry: 0,
        world_from_part: DAffine3::from_translation(dice.point(0.9)),
    };
    let parts = (0..5).map(cube).collect();
    let geometries = vec![solid_geometry(cuboid(DVec3::NEG_ONE, DVec3::ONE))];
    Subject::framed("equal cubes", Scene { geometries, parts, ..Scene::default() }, 500.0)
}

/// The path of an example model.
pub(crate) fn example_path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/models").join(name)
}

/// Example models in a square frame.
pub(crate) fn examples(names: &[&str], side: f64) -> Vec<Subject> {
    names.iter().map(|name| Subject::framed(*name, Scene::open(example_path(name)).unwrap(), side)).collect()
}

/// Shared models in a square frame; absent ones are left out.
pub(crate) fn shared(names: &[&str], side: f64) -> Vec<Subject> {
    let found = names.iter().filter_map(|name| Some((name, shared_folder::find(name)?)));
    found.map(|(name, path)| Subject::framed(*name, Scene::open(path).unwrap(), side)).collect()
}
