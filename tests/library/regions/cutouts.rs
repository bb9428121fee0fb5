//! Transparent parts of textures cut holes for lines, visibility, regions and areas; closed-form circles are
//! the reference.

use glam::DVec3;
use kurbo::{Point, Shape as _};
use ligne::drawing::{Drawing, Mark, Paint};
use ligne::pipeline::render;
use ligne::scene::{Camera, Scene};
use ligne::style::Style;

use crate::library::support::measures::line_picture::SegmentGrid;
use crate::library::support::references::drawing_judge::{centre_line, visible_line_marks};
use crate::library::support::references::textbook_camera::TextbookCamera;

/// The vine in front of its panel with round holes, from `examples/models`.
fn trellis() -> Scene {
    Scene::open(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/trellis.obj")).unwrap()
}

fn keep_part(mut scene: Scene, name: &str) -> Scene {
    scene.parts.retain(|part| part.name == name);
    scene
}

/// The centres of the holes. The panel is 1 wide from x = −0.5 and 1.4 high from y = 0.1, at z = −0.3.
fn holes() -> impl Iterator<Item = DVec3> {
    (0..35).map(|k| DVec3::new(-0.4 + 0.2 * f64::from(k % 5), 0.2 + 0.2 * f64::from(k / 5), -0.3))
}

const HOLE_RADIUS: f64 = 0.075;

/// The outlines of the holes and of the panel.
fn outlines() -> Vec<[DVec3; 2]> {
    let turn = |k: u32| std::f64::consts::TAU * f64::from(k) / 720.0;
    let round = |k: u32| {
        DVec3::new(
            ligne::geometry::numbers::portable_math::cos(turn(k)),
            ligne::geometry::numbers::portable_math::sin(turn(k)),
            0.0,
        ) * HOLE_RADIUS
    };
    let mut all: Vec<[DVec3; 2]> = holes()
        .flat_map(|middle| (0..720).map(move |k| [middle + round(k), middle + round(k + 1)]))
        .collect();
    let corners = [[-0.5, 0.1], [0.5, 0.1], [0.5, 1.5], [-0.5, 1.5]].map(|[x, y]| DVec3::new(x, y, -0.3));
    all.extend((0..4).map(|k| [corners[k], corners[(k + 1) % 4]]));
    all
}

fn draw(scene: &Scene, camera: &Camera, style: &str) -> Drawing {
    render(scene, camera, &Style::preset(style).unwrap()).unwrap()
}

/// Returns points along a mark, at most 1 px apart.
fn points(mark: &Mark) -> Vec<Point> {
    let pieces = |[a, b]: [Point; 2]| {
        let count = (b - a).hypot().ceil().max(1.0) as usize;
        (0..count).map(move |k| a.lerp(b, (k as f64 + 0.5) / count as f64)).collect::<Vec<_>>()
    };
    centre_line(mark).into_iter().flat_map(pieces).collect()
}

#[test]
fn hole_outlines_match_the_texture() {
    let scene = keep_part(trellis(), "panel");
    for [azimuth, elevation] in [[20.0, 15.0], [-40.0, 30.0], [160.0, -20.0]] {
        let camera = Camera::azimuth_elevation(azimuth, elevation, scene.up).fit(&scene);
        let truth = TextbookCamera::new(&camera).project_segments(&outlines());
        let drawing = draw(&scene, &camera, "ink");
        let drawn: Vec<[Point; 2]> = visible_line_marks(&drawing).flat_map(centre_line).collect();
        let (ink, truth_ink) = (SegmentGrid::new(drawn, 4.0), SegmentGrid::new(truth.clone(), 4.0));
        for p in visible_line_marks(&drawing).flat_map(points) {
            assert!(truth_ink.distance(p) < 0.5, "{p} is on no outline from {azimuth}/{elevation}");
        }
        for [a, b] in &truth {
            assert!(ink.distance(a.midpoint(*b)) < 0.5, "no ink at {a} from {azimuth}/{elevation}");
        }
    }
}

#[test]
fn parts_behind_a_panel_are_visible_through_holes_only() {
    let scene = trellis();
    let camera = Camera::azimuth_elevation(170.0, 5.0, scene.up).fit(&scene);
    let eye = TextbookCamera::new(&camera);
    assert!(camera.eye.z < -0.3, "from behind the panel");
    let drawing = draw(&scene, &camera, "ink");
    let mut through = 0;
    for mark in visible_line_marks(&drawing).filter(|mark| mark.provenance.part.as_deref() != Some("panel")) {
        for p in points(mark) {
            // The point where the line of sight meets the plane of the panel.
            let (near, far) = (eye.unproject(p, 0.0), eye.unproject(p, 1.0));
            let part = (-0.3 - near.z) / (far.z - near.z);
            let at = near + (far - near) * part;
            let px = eye.scale / eye.depth(at);
            let inside = (at.x.abs() - 0.5).max((at.y - 0.8).abs() - 0.7) * px;
            let from_hole =
                holes().map(|middle| at.distance(middle) - HOLE_RADIUS).fold(f64::INFINITY, f64::min) * px;
            assert!(inside > -1.5 || from_hole < 1.5, "{p} is drawn through the panel");
            through += usize::from(from_hole < 0.0);
        }
    }
    assert!(through > 300, "{through} px seen through holes");
}

#[test]
fn region_areas_exclude_the_holes() {
    let scene = keep_part(trellis(), "panel");
    let camera = Camera::azimuth_elevation(0.0, 0.0, scene.up)
        .with_projection(ligne::scene::Projection::Orthographic { height: 1.0 })
        .fit(&scene);
    let drawing = draw(&scene, &camera, "flat");
    let filled = drawing
        .layers
        .iter()
        .flat_map(|layer| &layer.marks)
        .filter(|mark| matches!(mark.paint, Paint::Fill { .. }));
    let area: f64 = filled.map(|mark| mark.path.area().abs()).sum();
    let px = TextbookCamera::new(&camera).scale;
    let wanted = (1.0 * 1.4 - 35.0 * std::f64::consts::PI * HOLE_RADIUS * HOLE_RADIUS) * px * px;
    assert!((area / wanted - 1.0).abs() < 0.01, "{area} of {wanted}");
}

#[test]
fn missing_textures_are_reported_and_ignored() {
    let folder = std::env::temp_dir().join(format!("ligne-trellis-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    for name in ["trellis.obj", "trellis.mtl"] {
        let from = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/models").join(name);
        std::fs::copy(from, folder.join(name)).unwrap();
    }
    let scene = Scene::open(folder.join("trellis.obj")).unwrap();
    let camera = Camera::three_quarter().fit(&scene);
    let drawing = draw(&scene, &camera, "ink");
    let said = drawing.warnings.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n");
    assert!(said.contains("`panel`") && said.contains("trellis-hole.png is missing"), "{said}");
    let mut plain = scene.clone();
    plain.materials.iter_mut().for_each(|material| material.opacity_map = None);
    assert_eq!(drawing.layers, draw(&plain, &camera, "ink").layers);
}
