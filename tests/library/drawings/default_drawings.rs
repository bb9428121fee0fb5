//! Drawings of all example models from three views against ray casts: visible outlines are drawn and hidden
//! lines are not.
//!
//! The reference in `drawing_judge` uses only the triangles and the finished drawing.

use crate::library::support::references::triangle_scene;
use std::path::Path;

use crate::library::support::pipeline::scene;
use crate::library::support::properties::bound::Bound;
use crate::library::support::properties::option_set::{INK, INK_MESH};
use crate::library::support::properties::subject::Subject;
use crate::library::support::references::drawing_judge::{
    COARSE_MODEL_LIMITS, FLAT_MODEL_LIMITS, MIXED_MODEL_LIMITS, ROUND_MODEL_LIMITS, ShareLimits,
    compare_ink_with_reference, compare_with_reference,
};
use crate::library::support::references::line_visibility::{ReferenceLines, SampleVisibility};
use crate::library::support::scenes::solids::{Solid, cuboid, tube};
use glam::DVec3;
use ligne::geometry::numbers::portable_math::{cos, sin};
use ligne::lines::Contours;
use ligne::load::ModelFormat;
use ligne::pipeline::render;
use ligne::scene::{Camera, Projection, Scene, UpAxis};
use ligne::style::Style;
use rayon::prelude::*;

/// Example models with their limits, and whether they are closed and machined.
const MODELS: [(&str, ShareLimits, bool); 18] = [
    ("bear.ply", COARSE_MODEL_LIMITS, false),
    ("bevels.obj", FLAT_MODEL_LIMITS, true),
    ("biplane.obj", FLAT_MODEL_LIMITS, false),
    ("bracket.stl", FLAT_MODEL_LIMITS, true),
    ("castle.obj", FLAT_MODEL_LIMITS, false),
    ("drum.obj", FLAT_MODEL_LIMITS, true),
    ("elbow.obj", FLAT_MODEL_LIMITS, true),
    ("gear.obj", FLAT_MODEL_LIMITS, true),
    ("goose.obj", COARSE_MODEL_LIMITS, false),
    // Its shell has few faces and is drawn rounder than its mesh.
    ("helmet.obj", ShareLimits { tolerance: 12.0, ..FLAT_MODEL_LIMITS }, false),
    ("horn.obj", FLAT_MODEL_LIMITS, false),
    ("knot.ply", ROUND_MODEL_LIMITS, false),
    ("pump.glb", FLAT_MODEL_LIMITS, true),
    ("rack.stl", FLAT_MODEL_LIMITS, true),
    ("shaft.obj", FLAT_MODEL_LIMITS, true),
    ("shelf.ply", MIXED_MODEL_LIMITS, false),
    ("street.glb", FLAT_MODEL_LIMITS, true),
    ("teapot.obj", ROUND_MODEL_LIMITS, false),
];

/// Known failures by model, view and contours. This list may only get shorter. The belly of the goose is
/// drawn more than 15 px rounder than its faces. Tidying removes the end of the drum's shaft.
const KNOWN_FAILURES: [(&str, usize, Contours); 2] =
    [("goose.obj", 1, Contours::Auto), ("drum.obj", 1, Contours::Smooth)];

/// Azimuth and elevation in degrees, and whether the view is parallel.
const VIEWS: [(f64, f64, bool); 3] = [(35.0, 25.0, false), (-60.0, 10.0, false), (20.0, 35.0, true)];

fn camera(scene: &Scene, (azimuth, elevation, parallel): (f64, f64, bool)) -> Camera {
    let all = triangle_scene::TriangleScene::of(scene);
    let low = all.points.iter().copied().fold(DVec3::INFINITY, DVec3::min);
    let high = all.points.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
    let (middle, radius) = (low.midpoint(high), low.distance(high) / 2.0);
    let (azimuth, elevation) = (azimuth.to_radians(), elevation.to_radians());
    let way = DVec3::new(sin(azimuth) * cos(elevation), sin(elevation), cos(azimuth) * cos(elevation));
    let (way, up) = match scene.up {
        UpAxis::Y => (way, DVec3::Y),
        UpAxis::Z => (DVec3::new(way.x, -way.z, way.y), DVec3::Z),
    };
    let projection = match parallel {
        true => Projection::Orthographic { height: 2.1 * radius },
        false => Projection::Perspective { fov_y_deg: 35.0 },
    };
    let eye = middle + way * (1.02 * radius / sin(17.5_f64.to_radians()));
    Camera { eye, target: middle, up, projection, width: 1000.0, height: 1000.0, near: None }
}

fn open(name: &str) -> Scene {
    Scene::open(Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/models").join(name)).unwrap()
}

fn ink_style(contours: Contours) -> Style {
    let mut style = Style::preset("ink").unwrap();
    style.lines.contours = contours;
    style
}

/// Draws the wanted models in all views and fails with one line per drawing outside its limits.
fn assert_models_within_limits(
    contours: Contours,
    wanted: impl Fn(bool) -> bool,
    limits: impl Fn(ShareLimits) -> ShareLimits + Sync,
) {
    let jobs: Vec<(&str, ShareLimits, (f64, f64, bool))> = MODELS
        .iter()
        .filter(|(_, _, machined)| wanted(*machined))
        .flat_map(|(name, limits, _)| VIEWS.iter().enumerate().map(|(k, view)| (k, (*name, *limits, *view))))
        .filter(|(k, (name, ..))| !KNOWN_FAILURES.contains(&(*name, *k, contours)))
        .map(|(_, job)| job)
        .collect();
    let short: Vec<String> = jobs
        .par_iter()
        .filter_map(|(name, own, view)| {
            let scene = open(name);
            let camera = camera(&scene, *view);
            let drawing = render(&scene, &camera, &ink_style(contours)).unwrap();
            let limits = limits(*own);
            let verdict =
                compare_with_reference(&ReferenceLines::of(&scene, &camera), &drawing, limits.tolerance);
            let words = limits.violations(&verdict);
            (!words.is_empty()).then(|| format!("{name} {view:?}: {}", words.join(", ")))
        })
        .collect();
    assert!(short.is_empty(), "{} of {} drawings fall short\n{}", short.len(), jobs.len(), short.join("\n"));
}

#[test]
fn models_are_drawn_right_with_mesh_contours() {
    assert_models_within_limits(Contours::Mesh, |_| true, |limits| limits);
}

#[test]
fn models_are_drawn_right_by_default() {
    assert_models_within_limits(Contours::Auto, |_| true, |limits| limits);
}

#[test]
fn machined_models_are_drawn_right_with_smooth_contours() {
    let smooth = |limits: ShareLimits| ShareLimits { contour: 0.0, crease: 0.0, off: 1.0, ..limits };
    assert_models_within_limits(Contours::Smooth, |machined| machined, smooth);
}

#[test]
fn drawing_judge_detects_hidden_lost_and_invented_ink() {
    let scene = open("shaft.obj");
    let camera = camera(&scene, VIEWS[0]);
    let truth = ReferenceLines::of(&scene, &camera);
    let seen = truth.segments_where(|place| place.state == SampleVisibility::Visible);
    let right = compare_ink_with_reference(&truth, &seen, 0.1);
    assert_eq!(FLAT_MODEL_LIMITS.violations(&right), Vec::<String>::new());
    let length =
        |strokes: &[[kurbo::Point; 2]]| strokes.iter().map(|[a, b]| (*b - *a).hypot2().sqrt()).sum::<f64>();

    let hidden = truth.segments_where(|place| place.state == SampleVisibility::Hidden);
    let all = [seen.clone(), hidden.clone()].concat();
    let leaking = compare_ink_with_reference(&truth, &all, 0.1);
    assert!((leaking.leak.share - length(&hidden) / length(&all)).abs() < 0.05, "{leaking:?}");
    assert!(leaking.through.share > 0.1 && leaking.off.share < 1e-6, "{leaking:?}");

    let inner =
        truth.segments_where(|place| place.state == SampleVisibility::Visible && !place.is_silhouette);
    let lost = compare_ink_with_reference(&truth, &inner, 0.1);
    assert!(lost.outline.share < 0.1 && lost.leak.share < 1e-6, "{lost:?}");

    let made_up = [seen, vec![[kurbo::Point::new(2.0, 2.0), kurbo::Point::new(2.0, 900.0)]]].concat();
    assert!(compare_ink_with_reference(&truth, &made_up, 0.1).off.share > 0.01);
}

#[test]
fn flat_faces_have_mesh_contours_by_default() {
    let models = [
        ("box", scene([cuboid(DVec3::splat(-1.0), DVec3::new(1.0, 2.0, 0.5))])),
        ("prism", scene([tube(6, 1, 1.0, 1.0)])),
        ("gear.obj", open("gear.obj")),
    ];
    for (name, model) in models {
        for camera in [Camera::three_quarter(), Camera::azimuth_elevation(200.0, -35.0, model.up)] {
            let subject = Subject::new(name, model.clone(), camera.fit(&model));
            let [auto, mesh] = [INK, INK_MESH].map(|way| way.draw(&subject));
            assert!(auto.bytes().contains("<path"), "{name}: nothing is drawn");
            Bound::Bytes.check(&auto, &mesh).unwrap_or_else(|words| panic!("{name} {words}"));
        }
    }
}

/// Convex hull of a barrel with steep lids. Its faces reach from rim to rim and from the rims to the tips,
/// and no two are coplanar.
fn hull() -> Solid {
    const CORNER_COUNT: u32 = 40;
    let mut hull = Solid { positions: vec![DVec3::Z * -3.4, DVec3::Z * 3.4], ..Solid::default() };
    for (k, end) in (0..CORNER_COUNT).flat_map(|k| [(k, -1.0), (k, 1.0)]) {
        let turn = std::f64::consts::TAU * (f64::from(k) + 0.25 * end) / f64::from(CORNER_COUNT);
        hull.positions.push(DVec3::new(cos(turn), sin(turn), 2.0 * end));
    }
    for k in 0..CORNER_COUNT {
        let [a, b, c, d] = [0, 2, 1, 3].map(|corner| 2 + (2 * k + corner) % (2 * CORNER_COUNT));
        hull.triangles.extend([[0, b, a], [1, c, d], [a, b, c], [b, d, c]]);
    }
    hull
}

#[test]
fn hulls_keep_the_outline_of_their_faces() {
    let model = scene([hull(), hull().moved(|p| DVec3::new(p.z, p.y - 1.5, p.x - 1.0))]);
    for view in VIEWS {
        let camera = camera(&model, view);
        let drawing = render(&model, &camera, &ink_style(Contours::Auto)).unwrap();
        let words = FLAT_MODEL_LIMITS.violations(&compare_with_reference(
            &ReferenceLines::of(&model, &camera),
            &drawing,
            FLAT_MODEL_LIMITS.tolerance,
        ));
        assert!(words.is_empty(), "{view:?}: {}", words.join(", "));
    }
}

/// Four six-sided studs in front of a wall. Normals at the rim are averaged over the adjacent cap faces, so
/// the caps look round. The sides run to a point behind the wall.
fn studs() -> Scene {
    const CAP_HEIGHT: f64 = 0.38;
    const TIP_DEPTH: f64 = 3.5;
    let (mut points, mut normals, mut faces) = (String::new(), String::new(), String::new());
    let (mut corners, mut ways) = (0, 0);
    let mut add = |triangle: [DVec3; 3], leaning: [DVec3; 3]| {
        faces.push('f');
        for (p, n) in triangle.into_iter().zip(leaning.map(DVec3::normalize)) {
            points.push_str(&format!("v {} {} {}\n", p.x, p.y, p.z));
            normals.push_str(&format!("vn {} {} {}\n", n.x, n.y, n.z));
            (corners, ways) = (corners + 1, ways + 1);
            faces.push_str(&format!(" {corners}//{ways}"));
        }
        faces.push('\n');
    };
    let flat = |[a, b, c]: [DVec3; 3]| [(b - a).cross(c - a); 3];
    for stud in 0..4 {
        let (across, up) = (f64::from(stud % 2), f64::from(stud / 2));
        let tilt = glam::DQuat::from_rotation_x(0.15 * f64::from(stud));
        let place = |p: DVec3| tilt * p + 4.0 * DVec3::new(across, up, 0.0);
        let rim = |k: usize| {
            let turn = std::f64::consts::TAU * k as f64 / 6.0;
            DVec3::new(cos(turn), sin(turn), 0.0)
        };
        let [top, tip] = [DVec3::Z * CAP_HEIGHT, DVec3::Z * -TIP_DEPTH];
        let of_face = |k: usize| flat([rim(k), rim(k + 1), top])[0];
        let of_corner = |k: usize| of_face(k) + of_face(k + 5);
        for k in 0..6 {
            let cap = [rim(k), rim(k + 1), top].map(place);
            add(cap, [of_corner(k), of_corner(k + 1), DVec3::Z].map(|way| tilt * way));
            let side = [rim(k + 1), rim(k), tip].map(place);
            add(side, flat(side));
        }
    }
    let [a, b, c, d] =
        [(-3.0, -3.0), (7.0, -3.0), (7.0, 7.0), (-3.0, 7.0)].map(|(x, y)| DVec3::new(x, y, -1.0));
    [[a, b, c], [a, c, d]].into_iter().for_each(|half| add(half, flat(half)));
    Scene::from_bytes((points + &normals + &faces).as_bytes(), ModelFormat::Obj).unwrap()
}

/// At a rim the sides face away from the camera. The refined cap bulges, so its last faces face away as well.
/// That is the end of the cap, not a ripple of the surface.
#[test]
fn rounded_caps_keep_their_rims_in_front_of_a_wall() {
    let model = studs();
    for view in VIEWS {
        let camera = camera(&model, view);
        let drawing = render(&model, &camera, &ink_style(Contours::Auto)).unwrap();
        // Caps are drawn rounder than their faces.
        let verdict = compare_with_reference(&ReferenceLines::of(&model, &camera), &drawing, 8.0);
        assert!(verdict.contour.share > 0.98 && verdict.outline.share > 0.98, "{view:?}: {verdict:?}");
        assert!(verdict.leak.share < 0.002, "{view:?}: {verdict:?}");
    }
}

#[test]
fn round_models_are_not_drawn_with_mesh_contours() {
    let model = open("knot.ply");
    let subject = Subject::new("knot", model.clone(), Camera::three_quarter().fit(&model));
    let [auto, mesh] = [INK, INK_MESH].map(|way| way.draw(&subject));
    assert!(auto.bytes() != mesh.bytes());
}
