//! Contours of folds thinner than a pen are not drawn, and all wider folds are; tested against known lengths.

use glam::DVec3;
use kurbo::Point;
use ligne::drawing::Length;
use ligne::geometry::numbers::portable_math::{cos, sin};
use ligne::pipeline::render;
use ligne::scene::Camera;
use ligne::style::Style;

use crate::library::support::measures::segment_sets::total_length;
use crate::library::support::pipeline::{orthographic, scene};
use crate::library::support::references::drawing_judge::{centre_line, visible_line_marks};
use crate::library::support::scenes::solids::Solid;

/// A square of side 40 with a step in its middle, 20 long from tip to tip. The surface rises to the step and
/// falls behind its edge by half its width.
fn step(width: f64) -> Solid {
    let up = width / 2.0;
    let positions = [
        [-20.0, -20.0, 0.0],
        [20.0, -20.0, 0.0],
        [20.0, 20.0, 0.0],
        [-20.0, 20.0, 0.0],
        [-10.0, 0.0, 0.0],
        [10.0, 0.0, 0.0],
        [0.0, 0.0, up],
        [0.0, width, 0.0],
    ];
    Solid {
        positions: positions.map(DVec3::from_array).to_vec(),
        triangles: vec![
            [0, 1, 6],
            [0, 6, 4],
            [1, 5, 6],
            [4, 6, 7],
            [6, 5, 7],
            [0, 4, 3],
            [1, 2, 5],
            [4, 7, 3],
            [5, 2, 7],
            [7, 2, 3],
        ],
    }
}

/// A view from the front at a given elevation, with 25 px per unit. Below 26.6 degrees, the falling side of
/// the step faces away.
fn front_camera(elevation_deg: f64) -> Camera {
    let angle = elevation_deg.to_radians();
    let eye = DVec3::new(0.0, -100.0 * cos(angle), 100.0 * sin(angle));
    Camera { up: DVec3::Z, ..orthographic(eye, DVec3::ZERO, 40.0) }
}

/// Returns the drawn length near the middle of the page, px.
fn drawn_length(solid: Solid, elevation_deg: f64, tidy: Option<f64>) -> f64 {
    let mut style = Style::preset("ink").unwrap();
    if let Some(tidy) = tidy {
        style.chain.tidy = Length::px(tidy);
    }
    let drawing = render(&scene([solid]), &front_camera(elevation_deg), &style).unwrap();
    let is_inside = |p: Point| (100.0..900.0).contains(&p.x) && (400.0..600.0).contains(&p.y);
    let inside = |s: &[Point; 2]| s.iter().all(|p| is_inside(*p));
    let strokes: Vec<[Point; 2]> =
        visible_line_marks(&drawing).flat_map(centre_line).filter(inside).collect();
    total_length(&strokes)
}

#[test]
fn a_fold_thinner_than_a_pen_is_not_drawn() {
    // 0.3 px in the image, and 2.8 px in space.
    let thin = 0.1;
    assert_eq!(drawn_length(step(thin), 20.0, None), 0.0);
    assert!((drawn_length(step(thin), 20.0, Some(0.0)) - 500.0).abs() < 1.0, "it is a contour that is seen");
}

#[test]
fn a_step_wider_than_a_pen_is_drawn() {
    // Also where its back faces are nearly edge-on and take no more image area than a thin fold.
    for elevation_deg in [20.0, 26.0] {
        let wide = drawn_length(step(0.5), elevation_deg, None);
        assert!((wide - 500.0).abs() < 5.0, "{elevation_deg}: {wide}");
    }
}

/// The same step with tips 28 apart and a zigzag edge: one needle triangle faces away, the next faces the
/// camera.
fn zigzag_step() -> Solid {
    let (up, needle) = (0.25, 0.04);
    let foot = needle + 3.0_f64.sqrt() * up;
    let positions = [
        [-20.0, -20.0, 0.0],
        [20.0, -20.0, 0.0],
        [20.0, 20.0, 0.0],
        [-20.0, 20.0, 0.0],
        [-14.0, 0.0, 0.0],
        [14.0, 0.0, 0.0],
        [-10.0, 0.0, up],
        [10.0, 0.0, up],
        [-10.0, needle, up - needle / 3.0_f64.sqrt()],
        [10.0, needle, up],
        [-10.0, foot, 0.0],
        [10.0, foot, 0.0],
    ];
    Solid {
        positions: positions.map(DVec3::from_array).to_vec(),
        triangles: vec![
            [0, 1, 7],
            [0, 7, 6],
            [0, 6, 4],
            [1, 5, 7],
            [6, 7, 8],
            [7, 9, 8],
            [4, 6, 8],
            [4, 8, 10],
            [8, 9, 11],
            [8, 11, 10],
            [9, 5, 11],
            [7, 5, 9],
            [0, 4, 3],
            [1, 2, 5],
            [4, 10, 3],
            [10, 11, 3],
            [11, 2, 3],
            [11, 5, 2],
        ],
    }
}

#[test]
fn a_contour_folded_by_needle_triangles_is_drawn() {
    let line = drawn_length(zigzag_step(), 20.0, None);
    // Parts of it are drawn twice.
    assert!(line > 695.0, "{line}");
}

#[test]
fn a_spike_thinner_than_a_pen_is_drawn() {
    let around = 12u32;
    let ring = |k: u32| {
        let angle = std::f64::consts::TAU * f64::from(k) / f64::from(around);
        DVec3::new(cos(angle), sin(angle), 0.0) * 0.006
    };
    let mut solid = step(0.0);
    solid.positions.truncate(4);
    solid.triangles = vec![[0, 1, 2], [0, 2, 3]];
    let first = solid.positions.len() as u32;
    solid.positions.extend((0..around).map(ring));
    solid.positions.push(DVec3::Z * 4.0);
    let tip = first + around;
    solid.triangles.extend((0..around).map(|k| [first + k, first + (k + 1) % around, tip]));
    let spike = drawn_length(solid, 20.0, None);
    assert!(spike > 90.0, "{spike}");
}
