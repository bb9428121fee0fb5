//! Lines of every kind are silhouettes exactly if background lies on one side; rays at sample points next to
//! the lines are the reference.

use crate::library::support::pipeline::{
    exact_options, orthographic, run_stages, scene, scene_of_geometries, solid_geometry,
};
use crate::library::support::references::drawing_judge::{centre_line, visible_line_marks};
use crate::library::support::references::ray_casts::RayCaster;
use crate::library::support::references::textbook_camera::TextbookCamera;
use crate::library::support::references::triangle_scene::TriangleScene;
use crate::library::support::scenes::hard_scenes::{HARD_SCENE_KINDS, camera_from_any_side, hard_scene};
use crate::library::support::scenes::random_dice::Dice;
use crate::library::support::scenes::solids::{Solid, cuboid};
use glam::DVec3;
use kurbo::{Point, Vec2};
use ligne::lines::{LineKind, LineOptions};
use ligne::pipeline::render;
use ligne::scene::{Camera, Material, Scene};
use ligne::style::Style;
use rayon::prelude::*;

/// Kinds of lines that lie on surfaces and can be silhouettes.
const SURFACE_LINE_KINDS: [LineKind; 5] =
    [LineKind::Contour, LineKind::Border, LineKind::Crease, LineKind::Material, LineKind::Intersection];

/// Distances of the rays from the line, px. A sample is skipped if its rays disagree, because rounding then
/// decides.
const RAY_OFFSETS_PX: [f64; 4] = [5e-4, 1e-3, 2e-3, 1e-2];

/// Smallest distance of a sample from the ends of its line, px.
const MIN_END_DISTANCE_PX: f64 = 0.1;

/// Sample count, samples with background on one side by kind, and samples where the drawing is wrong.
#[derive(Default, Debug)]
struct SilhouetteTally {
    asked: usize,
    outline: [usize; 5],
    wrong: Vec<(Point, LineKind, bool)>,
}

fn compare(scene: &Scene, camera: &Camera, options: &LineOptions) -> SilhouetteTally {
    let polygons = TriangleScene::of(scene);
    let eye = TextbookCamera::new(camera);
    let rays = RayCaster::new(&polygons, &eye, camera.width, camera.height);
    let drawn = run_stages(scene, camera, options);
    let frame = kurbo::Rect::new(1.0, 1.0, camera.width - 1.0, camera.height - 1.0);
    let mut found = SilhouetteTally::default();
    for edge in drawn.map.edges.iter().filter(|edge| edge.invisibility == 0) {
        let Some(kind) = SURFACE_LINE_KINDS.iter().position(|kind| *kind == edge.kind) else { continue };
        let [a, b] = drawn.edge_ends(edge);
        let length = (b - a).hypot();
        let count = (length / 5.0).ceil().clamp(1.0, 20.0);
        for k in 0..count as usize {
            let share = (k as f64 + 0.5) / count;
            let at = a.lerp(b, share);
            if length * share.min(1.0 - share) < MIN_END_DISTANCE_PX || !frame.contains(at) {
                continue;
            }
            let across = Vec2::new(a.y - b.y, b.x - a.x) / length;
            let has_background = RAY_OFFSETS_PX.map(|aside| {
                [aside, -aside].into_iter().any(|aside| rays.is_background(at + across * aside))
            });
            if has_background.iter().any(|has| *has != has_background[0]) {
                continue;
            }
            found.asked += 1;
            found.outline[kind] += usize::from(has_background[0]);
            if has_background[0] != edge.silhouette {
                found.wrong.push((at, edge.kind, edge.silhouette));
            }
        }
    }
    found
}

/// A grid of random size, bent and wound at random.
fn sheet(dice: &mut Dice) -> Solid {
    let (columns, rows) = (1 + dice.below(4) as u32, 1 + dice.below(3) as u32);
    let at = |column: u32, row: u32, dice: &mut Dice| {
        let [x, y] = [f64::from(column) / 2.0 - 1.0, f64::from(row) / 2.0 - 0.7];
        DVec3::new(x, y, dice.between(-0.4, 0.4))
    };
    let mut solid = Solid::default();
    for row in 0..=rows {
        for column in 0..=columns {
            let point = at(column, row, dice);
            solid.positions.push(point);
        }
    }
    for row in 0..rows {
        for column in 0..columns {
            let first = row * (columns + 1) + column;
            let [a, b, c, d] = [first, first + 1, first + columns + 2, first + columns + 1];
            solid.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    if dice.below(2) == 0 {
        solid.triangles.iter_mut().for_each(|triangle| triangle.reverse());
    }
    let (turn, place) = (dice.turn(), dice.point(0.5));
    solid.moved(|p| turn * p + place)
}

/// Sheets and boxes that intersect each other, with two materials assigned at random.
fn sheets_and_boxes(dice: &mut Dice) -> Scene {
    let mut solids: Vec<Solid> = (0..3).map(|_| sheet(dice)).collect();
    for _ in 0..2 {
        let (turn, place, size) = (dice.turn(), dice.point(0.8), dice.point(0.7).abs() + 0.1);
        solids.push(cuboid(-size, size).moved(|p| turn * p + place));
    }
    let painted = |solid: Solid, dice: &mut Dice| {
        let mut shape = solid_geometry(solid);
        shape.triangle_material = shape.triangles.iter().map(|_| dice.below(2) as u32).collect();
        shape
    };
    let shapes = solids.into_iter().map(|solid| painted(solid, dice)).collect();
    let materials = vec![Material::default(), Material::default()];
    Scene { materials, ..scene_of_geometries(shapes) }
}

/// Axis-aligned boxes and sheets. Many of their faces are seen edge-on.
fn axis_aligned_scene(dice: &mut Dice) -> Scene {
    let mut number = |most: usize| dice.below(most) as f64 * 0.25;
    let mut solids = Vec::new();
    for k in 0..5 {
        let low = DVec3::new(number(5), number(5), number(5)) - 0.8;
        let size = DVec3::new(number(4), number(4), number(4)) + 0.25;
        let mut solid = cuboid(low, low + size);
        if k > 1 {
            // An open box, or a single side of a box.
            solid.triangles.truncate(if k > 3 { 2 } else { 10 });
        }
        solids.push(solid);
    }
    scene(solids)
}

#[test]
fn silhouettes_are_lines_with_background_on_one_side() {
    let no_contours = || {
        let options = exact_options();
        let kinds = options.kinds.iter().copied().filter(|kind| *kind != LineKind::Contour).collect();
        LineOptions { kinds, ..options }
    };
    let mut scenes: Vec<(String, Scene, Camera)> = Vec::new();
    for seed in 0..20 {
        let dice = &mut Dice::new(seed);
        for kind in HARD_SCENE_KINDS.into_iter().filter(|_| seed < 4) {
            scenes.push((format!("{kind}, seed {seed}"), hard_scene(kind, dice), camera_from_any_side(dice)));
        }
        scenes.push((
            format!("sheets and boxes, seed {seed}"),
            sheets_and_boxes(dice),
            camera_from_any_side(dice),
        ));
        let axis = [DVec3::X, DVec3::Y, DVec3::NEG_Z][seed as usize % 3];
        let camera = orthographic(axis * 6.0, DVec3::ZERO, 4.4);
        scenes.push((format!("along the axes, seed {seed}"), axis_aligned_scene(dice), camera));
    }
    let found: Vec<(String, SilhouetteTally)> = scenes
        .par_iter()
        .flat_map_iter(|(name, scene, camera)| {
            let of = |options: &LineOptions| (name.clone(), compare(scene, camera, options));
            [of(&exact_options()), of(&no_contours())]
        })
        .collect();
    let wrong: Vec<String> = found
        .iter()
        .filter(|(_, found)| !found.wrong.is_empty())
        .map(|(name, found)| {
            format!("{name}: {} of {}, {:?}", found.wrong.len(), found.asked, found.wrong[0])
        })
        .collect();
    let outline =
        found.iter().fold([0; 5], |sum, (_, found)| [0, 1, 2, 3, 4].map(|k| sum[k] + found.outline[k]));
    println!(
        "{} places, outline by kind {outline:?}",
        found.iter().map(|(_, found)| found.asked).sum::<usize>()
    );
    assert!(outline[0] > 1000 && outline[1] > 1000 && outline[2] > 1000, "{outline:?}");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// A gable roof without thickness. Its lower edges are borders and its ridge is a crease.
fn roof() -> Solid {
    let at = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
    Solid {
        positions: vec![
            at(-2.0, 0.0, -1.0),
            at(2.0, 0.0, -1.0),
            at(2.0, 1.0, 0.0),
            at(-2.0, 1.0, 0.0),
            at(2.0, 0.0, 1.0),
            at(-2.0, 0.0, 1.0),
        ],
        triangles: vec![[0, 2, 1], [0, 3, 2], [3, 4, 2], [3, 5, 4]],
    }
}

#[test]
fn a_roof_has_the_silhouette_pen_along_its_outline() {
    let scene = scene([roof()]);
    let style = Style::preset("ink").unwrap();
    let camera = Camera::three_quarter().fit(&scene);
    let drawing = render(&scene, &camera, &style).unwrap();
    let polygons = TriangleScene::of(&scene);
    let eye = TextbookCamera::new(&camera);
    let rays = RayCaster::new(&polygons, &eye, camera.width, camera.height);
    let mut outline = 0;
    for mark in visible_line_marks(&drawing) {
        let is_outline = mark.provenance.classes.contains(&"silhouette");
        for [a, b] in centre_line(mark) {
            let across = Vec2::new(a.y - b.y, b.x - a.x) / (b - a).hypot();
            let beside = [-1.0, 1.0].map(|aside| rays.is_background(a.midpoint(b) + across * aside));
            assert_eq!(beside.contains(&true), is_outline, "{a} to {b}");
            outline += usize::from(is_outline);
        }
    }
    assert!(outline >= 5, "{outline}");
}
