//! A surface with every face in its own part is drawn like the surface in one part; the drawing of the one
//! part is the reference.

use crate::library::support::measures::segment_sets::{total_length, uncovered_length};
use crate::library::support::pipeline::scene;
use crate::library::support::references::drawing_judge::{centre_line, visible_line_marks};
use crate::library::support::scenes::hard_scenes::camera_from_any_side;
use crate::library::support::scenes::random_dice::Dice;
use crate::library::support::scenes::round_solids::{globe, icosphere, saddle};
use crate::library::support::scenes::solids::{Solid, cuboid, sphere, torus, tube};
use glam::DVec3;
use kurbo::Point;
use ligne::drawing::Drawing;
use ligne::pipeline::render;
use ligne::scene::{Camera, Scene};
use ligne::style::Style;

/// Returns every face as a separate solid with its own vertices.
fn single_faces(solid: &Solid) -> Vec<Solid> {
    let face = |triangle: &[u32; 3]| Solid {
        positions: triangle.map(|v| solid.positions[v as usize]).to_vec(),
        triangles: vec![[0, 1, 2]],
    };
    solid.triangles.iter().map(face).collect()
}

fn draw(scene: &Scene, camera: &Camera, style: &str) -> Drawing {
    render(scene, camera, &Style::preset(style).unwrap()).unwrap()
}

/// Returns the lines of one pen: silhouettes or all others.
fn strokes_of_pen(drawing: &Drawing, outline: bool) -> Vec<[Point; 2]> {
    let marks =
        visible_line_marks(drawing).filter(|mark| mark.provenance.classes.contains(&"silhouette") == outline);
    marks.flat_map(centre_line).collect()
}

/// Asserts that two scenes have the same lines per pen, within a distance in px.
fn assert_alike(name: &str, one: &Scene, other: &Scene, within: f64) {
    let dice = &mut Dice::new(7);
    for style in ["ink", "technical"] {
        for _ in 0..4 {
            let camera = camera_from_any_side(dice);
            let [one, other] = [one, other].map(|scene| draw(scene, &camera, style));
            for outline in [true, false] {
                let [one, other] = [&one, &other].map(|drawing| strokes_of_pen(drawing, outline));
                let (missing, extra) =
                    (uncovered_length(&one, &other, within), uncovered_length(&other, &one, within));
                // Tolerance for the directions of short end pieces.
                let slack = 1.0 + 0.002 * total_length(&one);
                assert!(
                    missing <= slack && extra <= slack,
                    "{name}, {style} from {}: {missing} px of {} missing, {extra} too much; outline {outline}",
                    camera.eye,
                    total_length(&one)
                );
            }
        }
    }
}

#[test]
fn a_rounded_surface_of_single_faces_has_the_lines_of_one_part() {
    let solids = [
        ("icosphere 1", icosphere(1)),
        ("icosphere 2", icosphere(2)),
        ("globe", globe(24)),
        ("torus", torus(24, 12, 1.0, 0.45)),
        ("fine torus", torus(48, 24, 1.0, 0.3)),
        ("tube", tube(24, 5, 0.7, 1.0)),
        ("saddle", saddle(12)),
    ];
    for (name, solid) in solids {
        assert_alike(name, &scene([solid.clone()]), &scene(single_faces(&solid)), 0.5);
    }
}

#[test]
fn a_box_of_single_faces_has_the_lines_of_one_part() {
    let solid = cuboid(DVec3::new(-1.0, -0.6, -0.8), DVec3::new(1.0, 0.6, 0.8));
    assert_alike("box", &scene([solid.clone()]), &scene(single_faces(&solid)), 0.06);
}

#[test]
fn nearby_bodies_of_single_faces_have_the_lines_of_whole_parts() {
    // A ball in front of a box that it does not touch, and two boxes that share an edge.
    let ball = sphere(16, 0.6).moved(|p| p + DVec3::new(0.0, 0.0, 1.5));
    let boxes = [DVec3::splat(-1.0), DVec3::new(0.0, 0.0, -1.0)].map(|low| cuboid(low, low + 1.0));
    let [first, second] = boxes;
    let parts = [ball, first, second];
    let single: Vec<Solid> = parts.iter().flat_map(single_faces).collect();
    assert_alike("ball and boxes", &scene(parts), &scene(single), 0.5);
}

#[test]
fn the_outline_of_a_ball_of_single_faces_is_one_ring() {
    let ball = scene(single_faces(&icosphere(2)));
    let camera = Camera::three_quarter().fit(&ball);
    let drawing = draw(&ball, &camera, "ink");
    // Every piece ends where another one begins.
    let mut ends: Vec<[i64; 2]> = Vec::new();
    for mark in visible_line_marks(&drawing) {
        let axis = centre_line(mark);
        let (first, last) = (axis[0][0], axis[axis.len() - 1][1]);
        ends.extend([first, last].map(|p| [p.x, p.y].map(|c| (c * 1000.0).round() as i64)));
        assert!(mark.provenance.part.is_some());
    }
    ends.sort_unstable();
    assert!(ends.len() > 20 && ends.chunks(2).all(|pair| pair[0] == pair[1]), "{ends:?}");
}
