//! Contours of rounded surfaces agree with the closed-form contour for any triangulation: spheres,
//! ellipsoids, saddles and cylinders.

use crate::library::support::measures::line_picture::{
    self, SegmentGrid, length_farther_than, sample_segments,
};
use crate::library::support::pipeline::{
    REFINEMENT_TOLERANCE_PX, Stages, orthographic, perspective, run_stages, scene, scene_of_geometries,
    solid_geometry,
};
use crate::library::support::references::textbook_camera::TextbookCamera;
use crate::library::support::scenes::random_dice::Dice;
use crate::library::support::scenes::round_solids::{cylinder, globe, icosphere, octasphere, saddle};
use crate::library::support::scenes::solids::Solid;
use glam::{DMat3, DVec3};
use kurbo::Point;
use ligne::chains::{self, Chain, ChainOptions};
use ligne::drawing::{Length, Unit};
use ligne::geometry::numbers::portable_math::{cos, sin};
use ligne::lines::{Contours, HiddenLines, LineKind, LineOptions};
use ligne::scene::{Camera, Geometry, Scene};

pub(crate) fn contour_options(contours: Contours) -> LineOptions {
    LineOptions { contours, ..LineOptions::default() }
}

fn plain_chains() -> ChainOptions {
    let off = Length::px(0.0);
    ChainOptions { smooth: off, simplify: off, tidy: off, fit: false, fit_tolerance: off, circles: false }
}

fn chains(drawn: &Stages, options: &ChainOptions) -> Vec<Chain> {
    let mut chains = chains::link(&drawn.map, options, Unit::Px, HiddenLines::None);
    chains.retain(|c| c.invisibility == 0);
    chains
}

/// Cameras that face the origin from random directions. Every second one is orthographic.
pub(crate) fn cameras(seed: u64, count: usize, reach: f64) -> Vec<Camera> {
    let mut dice = Dice::new(seed);
    let camera = |k: usize| {
        let way = dice.direction();
        match k % 2 {
            0 => perspective(way * reach * 4.0, DVec3::ZERO, 35.0),
            _ => orthographic(way * reach * 4.0, DVec3::ZERO, reach * 2.5),
        }
    };
    (0..count).map(camera).collect()
}

/// Returns the largest distance of the drawn lines from the true ones, and of the true from the drawn, px.
pub(crate) fn max_deviations(drawn: &[[Point; 2]], truth: &[[Point; 2]]) -> [f64; 2] {
    let farthest = |of: &[[Point; 2]], from: &[[Point; 2]]| {
        let ink = SegmentGrid::new(from.to_vec(), 8.0);
        sample_segments(of, 0.5).iter().map(|(p, _)| ink.distance(*p)).fold(0.0, f64::max)
    };
    [farthest(drawn, truth), farthest(truth, drawn)]
}

/// Returns a closed curve through the images of points.
fn ring(camera: &Camera, point: impl Fn(f64) -> DVec3) -> Vec<[Point; 2]> {
    let eye = TextbookCamera::new(camera);
    let count = 2000;
    let at = |k: usize| eye.project(point(std::f64::consts::TAU * k as f64 / f64::from(count)));
    (0..count as usize).map(|k| [at(k), at(k + 1)]).collect()
}

/// Returns the contour of an ellipsoid with these half axes. It is the contour of a sphere, scaled.
fn contour_of_ellipsoid(axes: DVec3, camera: &Camera) -> Vec<[Point; 2]> {
    let eye = TextbookCamera::new(camera);
    // On the sphere, the solutions of n·v = 0 form a circle around the direction to the camera.
    let (way, height) = if eye.perspective {
        let to_eye = eye.position / axes;
        (to_eye.normalize(), 1.0 / to_eye.length())
    } else {
        ((-eye.forward / axes).normalize(), 0.0)
    };
    let (u, v) = way.any_orthonormal_pair();
    let wide = (1.0 - height * height).sqrt();
    ring(camera, |t| (way * height + (u * cos(t) + v * sin(t)) * wide) * axes)
}

/// Draws a solid and compares the result with its single closed contour.
fn assert_one_closed_contour(
    what: &str,
    solid: &Solid,
    contours: Contours,
    truth: impl Fn(&Camera) -> Vec<[Point; 2]>,
    within: [f64; 2],
) {
    assert_one_closed_contour_of_scene(what, &scene([solid.clone()]), contours, truth, within);
}

/// Draws a scene and compares the result with its single closed contour.
fn assert_one_closed_contour_of_scene(
    what: &str,
    scene: &Scene,
    contours: Contours,
    truth: impl Fn(&Camera) -> Vec<[Point; 2]>,
    within: [f64; 2],
) {
    let places = scene.geometries.iter().flat_map(|geometry| &geometry.positions);
    let reach = places.map(|p| p.length()).fold(0.0, f64::max);
    let mut worst = [[0.0_f64; 2]; 2];
    for camera in cameras(5, 10, reach) {
        let drawn = run_stages(scene, &camera, &contour_options(contours));
        let truth = truth(&camera);
        for (k, options) in [plain_chains(), ChainOptions::default()].iter().enumerate() {
            let chains = chains(&drawn, options);
            let kinds: Vec<LineKind> = chains.iter().map(|c| c.kind).collect();
            assert_eq!(kinds, [LineKind::Contour], "{what} from {}", camera.eye);
            assert!(chains[0].closed && chains[0].silhouette, "{what} from {}", camera.eye);
            let off = max_deviations(&line_picture::drawn_segments(&chains), &truth);
            worst[k] = [0, 1].map(|i| worst[k][i].max(off[i]));
        }
    }
    println!(
        "{what}: plain lines {:.4} px off, {:.4} missing; default lines {:.4} px off, {:.4} missing",
        worst[0][0], worst[0][1], worst[1][0], worst[1][1]
    );
    for (worst, within) in worst.iter().zip(within) {
        assert!(worst[0] <= within && worst[1] <= within, "{what}: {worst:?} px, not within {within}");
    }
}

/// Largest errors of plain lines, and of default lines, which are smoothed and fitted.
const MAX_BALL_ERROR_PX: [f64; 2] = [REFINEMENT_TOLERANCE_PX, 0.2];

#[test]
fn contours_of_sphere_meshes_are_circles() {
    let ball = |camera: &Camera| contour_of_ellipsoid(DVec3::ONE, camera);
    for level in 1..=3 {
        assert_one_closed_contour(
            &format!("icosphere {level}"),
            &icosphere(level),
            Contours::Smooth,
            ball,
            MAX_BALL_ERROR_PX,
        );
        assert_one_closed_contour(
            &format!("icosphere {level}, auto"),
            &icosphere(level),
            Contours::Auto,
            ball,
            MAX_BALL_ERROR_PX,
        );
        assert_one_closed_contour(
            &format!("octasphere {level}"),
            &octasphere(level),
            Contours::Smooth,
            ball,
            MAX_BALL_ERROR_PX,
        );
    }
    for around in [8, 16, 48] {
        assert_one_closed_contour(
            &format!("globe {around}"),
            &globe(around),
            Contours::Smooth,
            ball,
            MAX_BALL_ERROR_PX,
        );
    }
}

#[test]
fn stale_normals_of_a_rotated_ball_do_not_affect_its_contour() {
    let ball = |camera: &Camera| contour_of_ellipsoid(DVec3::ONE, camera);
    for (what, solid) in [("globe", globe(32)), ("icosphere", icosphere(4)), ("octasphere", octasphere(5))] {
        // The normals of the ball, and normals from before its rotation.
        for degrees in [0.0, 20.0, 35.0] {
            let before = DMat3::from_rotation_x(f64::to_radians(degrees));
            let normals = solid.positions.iter().map(|p| (before * *p).as_vec3().to_array()).collect();
            let corner_normals = solid.triangles.clone();
            let shape = Geometry { normals, corner_normals, ..solid_geometry(solid.clone()) };
            let scene = scene_of_geometries(vec![shape]);
            assert_one_closed_contour_of_scene(
                &format!("{what}, {degrees} degrees"),
                &scene,
                Contours::Auto,
                ball,
                MAX_BALL_ERROR_PX,
            );
        }
    }
}

#[test]
fn the_contour_of_an_ellipsoid_is_an_ellipse() {
    let axes = DVec3::new(3.0, 2.0, 1.0);
    let truth = |camera: &Camera| contour_of_ellipsoid(axes, camera);
    for (level, within) in [(3, [0.3, 0.3]), (4, MAX_BALL_ERROR_PX), (5, MAX_BALL_ERROR_PX)] {
        let solid = icosphere(level).moved(|p| p * axes);
        assert_one_closed_contour(&format!("ellipsoid {level}"), &solid, Contours::Smooth, truth, within);
        assert_one_closed_contour(&format!("ellipsoid {level}, auto"), &solid, Contours::Auto, truth, within);
    }
}

pub(crate) fn length(segments: &[[Point; 2]]) -> f64 {
    segments.iter().map(|[a, b]| (*b - *a).hypot()).sum()
}

#[test]
fn a_saddle_has_its_contour_and_borders() {
    // At a border, vertex normals average one side only, so contours end some px away from their true ends.
    for (cells, least) in [(16, 93.0), (64, 98.0)] {
        let patch = scene([saddle(cells)]);
        let (mut astray, mut all) = (0.0, 0.0);
        for camera in cameras(12, 24, 1.5) {
            let drawn = run_stages(&patch, &camera, &contour_options(Contours::Smooth));
            let eye = TextbookCamera::new(&camera);
            let contour: Vec<[Point; 2]> =
                contour_of_saddle(&camera).iter().map(|p| [eye.project(*p); 2]).collect();
            let border: Vec<[Point; 2]> =
                borders_of_saddle(&camera).iter().map(|p| [eye.project(*p); 2]).collect();
            let is = drawn.visible_segments_of_kind(LineKind::Contour);
            let off = length_farther_than(&is, &contour, MAX_SADDLE_ERROR_PX);
            let drawn_all = SegmentGrid::new(drawn.visible_segments(), MAX_SADDLE_ERROR_PX);
            let missing = |truth: &[[Point; 2]]| {
                truth.iter().filter(|[p, _]| drawn_all.distance(*p) > MAX_SADDLE_ERROR_PX).count() as f64
                    / truth.len().max(1) as f64
            };
            let missing = [missing(&contour), missing(&border)];
            if off > 1.0 || missing.iter().any(|m| *m > 0.005) {
                println!(
                    "saddle {cells} from {:.3?}: {off:.1} of {:.1} px astray, {:.2} % of contours and \
                     {:.2} % of borders missing",
                    camera.eye.to_array(),
                    length(&is),
                    100.0 * missing[0],
                    100.0 * missing[1]
                );
            }
            astray += off;
            all += length(&is);
            assert!(missing.iter().all(|m| *m <= 0.045), "saddle {cells} from {}: {missing:?}", camera.eye);
        }
        let share = 100.0 * (1.0 - astray / all);
        println!("saddle {cells}: {share:.2} % of the contours within {MAX_SADDLE_ERROR_PX} px");
        assert!(share >= least, "saddle {cells}: {share} %");
    }
}

/// Largest distance of the saddle's contours and borders, except at their ends.
const MAX_SADDLE_ERROR_PX: f64 = 1.0;

/// Returns points of the contour of z = x² − y² over the square. All of it is visible, because a tangent line
/// of sight meets the surface nowhere else.
fn contour_of_saddle(camera: &Camera) -> Vec<DVec3> {
    let eye = TextbookCamera::new(camera);
    // n·v = a (x² − y²) − 2 x ex + 2 y ey + ez, with a = 1 for perspective and 0 for orthographic views.
    let (a, e) = if eye.perspective { (1.0, eye.position) } else { (0.0, -eye.forward) };
    let mut points = Vec::new();
    let mut push = |x: f64, y: f64| {
        if x.abs() <= 1.0 && y.abs() <= 1.0 {
            points.push(DVec3::new(x, y, x * x - y * y));
        }
    };
    let count = 8000;
    for k in 0..=count {
        let s = 2.0 * f64::from(k) / f64::from(count) - 1.0;
        for x in roots(a, -2.0 * e.x, -a * s * s + 2.0 * s * e.y + e.z) {
            push(x, s);
        }
        for y in roots(-a, 2.0 * e.y, a * s * s - 2.0 * s * e.x + e.z) {
            push(s, y);
        }
    }
    points
}

/// Returns the real roots of a x² + b x + c.
fn roots(a: f64, b: f64, c: f64) -> Vec<f64> {
    if a == 0.0 {
        return if b == 0.0 { Vec::new() } else { vec![-c / b] };
    }
    let root = b * b - 4.0 * a * c;
    if root < 0.0 { Vec::new() } else { [-1.0, 1.0].map(|s| (-b + s * root.sqrt()) / (2.0 * a)).to_vec() }
}

/// Returns the visible border points of the saddle. A line of sight through a border point meets the surface
/// once more; the point is hidden if that is in front and inside the square.
fn borders_of_saddle(camera: &Camera) -> Vec<DVec3> {
    let eye = TextbookCamera::new(camera);
    let mut points = Vec::new();
    let count = 8000;
    for k in 0..=count {
        let s = 2.0 * f64::from(k) / f64::from(count) - 1.0;
        for (x, y) in [(s, -1.0), (s, 1.0), (-1.0, s), (1.0, s)] {
            let p = DVec3::new(x, y, x * x - y * y);
            let d = if eye.perspective { eye.position - p } else { -eye.forward };
            // z − x² + y² along p + t d vanishes at 0 and at −b / a.
            let (a, b) = (d.y * d.y - d.x * d.x, d.z - 2.0 * p.x * d.x + 2.0 * p.y * d.y);
            let q = p - d * (b / a);
            let hidden = -b / a > 0.0 && q.x.abs() < 1.0 && q.y.abs() < 1.0;
            if !hidden {
                points.push(p);
            }
        }
    }
    points
}

/// Largest gap between a rim and the contour that ends on it, before lines are joined.
const MAX_RIM_GAP_PX: f64 = 1.1;

#[test]
fn cylinder_contours_run_from_rim_to_rim() {
    for around in [32, 128] {
        let mut worst = [0.0_f64; 2];
        for camera in cameras(3, 20, 1.5) {
            let part = cylinder(around, 8);
            let drawn =
                run_stages(&scene_of_geometries(vec![part]), &camera, &contour_options(Contours::Auto));
            let off = max_deviations(&drawn.visible_segments(), &lines_of_cylinder(&camera));
            worst = [0, 1].map(|i| worst[i].max(off[i]));
        }
        println!("cylinder {around}: off, missing {worst:?}");
        // Rims are rounded, so lines are as exact as the refinement. A rim may end shortly before the contour
        // that meets it, where its last piece turns away.
        assert!(worst[0] <= REFINEMENT_TOLERANCE_PX && worst[1] <= MAX_RIM_GAP_PX, "{worst:?}");
    }
}

/// Returns the visible lines of the cylinder of radius 1 from z = −1 to 1: rims next to a front face, and the
/// two contour lines of its side.
fn lines_of_cylinder(camera: &Camera) -> Vec<[Point; 2]> {
    let eye = TextbookCamera::new(camera);
    // How far the outward normal at angle t faces the camera.
    let side = |t: f64| {
        let n = DVec3::new(cos(t), sin(t), 0.0);
        if eye.perspective { eye.position.dot(n) - 1.0 } else { -eye.forward.dot(n) }
    };
    let cap = |z: f64| if eye.perspective { z * eye.position.z > 1.0 } else { -z * eye.forward.z > 0.0 };
    let count = 8000;
    let angle = |k: usize| std::f64::consts::TAU * k as f64 / f64::from(count);
    let point = |t: f64, z: f64| eye.project(DVec3::new(cos(t), sin(t), z));
    let mut lines = Vec::new();
    for k in 0..count as usize {
        let (t, next) = (angle(k), angle(k + 1));
        for z in [-1.0, 1.0] {
            if cap(z) || side(t) > 0.0 {
                lines.push([point(t, z), point(next, z)]);
            }
        }
        if (side(t) > 0.0) != (side(next) > 0.0) {
            lines.push([point(t, -1.0), point(t, 1.0)]);
        }
    }
    lines
}
