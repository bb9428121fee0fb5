//! Drawings with mesh, default and smooth contours on difficult random scenes, against ray casts.
//!
//! Nothing shows through another part, no outline is lost, and hiding a part changes only lines near it.

use crate::library::support::measures::line_picture;
use crate::library::support::references::drawing_judge;
use crate::library::support::references::line_visibility;
use crate::library::support::references::ray_casts;
use crate::library::support::references::textbook_camera;
use crate::library::support::references::triangle_scene;
use crate::library::support::references::visible_points;
use std::path::Path;

use crate::library::support::measures::segment_sets::{total_length, uncovered_length};
use crate::library::support::pipeline::{orthographic, perspective, scene};
use crate::library::support::references::drawing_judge::{centre_line, visible_line_marks};
use crate::library::support::references::line_visibility::{ReferenceLines, SampleVisibility};
use crate::library::support::scenes::hard_scenes::{
    HARD_SCENE_KINDS, camera_from_any_side, hard_scene, lathe,
};
use crate::library::support::scenes::random_dice::Dice;
use crate::library::support::scenes::round_solids::icosphere;
use crate::library::support::scenes::solids::{Solid, cuboid};
use glam::DVec3;
use kurbo::Point;
use ligne::drawing::Drawing;
use ligne::lines::{Contours, LineOptions};
use ligne::pipeline::render;
use ligne::scene::{Camera, Scene};
use ligne::style::Style;
use rayon::prelude::*;

const ALL_CONTOURS: [Contours; 3] = [Contours::Mesh, Contours::Auto, Contours::Smooth];

/// Largest distance of ink from the polygon due to smoothing and joining. `MAX_ROUNDING_SHARE` adds 15 % of the length
/// of a rounded edge.
const MAX_SMOOTHING_PX: f64 = 2.5;
const MAX_ROUNDING_SHARE: f64 = 0.15;
/// Tolerated length of wrong ink, such as an overrun at a line end, px.
const MAX_WRONG_INK_PX: f64 = 3.0;

fn draw(scene: &Scene, camera: &Camera, contours: Contours) -> Drawing {
    let mut style = Style::preset("ink").unwrap();
    style.lines.contours = contours;
    render(scene, camera, &style).unwrap()
}

fn strokes(drawing: &Drawing) -> Vec<[Point; 2]> {
    visible_line_marks(drawing).flat_map(centre_line).collect()
}

/// Runs a check on random scenes of all kinds with all contours, and fails with one line per failure.
fn check_random_scenes(
    seeds: std::ops::Range<u64>,
    check: impl Fn(&str, u64, Contours) -> Result<(), String> + Sync,
) {
    let jobs: Vec<(&str, u64, Contours)> = HARD_SCENE_KINDS
        .iter()
        .flat_map(|kind| seeds.clone().flat_map(|seed| ALL_CONTOURS.map(|contours| (*kind, seed, contours))))
        .collect();
    let wrong: Vec<String> = jobs
        .par_iter()
        .filter_map(|(kind, seed, contours)| {
            check(kind, *seed, *contours)
                .err()
                .map(|words| format!("{kind}, seed {seed}, {contours:?}: {words}"))
        })
        .collect();
    assert!(wrong.is_empty(), "{} of {} fail\n{}", wrong.len(), jobs.len(), wrong.join("\n"));
}

fn random_scene_and_camera(kind: &str, seed: u64) -> (Scene, Camera) {
    let mut dice = Dice::new(seed);
    (hard_scene(kind, &mut dice), camera_from_any_side(&mut dice))
}

#[test]
fn no_visible_point_is_hidden_by_another_part() {
    check_random_scenes(0..4, |kind, seed, contours| {
        let (scene, camera) = random_scene_and_camera(kind, seed);
        // Rounded lines and their ends lie next to the polygon.
        let excused = if contours == Contours::Mesh { 0.75 } else { MAX_SMOOTHING_PX };
        let options = LineOptions { contours, ..LineOptions::default() };
        let shown = visible_points::hidden_by_others(&scene, &camera, &options, excused);
        let words = || format!("{} of {} places, the first at {:?}", shown.hidden, shown.tested, shown.first);
        if 2.0 * shown.hidden as f64 <= MAX_WRONG_INK_PX { Ok(()) } else { Err(words()) }
    });
}

#[test]
fn no_ink_lies_where_another_part_hides_every_line() {
    check_random_scenes(4..7, |kind, seed, contours| {
        let (scene, camera) = random_scene_and_camera(kind, seed);
        let tolerance = if contours == Contours::Mesh { MAX_SMOOTHING_PX } else { 2.0 * MAX_SMOOTHING_PX };
        let through = drawing_judge::compare_with_reference(
            &ReferenceLines::of(&scene, &camera),
            &draw(&scene, &camera, contours),
            tolerance,
        )
        .through;
        if through.share * through.of <= 2.0 { Ok(()) } else { Err(format!("{through:?}")) }
    });
}

#[test]
fn every_point_of_the_outline_has_ink() {
    check_random_scenes(7..10, |kind, seed, contours| {
        let (scene, camera) = random_scene_and_camera(kind, seed);
        let truth = ReferenceLines::of(&scene, &camera);
        let eye = textbook_camera::TextbookCamera::new(&camera);
        let drawn = strokes(&draw(&scene, &camera, contours));
        let far = line_picture::SegmentGrid::new(drawn, 60.0);
        let (mut lost, mut all, mut first) = (0.0, 0.0, None);
        let page = kurbo::Rect::new(0.0, 0.0, camera.width, camera.height).inset(-MAX_SMOOTHING_PX);
        let outline = |place: &&line_visibility::LineSample| {
            place.is_silhouette && place.state == SampleVisibility::Visible
        };
        for place in truth.samples.iter().filter(outline).filter(|place| page.contains(place.at)) {
            let [a, b] = truth.lines[place.line as usize].ends.map(|end| eye.project(end));
            let rounding =
                if contours == Contours::Mesh { 0.0 } else { MAX_ROUNDING_SHARE * (b - a).hypot2().sqrt() };
            all += place.length();
            if far.distance(place.at) > MAX_SMOOTHING_PX + rounding {
                lost += place.length();
                first = first.or(Some(place.at));
            }
        }
        if lost <= 0.002 * all {
            Ok(())
        } else {
            Err(format!("{lost:.0} of {all:.0} px lost, first at {first:?}"))
        }
    });
}

/// Compares drawings with and without a part under a fixed camera. Lines away from the part must stay, except
/// for refitted lines of another length and short faint lines.
fn check_that_hiding_is_local(
    scene: &Scene,
    camera: &Camera,
    part: usize,
    contours: Contours,
) -> Result<(), String> {
    /// Largest shift of a line whose end changes, px.
    const MAX_REFIT_PX: f64 = 0.5;
    /// A faint crease that the part shortens to less than this length may disappear, px.
    const MAX_FAINT_LINE_PX: f64 = 100.0;
    // Radius around the picture of the part within which marks may change. Rounded lines need more.
    let near = if contours == Contours::Mesh { 4.0 } else { 12.0 };
    let hidden = &scene.parts[part];
    let only = Scene { parts: vec![hidden.clone()], ..scene.clone() };
    let rest = scene.parts.iter().enumerate().filter(|(id, _)| *id != part).map(|(_, p)| p.clone());
    let without = Scene { parts: rest.collect(), ..scene.clone() };
    let (polygons, eye) =
        (triangle_scene::TriangleScene::of(&only), textbook_camera::TextbookCamera::new(camera));
    let rays = ray_casts::RayCaster::new(&polygons, &eye, camera.width, camera.height);
    let is_far = |at: Point| {
        let rings = [0.25, 0.5, 0.75, 1.0].into_iter().flat_map(|k| ray_casts::circle_points(at, near * k));
        std::iter::once(at).chain(rings).all(|p| rays.is_background(p))
    };
    let [with, without] = [scene, &without].map(|scene| draw(scene, camera, contours));
    for (one, other) in [(&with, &without), (&without, &with)] {
        let other = line_picture::SegmentGrid::new(strokes(other), 1.0);
        let (mut length, mut first) = (0.0, None);
        for mark in
            visible_line_marks(one).filter(|mark| mark.provenance.part.as_deref() != Some(&hidden.name))
        {
            let places = line_picture::sample_segments(&centre_line(mark), 1.0);
            let (far, beside): (Vec<_>, Vec<_>) = places.into_iter().partition(|(at, _)| is_far(*at));
            let (moved, stays): (Vec<_>, Vec<_>) =
                far.into_iter().partition(|(at, _)| other.distance(*at) > MAX_REFIT_PX);
            let own: f64 = moved.iter().map(|(_, length)| length).sum();
            let is_faint = mark.provenance.classes.contains(&"crease") || stays.len() < moved.len();
            let is_crumb = !beside.is_empty() && is_faint && own < MAX_FAINT_LINE_PX;
            if !is_crumb && own > 0.0 {
                length += own;
                first = first.or(Some(moved[0].0));
            }
        }
        if let Some(first) = first.filter(|_| length > MAX_WRONG_INK_PX) {
            return Err(format!("without {} {length:.0} px change, the first at {first}", hidden.name));
        }
    }
    Ok(())
}

#[test]
fn hiding_a_part_of_a_random_scene_changes_lines_near_it_only() {
    check_random_scenes(14..16, |kind, seed, contours| {
        let (scene, camera) = random_scene_and_camera(kind, seed);
        (0..2).try_for_each(|k| {
            check_that_hiding_is_local(&scene, &camera, (k * 3 + seed as usize) % scene.parts.len(), contours)
        })
    });
}

#[test]
fn hiding_a_part_of_a_model_changes_lines_near_it_only() {
    let jobs = [("shaft.obj", 5), ("castle.obj", 3), ("goose.obj", 3), ("horn.obj", 2), ("street.glb", 20)];
    let wrong: Vec<String> = jobs
        .par_iter()
        .flat_map_iter(|(name, part)| ALL_CONTOURS.map(|contours| (*name, *part, contours)))
        .filter_map(|(name, part, contours)| {
            let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/models").join(name);
            let scene = Scene::open(path).unwrap();
            let camera = Camera::three_quarter_of(scene.up).fit(&scene);
            check_that_hiding_is_local(&scene, &camera, part, contours)
                .err()
                .map(|words| format!("{name}, {contours:?}: {words}"))
        })
        .collect();
    assert!(wrong.is_empty(), "{} fail\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn a_rod_behind_a_wall_is_hidden_at_any_tessellation() {
    let wall = cuboid(DVec3::new(-2.0, -2.0, 0.0), DVec3::new(2.0, 2.0, 0.2));
    let camera = perspective(DVec3::new(1.0, 0.8, 12.0), DVec3::ZERO, 30.0);
    for contours in ALL_CONTOURS {
        let alone = strokes(&draw(&scene([wall.clone()]), &camera, contours));
        assert!(total_length(&alone) > 500.0);
        for rings in [1, 4, 32] {
            for sides in [8, 16, 32] {
                let mut profile = vec![(0.0, -1.9), (0.24, -1.9)];
                profile.extend((0..=rings).map(|k| (0.3, -1.84 + 3.68 * f64::from(k) / f64::from(rings))));
                profile.extend([(0.24, 1.9), (0.0, 1.9)]);
                let behind = |solid: Solid| solid.moved(|p| DVec3::new(p.x, p.z, p.y - 3.0));
                let rod = behind(lathe(&profile, sides));
                let ball = behind(icosphere(2));
                let both = strokes(&draw(&scene([wall.clone(), rod, ball]), &camera, contours));
                let extra = uncovered_length(&both, &alone, 0.01);
                assert!(extra < 0.05, "{extra} px show through with {rings} rings of {sides}, {contours:?}");
            }
        }
    }
}

/// Length of ink between two y coordinates of the page.
fn length_between(strokes: &[[Point; 2]], [low, high]: [f64; 2]) -> f64 {
    let inside = |[a, b]: &[Point; 2]| {
        let (from, to) = (a.y.min(b.y), a.y.max(b.y));
        let part = (to.min(high) - from.max(low)).max(0.0);
        let share =
            if to > from { part / (to - from) } else { f64::from(u8::from(from > low && from < high)) };
        share * (*b - *a).hypot()
    };
    strokes.iter().map(inside).sum()
}

#[test]
fn outlines_stop_at_a_thin_rod_in_front_of_them() {
    const UNITS_PER_PX: f64 = 1.0 / 250.0;
    let camera = orthographic(DVec3::new(0.0, 0.0, 12.0), DVec3::ZERO, 1000.0 * UNITS_PER_PX);
    for contours in ALL_CONTOURS {
        for width in [2.0, 4.0, 6.0, 9.0] {
            for height in [-0.3, 0.0, 0.45] {
                let rod = cuboid(
                    DVec3::new(-1.9, height, 1.5),
                    DVec3::new(1.9, height + width * UNITS_PER_PX, 1.55),
                );
                let both = strokes(&draw(&scene([icosphere(3), rod]), &camera, contours));
                let rows = [height + width * UNITS_PER_PX, height].map(|y| 500.0 - y / UNITS_PER_PX);
                let across = length_between(&both, [rows[0] + 0.3, rows[1] - 0.3]);
                let ends = 2.0 * (width - 0.6);
                assert!(across <= ends + 1e-6, "{across} px across {width} px at {height}, {contours:?}");
            }
        }
    }
}
