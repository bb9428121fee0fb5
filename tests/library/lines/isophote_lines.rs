//! Isophotes as lines, tested against closed forms: they are drawn where the tone changes and nowhere else,
//! with and without fills.

use glam::DVec3;
use kurbo::Point;
use ligne::drawing::Drawing;
use ligne::scene::{Camera, Scene};
use ligne::{Style, render};

use crate::library::support::measures::line_picture::{flatten_path, sample_segments, segment_distance};
use crate::library::support::pipeline::{orthographic, scene};
use crate::library::support::references::textbook_camera::TextbookCamera;
use crate::library::support::scenes::solids::{Solid, cuboid, sphere};

/// Returns two styles with isophotes only, at the given thresholds: without and with fills.
fn styles(light: &str, thresholds: &str, more: &str) -> [Style; 2] {
    [false, true].map(|painted| {
        let sheet = format!(
            "extends = 'toon'\n[lines]\nkinds = ['isophote']\n[chain]\nsmooth = 0\ntidy = 0\nsimplify = 0\nfit = false\n\
             [fills]\nenabled = {painted}\nthresholds = {thresholds}\n{more}\n[light]\nfrom_model = false\nsources = [{light}]"
        );
        Style::from_toml(&sheet).expect("a style")
    })
}

/// Returns the isophote segments of a part.
fn lines(drawing: &Drawing, part: &str) -> Vec<[Point; 2]> {
    let marks = drawing.layers.iter().flat_map(|layer| &layer.marks);
    let own = marks.filter(|mark| mark.provenance.classes.first() == Some(&"isophote"));
    let own = own.filter(|mark| mark.provenance.part.as_deref() == Some(part));
    own.flat_map(|mark| flatten_path(&mark.path, 1e-3)).collect()
}

fn drawn(model: &Scene, camera: &Camera, style: &Style, part: &str) -> Vec<[Point; 2]> {
    lines(&render(model, camera, style).expect("a drawing"), part)
}

fn length(lines: &[[Point; 2]]) -> f64 {
    lines.iter().map(|[a, b]| (*b - *a).hypot()).sum()
}

/// Asserts that two sets of lines cover each other within `off` px and have equal length.
fn assert_lines_agree(found: &[[Point; 2]], wanted: &[[Point; 2]], off: f64, name: &str) {
    let near = |p: Point, lines: &[[Point; 2]]| {
        lines.iter().map(|line| segment_distance(p, *line)).fold(f64::INFINITY, f64::min)
    };
    for (p, _) in sample_segments(found, 1.0) {
        assert!(
            near(p, wanted) < off,
            "{name}: a line at {p:?}, {} px from where there is one",
            near(p, wanted)
        );
    }
    for (p, _) in sample_segments(wanted, 1.0) {
        assert!(near(p, found) < off, "{name}: no line at {p:?}");
    }
    let (found, wanted) = (length(found), length(wanted));
    assert!((found - wanted).abs() < 0.01 * wanted + 2.0, "{name}: {found} px in place of {wanted}");
}

/// Projects a 3-D polyline to the image.
fn project_polyline(eye: &TextbookCamera, points: &[DVec3]) -> Vec<[Point; 2]> {
    points.windows(2).map(|pair| [eye.project(pair[0]), eye.project(pair[1])]).collect()
}

/// A horizontal rectangle.
fn sheet(middle: DVec3, half: [f64; 2]) -> Solid {
    let corner = |x: f64, y: f64| middle + DVec3::new(x * half[0], y * half[1], 0.0);
    Solid {
        positions: vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
    }
}

#[test]
fn isophotes_of_a_ball_are_circles_with_and_without_fills() {
    let ball = scene([sphere(96, 1.0)]);
    let camera = orthographic(DVec3::new(0.0, 0.0, 9.0), DVec3::ZERO, 2.4);
    let eye = TextbookCamera::new(&camera);
    let light = "{ kind = 'directional', direction = [0, 0, 1], space = 'world' }";
    let circle = |level: f64| {
        let radius = (1.0 - level * level).sqrt();
        let at = |k: usize| {
            let angle = std::f64::consts::TAU * k as f64 / 720.0;
            DVec3::new(
                ligne::geometry::numbers::portable_math::cos(angle),
                ligne::geometry::numbers::portable_math::sin(angle),
                0.0,
            ) * radius
        };
        project_polyline(&eye, &(0..=720).map(at).collect::<Vec<_>>())
    };
    let wanted = [circle(0.5), circle(0.8)].concat();
    for style in styles(light, "[0.5, 0.8]", "") {
        assert_lines_agree(&drawn(&ball, &camera, &style, "part 0"), &wanted, 1.0, "ball");
    }
}

#[test]
fn no_isophotes_are_drawn_in_a_cast_shadow_on_a_ball() {
    // Light from above, and a sheet over one half of the ball. All points in its shadow have the same tone.
    let model = scene([sphere(96, 1.0), sheet(DVec3::new(1.5, 0.0, 3.0), [1.5, 2.0])]);
    let camera = orthographic(DVec3::new(0.0, -9.0, 0.0), DVec3::ZERO, 2.4);
    let light = "{ kind = 'directional', direction = [0, 0, 1], space = 'world' }";
    let eye = TextbookCamera::new(&camera);
    // From the front, the isophotes are horizontal lines, drawn in the lit half only. The border of the
    // shadow is vertical and ends where the ball turns away from the light.
    let level = |z: f64| {
        project_polyline(&eye, &[DVec3::new(-(1.0 - z * z).sqrt(), 0.0, z), DVec3::new(0.0, 0.0, z)])
    };
    let border = project_polyline(&eye, &[DVec3::new(0.0, 0.0, 0.3), DVec3::new(0.0, 0.0, 1.0)]);
    let wanted = [level(0.3), level(0.6), border].concat();
    for style in styles(light, "[0.3, 0.6]", "cast_shadows = true") {
        assert_lines_agree(&drawn(&model, &camera, &style, "part 0"), &wanted, 1.0, "shadow on a ball");
    }
}

#[test]
fn point_light_isophotes_and_shadow_borders_are_drawn_on_a_plane() {
    // A lamp at (0, 0, 10) lights a circle of radius 6 more brightly than the rest. A small sheet half-way up
    // casts a shadow across the circle.
    let model = scene([sheet(DVec3::ZERO, [12.0, 12.0]), sheet(DVec3::new(3.0, 0.0, 5.0), [0.5, 0.5])]);
    let camera = orthographic(DVec3::new(0.0, 0.0, 30.0), DVec3::ZERO, 26.0);
    let light = "{ kind = 'point', position = [0, 0, 10], space = 'world' }";
    let level = 10.0 / 136.0_f64.sqrt();
    let eye = TextbookCamera::new(&camera);
    // The shadow covers x from 5 to 7 and y from −1 to 1.
    let rim = 35.0_f64.sqrt();
    let start = ligne::geometry::numbers::portable_math::atan2(1.0, rim);
    let arc = |k: usize| {
        let angle = start + (std::f64::consts::TAU - 2.0 * start) * k as f64 / 720.0;
        DVec3::new(
            ligne::geometry::numbers::portable_math::cos(angle),
            ligne::geometry::numbers::portable_math::sin(angle),
            0.0,
        ) * 6.0
    };
    let circle = project_polyline(&eye, &(0..=720).map(arc).collect::<Vec<_>>());
    let corner = |x: f64, y: f64| DVec3::new(x, y, 0.0);
    let border =
        project_polyline(&eye, &[corner(rim, -1.0), corner(5.0, -1.0), corner(5.0, 1.0), corner(rim, 1.0)]);
    let wanted = [circle, border].concat();
    for style in styles(light, &format!("[{level}]"), "cast_shadows = true") {
        assert_lines_agree(&drawn(&model, &camera, &style, "part 0"), &wanted, 1.0, "plane");
    }
    // Without cast shadows, the whole circle is drawn.
    let whole = styles(light, &format!("[{level}]"), "");
    for style in whole {
        let found = length(&drawn(&model, &camera, &style, "part 0"));
        let px = 1000.0 / 26.0;
        assert!((found / (std::f64::consts::TAU * 6.0 * px) - 1.0).abs() < 0.01, "{found}");
    }
}

#[test]
fn shadow_borders_without_a_tone_change_are_not_drawn() {
    // Light falls on the floor at a low angle. At the higher threshold the lit floor already has the darkest
    // tone, so the shadow adds none. The sides of the block have other tones.
    let model =
        scene([sheet(DVec3::ZERO, [9.0, 9.0]), cuboid(DVec3::new(-1.0, -1.0, 0.0), DVec3::splat(1.0))]);
    let camera = orthographic(DVec3::new(12.0, -20.0, 25.0), DVec3::ZERO, 24.0);
    for (threshold, is_inked) in [("[0.4]", true), ("[0.8]", false)] {
        let light = "{ kind = 'directional', direction = [-0.8, 0, 0.6], space = 'world' }";
        for style in styles(light, threshold, "cast_shadows = true") {
            let found = length(&drawn(&model, &camera, &style, "part 0"));
            assert_eq!(found > 0.0, is_inked, "{found} px at {threshold}");
        }
    }
}
