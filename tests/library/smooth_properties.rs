//! What must not change smooth contours: size, motion of model and camera together, order, threads; and
//! what they must not change: drawings of flat-faced parts.

use crate::support::dice::Dice;
use crate::support::pipeline::{orthographic, perspective, scene, stages};
use crate::support::round_solids::{icosphere, saddle};
use crate::support::segments::cover_alike;
use crate::support::solids::{Solid, cuboid, torus, tube};
use glam::{DMat3, DVec3};
use kurbo::Point;
use ligne::export::SvgOptions;
use ligne::render::render;
use ligne::scene::{Camera, Projection, Scene};
use ligne::stages::lines::{Contours, LineOptions};
use ligne::style::Style;

fn solids() -> Vec<(&'static str, Solid)> {
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

fn cameras() -> [Camera; 3] {
    [
        perspective(DVec3::new(3.1, -4.2, 2.3), DVec3::new(0.1, 0.0, -0.1), 35.0),
        perspective(DVec3::new(-2.0, 0.9, 5.4), DVec3::ZERO, 40.0),
        orthographic(DVec3::new(1.3, 4.0, 1.9), DVec3::ZERO, 4.5),
    ]
}

fn visible(solid: &Solid, camera: &Camera) -> Vec<[Point; 2]> {
    let options = LineOptions { contours: Contours::Smooth, ..LineOptions::default() };
    stages(&scene([solid.clone()]), camera, &options).visible()
}

/// Where an edge is cut turns on whether its arc is higher than 0.08 px, and rounding may decide that
/// differently where a symmetrical solid has many edges at that height.
const ARC_PX: f64 = 0.1;

/// How much may differ, of some 3,000 px: on an open surface seen edge-on, whether a ripple of the mesh
/// lies beside its contour or is drawn itself rounding may decide either way.
const STRETCH_PX: f64 = 30.0;

/// Compares each solid with what `change` makes of it and of the camera.
fn unchanged(change: impl Fn(&Solid, &Camera, &mut Dice) -> (Solid, Camera)) {
    let mut faults = Vec::new();
    for (name, solid) in solids() {
        for camera in cameras() {
            let mut dice = Dice::new(31);
            let (other, camera_there) = change(&solid, &camera, &mut dice);
            let (here, there) = (visible(&solid, &camera), visible(&other, &camera_there));
            assert!(here.len() > 40, "{name}: hardly anything is drawn");
            if let Err(message) = cover_alike(&here, &there, ARC_PX, STRETCH_PX) {
                faults.push(format!("{name} from {}: {message}", camera.eye));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

fn moved(solid: &Solid, camera: &Camera, turn: DMat3, scale: f64, by: DVec3) -> (Solid, Camera) {
    let place = |p: DVec3| turn * p * scale + by;
    let projection = match camera.projection {
        Projection::Orthographic { height } => Projection::Orthographic { height: height * scale },
        same @ Projection::Perspective { .. } => same,
    };
    let (eye, target, up) = (place(camera.eye), place(camera.target), turn * camera.up);
    (solid.clone().moved(place), Camera { eye, target, up, projection, ..*camera })
}

#[test]
fn size_changes_nothing() {
    for scale in [1e-5, 1e7] {
        unchanged(|solid, camera, _| moved(solid, camera, DMat3::IDENTITY, scale, DVec3::ZERO));
    }
}

#[test]
fn a_rigid_motion_changes_nothing() {
    let by = DVec3::new(3.0, -2.0, 7.0);
    unchanged(|solid, camera, dice| moved(solid, camera, dice.turn(), 1.0, by));
}

#[test]
fn order_of_faces_and_vertices_changes_nothing() {
    unchanged(|solid, camera, dice| {
        let order = dice.shuffled((0..solid.positions.len() as u32).collect());
        let mut new_id = vec![0; order.len()];
        order.iter().enumerate().for_each(|(new, old)| new_id[*old as usize] = new as u32);
        let turned = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| new_id[v as usize]);
            [b, c, a]
        };
        let positions = order.iter().map(|old| solid.positions[*old as usize]).collect();
        let triangles = dice.shuffled(solid.triangles.iter().map(turned).collect());
        (Solid { positions, triangles }, *camera)
    });
}

fn svg(scene: &Scene, camera: &Camera, contours: Contours, threads: usize) -> String {
    let mut style = Style::preset("ink").unwrap();
    style.lines.contours = contours;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| render(scene, camera, &style).unwrap().to_svg(&SvgOptions::default()))
}

#[test]
fn threads_change_nothing() {
    for (name, solid) in solids() {
        let (model, camera) = (scene([solid]), cameras()[0]);
        let one = svg(&model, &camera, Contours::Smooth, 1);
        assert!(one.contains("<path"), "{name}: nothing drawn");
        for threads in [2, 4] {
            assert!(one == svg(&model, &camera, Contours::Smooth, threads), "{name}, {threads} threads");
        }
    }
}

fn example(name: &str) -> Scene {
    Scene::open(format!("{}/examples/models/{name}", env!("CARGO_MANIFEST_DIR"))).unwrap()
}

#[test]
fn parts_with_flat_faces_are_drawn_as_before() {
    let prism = tube(6, 1, 1.0, 1.0);
    let mut models = vec![
        ("box", scene([cuboid(DVec3::splat(-1.0), DVec3::new(1.0, 2.0, 0.5))])),
        ("prism", scene([prism])),
    ];
    models.push(("gear.obj", example("gear.obj")));
    for (name, model) in &models {
        for camera in [Camera::three_quarter(), Camera::azimuth_elevation(200.0, -35.0, model.up)] {
            let camera = camera.fit(model);
            let auto = svg(model, &camera, Contours::Auto, 2);
            assert!(auto == svg(model, &camera, Contours::Mesh, 2), "{name} is drawn differently");
        }
    }
}

#[test]
fn rounded_models_are_drawn_otherwise() {
    let model = example("knot.ply");
    let camera = Camera::three_quarter().fit(&model);
    assert!(svg(&model, &camera, Contours::Auto, 2) != svg(&model, &camera, Contours::Mesh, 2));
}
