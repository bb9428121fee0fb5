//! Brush shapes chosen by the turn to the next segment: straight, left or right (Lake et al. 2000, equation
//! 3). Inked areas are the reference.

use glam::DVec3;
use kurbo::Shape;
use ligne::pipeline::render;
use ligne::scene::{Camera, Scene};
use ligne::style::Style;

use crate::library::support::pipeline::{self, orthographic};
use crate::library::support::scenes::solids::{cuboid, sphere};

const BOX: &str = "M0 0H10V10H0Z";
const WEDGE: &str = "M0 0L10 5L0 10Z";

/// Returns the inked area of a drawing with a box brush for straight pieces, and the given shapes for left
/// and right turns.
fn inked_area(scene: &Scene, camera: &Camera, left: &str, right: &str, turn: f64) -> f64 {
    let brush = format!(
        "pen.brush={{ path = '{BOX}', left = '{left}', right = '{right}', turn = {turn}, mode = 'repeat', length = 20 }}"
    );
    let sets = [
        brush,
        "pen.width=4".to_owned(),
        "pen.silhouette.width=4".to_owned(),
        "pen.contour.width=4".to_owned(),
    ];
    let style = Style::load_with("ink", &sets).unwrap_or_else(|error| panic!("{error}"));
    let drawing = render(scene, camera, &style).unwrap();
    drawing.layers.iter().flat_map(|layer| &layer.marks).map(|mark| mark.path.area().abs()).sum()
}

#[test]
fn curved_lines_use_turning_shapes_and_straight_lines_do_not() {
    let ball = pipeline::scene([sphere(80, 1.0)]);
    let camera = orthographic(DVec3::new(0.0, -5.0, 0.0), DVec3::ZERO, 20.0);
    let plain = inked_area(&ball, &camera, BOX, BOX, 5.0);
    let (left, right) =
        (inked_area(&ball, &camera, WEDGE, BOX, 5.0), inked_area(&ball, &camera, BOX, WEDGE, 5.0));
    // On a circle of radius 50 px, consecutive pieces of 20 px turn by 23 degrees.
    let (turned, other) = (left.min(right), left.max(right));
    assert!(
        (other / plain - 1.0).abs() < 1e-9 && (turned / plain - 0.5).abs() < 0.03,
        "{plain} {left} {right}"
    );
    // Turns below the threshold count as straight.
    assert!((inked_area(&ball, &camera, WEDGE, WEDGE, 40.0) / plain - 1.0).abs() < 1e-9);
    let solid = pipeline::scene([cuboid(DVec3::splat(-1.0), DVec3::splat(1.0))]);
    let front = orthographic(DVec3::new(0.0, -5.0, 0.0), DVec3::ZERO, 4.0);
    let straight = inked_area(&solid, &front, WEDGE, WEDGE, 5.0) / inked_area(&solid, &front, BOX, BOX, 5.0);
    // At each of the four corners, one piece turns to the next.
    assert!(straight > 0.9 && straight < 1.0, "{straight}");
}

#[test]
fn turning_shapes_may_be_files_and_pictures() {
    let ball = pipeline::scene([sphere(80, 1.0)]);
    let camera = orthographic(DVec3::new(0.0, -5.0, 0.0), DVec3::ZERO, 20.0);
    let folder = std::env::temp_dir().join(format!("ligne-turns-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    // The wedge as an SVG file, a picture with ink in its upper half, and a picture with a hole.
    std::fs::write(
        folder.join("wedge.svg"),
        format!("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 10 10'><path d='{WEDGE}'/></svg>"),
    )
    .unwrap();
    type Dark = fn(u32, u32) -> bool;
    let pictures: [(&str, Dark); 3] = [
        ("box.png", |_, _| true),
        ("half.png", |_, y| y < 20),
        ("hole.png", |x, y| !(10..30).contains(&x) || !(10..30).contains(&y)),
    ];
    for (name, dark) in pictures {
        let mut encoder = png::Encoder::new(std::fs::File::create(folder.join(name)).unwrap(), 40, 40);
        encoder.set_color(png::ColorType::Grayscale);
        let pixels: Vec<u8> = (0..1600).map(|k| if dark(k % 40, k / 40) { 0 } else { 255 }).collect();
        encoder.write_header().unwrap().write_image_data(&pixels).unwrap();
    }
    let area = |left: &str, right: &str| {
        let sheet = format!(
            "extends = 'ink'\n[pen]\nwidth = 4\nsilhouette.width = 4\nbrush = {{ image = 'box.png', mode = 'repeat', \
             length = 20, turn = 5, left = {{ {left} }}, right = {{ {right} }} }}\n"
        );
        std::fs::write(folder.join("sheet.toml"), sheet).unwrap();
        let style = Style::load(folder.join("sheet.toml").to_str().unwrap());
        let style = style.unwrap_or_else(|error| panic!("{error}"));
        let drawing = render(&ball, &camera, &style).unwrap();
        drawing.layers.iter().flat_map(|layer| &layer.marks).map(|mark| mark.path.area().abs()).sum::<f64>()
    };
    let plain = area("image = 'box.png'", "image = 'box.png'");
    for (shape, part) in [
        ("file = 'wedge.svg'", 0.5),
        ("image = 'half.png'", 0.5),
        ("image = 'hole.png'", 0.75),
        ("path = 'M0 0H1V1H0Z'", 1.0),
    ] {
        let found = [area(shape, "image = 'box.png'"), area("image = 'box.png'", shape)];
        let (turned, other) = (found[0].min(found[1]), found[0].max(found[1]));
        assert!((other / plain - 1.0).abs() < 0.01, "{shape}: {found:?} {plain}");
        assert!((turned / plain - part).abs() < 0.03, "{shape}: {found:?} {plain}");
    }
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn invalid_turning_brushes_are_rejected() {
    for (brush, word) in [
        ("{ path = 'M0 0H1V1Z', left = 'M0 0H1V1Z' }", "repeat"),
        ("{ path = 'M0 0H1V1Z', left = 'M0', mode = 'repeat' }", "brush"),
        ("{ path = 'M0 0H1V1Z', right = { image = 'lost.png' }, mode = 'repeat' }", "lost.png"),
        (
            "{ path = 'M0 0H1V1Z', right = { inside = 'solid', path = 'M0 0H1V1Z' }, mode = 'repeat' }",
            "image",
        ),
        ("{ path = 'M0 0H1V1Z', right = 3, mode = 'repeat' }", "path data"),
        ("{ path = 'M0 0H1V1Z', turn = 200, mode = 'repeat' }", "0 to 180"),
    ] {
        let error = Style::load_with("ink", &[format!("pen.brush={brush}")]).unwrap_err().to_string();
        assert!(error.contains(word), "{brush}: {error}");
    }
}
