//! Vertex colours become regions and lines; closed-form interpolation is the reference.

use glam::{DAffine3, DVec3};
use kurbo::{Point, Shape as _};
use ligne::colour::oklab::{self, Oklab};
use ligne::colour::srgb::Colour;
use ligne::drawing::Mark;
use ligne::lines::LineKind;
use ligne::pipeline::render;
use ligne::scene::{Camera, Geometry, Material, Part, Projection, Scene};
use ligne::style::Style;

use crate::library::support::measures::line_picture::SegmentGrid;
use crate::library::support::measures::plain_fills::{filled_marks, flat_fill_style};
use crate::library::support::references::drawing_judge::{centre_line, visible_line_marks};
use crate::library::support::references::textbook_camera::TextbookCamera;

/// A scene of triangles with one material.
pub(crate) fn scene(geometry: Geometry, material: Material) -> Scene {
    let part = Part { name: "sheet".to_owned(), geometry: 0, world_from_part: DAffine3::IDENTITY };
    let geometry = Geometry { material: Some(0), ..geometry };
    Scene {
        format: "glTF",
        geometries: vec![geometry],
        parts: vec![part],
        materials: vec![material],
        ..Scene::default()
    }
}

pub(crate) fn white() -> Material {
    Material { name: "sheet".to_owned(), colour: Colour::WHITE, ..Material::default() }
}

/// A square of side 1 with linear-light corner colours, as two triangles.
pub(crate) fn square(corners: [[f32; 3]; 4]) -> Geometry {
    Geometry {
        positions: [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]
            .map(|[x, y]| DVec3::new(x, y, 0.0))
            .to_vec(),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        colours: corners.map(|[r, g, b]| [r, g, b, 1.0]).to_vec(),
        ..Geometry::default()
    }
}

/// Returns the interpolated colour of such a square at a point.
fn interpolated_light([a, b, c, d]: [[f32; 3]; 4], x: f64, y: f64) -> [f32; 3] {
    let mix = |k: usize| {
        let [a, b, c, d] = [a, b, c, d].map(|own| f64::from(own[k]));
        let sum = if y <= x { a + (b - a) * x + (c - b) * y } else { a + (d - a) * y + (c - d) * x };
        sum as f32
    };
    [mix(0), mix(1), mix(2)]
}

/// An orthographic front view of a `width` by `height` area at the origin, 400 px per unit.
pub(crate) fn front(width: f64, height: f64) -> Camera {
    let target = DVec3::new(width / 2.0, height / 2.0, 0.0);
    Camera {
        eye: target + DVec3::Z * 5.0,
        target,
        up: DVec3::Y,
        projection: Projection::Orthographic { height: height * 1.05 },
        width: width * 420.0,
        height: height * 420.0,
        ..Camera::three_quarter()
    }
}

pub(crate) fn top(fills: &[(&Mark, Colour)], p: Point) -> Option<Colour> {
    fills.iter().rev().find(|(mark, _)| mark.path.winding(p) != 0).map(|(_, colour)| *colour)
}

pub(crate) fn palette(fills: &[(&Mark, Colour)]) -> Vec<Colour> {
    let mut colours: Vec<Colour> = fills.iter().map(|(_, colour)| *colour).collect();
    colours.sort_unstable();
    colours.dedup();
    colours
}

/// Returns the palette colour that is perceptually nearest to a light.
fn nearest(palette: &[Colour], light: [f32; 3]) -> Colour {
    let far = |a: Oklab, b: Oklab| oklab::distance2(a, b);
    let own = oklab::of_linear(light);
    *palette.iter().min_by(|a, b| far(oklab::of(**a), own).total_cmp(&far(oklab::of(**b), own))).unwrap()
}

fn points_on_circle(p: Point, radius: f64) -> impl Iterator<Item = Point> {
    let turn = |k: u32| std::f64::consts::TAU * f64::from(k) / 12.0;
    (0..12).map(move |k| p + kurbo::Vec2::from_angle(turn(k)) * radius)
}

/// Asserts that all points farther than `off` from a colour change have the true colour. Returns the number
/// of tested points.
pub(crate) fn assert_colours(
    fills: &[(&Mark, Colour)],
    camera: &Camera,
    off: f64,
    truth: impl Fn(Point) -> Option<Colour>,
) -> u32 {
    let mut asked = 0;
    for k in 0..160 * 160 {
        let [x, y] = [k % 160, k / 160].map(|k| (f64::from(k) + 0.5) / 160.0);
        let p = Point::new(x * camera.width, y * camera.height);
        let Some(own) = truth(p).filter(|own| points_on_circle(p, off).all(|q| truth(q) == Some(*own)))
        else {
            continue;
        };
        assert_eq!(top(fills, p), Some(own), "at {p}");
        asked += 1;
    }
    asked
}

pub(crate) const CORNER_COLOURS: [[f32; 3]; 4] =
    [[0.9, 0.1, 0.05], [0.05, 0.05, 0.6], [0.9, 0.85, 0.6], [0.0, 0.3, 0.1]];

#[test]
fn vertex_colours_are_quantized_with_exact_borders() {
    let model = scene(square(CORNER_COLOURS), white());
    let camera = front(1.0, 1.0);
    let eye = TextbookCamera::new(&camera);
    for count in [3, 6] {
        let drawing =
            render(&model, &camera, &flat_fill_style(&[&format!("fills.texture_colours={count}")])).unwrap();
        let fills = filled_marks(&drawing);
        let palette = palette(&fills);
        assert_eq!(palette.len(), count, "{palette:?}");
        // One region per colour, except where a colour has two separate areas.
        assert!(fills.len() <= count + 3, "{} regions", fills.len());
        let truth = |p: Point| {
            let at = eye.unproject(p, 5.0);
            let is_in = at.x.min(at.y) > 0.0 && at.x.max(at.y) < 1.0;
            is_in.then(|| nearest(&palette, interpolated_light(CORNER_COLOURS, at.x, at.y)))
        };
        assert!(assert_colours(&fills, &camera, 0.6, truth) > 20_000);
    }
}

#[test]
fn faces_of_one_colour_keep_it() {
    // All face colours are kept, although the style allows fewer for varying colours.
    let tints = [[0.30_f32, 0.1, 0.1], [0.5, 0.1, 0.1], [0.1, 0.5, 0.2]];
    let mut all = Geometry::default();
    for (k, tint) in tints.into_iter().enumerate() {
        let own = square([tint; 4]);
        let first = all.positions.len() as u32;
        all.positions.extend(own.positions.iter().map(|p| *p + DVec3::X * k as f64));
        all.triangles.extend(own.triangles.iter().map(|t| t.map(|v| v + first)));
        all.colours.extend(own.colours);
    }
    let drawing =
        render(&scene(all, white()), &front(3.0, 1.0), &flat_fill_style(&["fills.texture_colours=2"]))
            .unwrap();
    let seen = palette(&filled_marks(&drawing));
    let mut own: Vec<Colour> = tints.iter().map(|[r, g, b]| Colour::from_linear([*r, *g, *b, 1.0])).collect();
    own.sort_unstable();
    assert_eq!(seen, own);
}

#[test]
fn artist_lines_follow_vertex_colour_changes_and_seams() {
    // A white square next to it that shares no vertex colours with it.
    let mut all = square(CORNER_COLOURS);
    let beside = square([[1.0; 3]; 4]);
    all.positions.extend(beside.positions.iter().map(|p| *p + DVec3::X));
    all.triangles.extend(beside.triangles.iter().map(|t| t.map(|v| v + 4)));
    all.colours.extend(beside.colours);
    let model = scene(all, white());
    let camera = front(2.0, 1.0);
    let eye = TextbookCamera::new(&camera);
    let fills_drawn = render(&model, &camera, &flat_fill_style(&["fills.texture_colours=5"])).unwrap();
    let palette = palette(&filled_marks(&fills_drawn));
    let truth = |p: Point| {
        let at = eye.unproject(p, 5.0);
        let is_in = at.x.min(at.y) > 0.0 && at.x < 2.0 && at.y < 1.0;
        let light = if at.x < 1.0 { interpolated_light(CORNER_COLOURS, at.x, at.y) } else { [1.0; 3] };
        is_in.then(|| nearest(&palette, light))
    };
    for style in ["ink", "toon"] {
        let changes = ["lines.kinds=['artist']", "fills.texture_colours=5"].map(str::to_owned);
        let drawing = render(&model, &camera, &Style::load_with(style, &changes).unwrap()).unwrap();
        let is_artist = |mark: &&Mark| mark.provenance.classes.contains(&LineKind::Artist.name());
        let drawn: Vec<[Point; 2]> =
            visible_line_marks(&drawing).filter(is_artist).flat_map(centre_line).collect();
        assert!(drawn.len() > 20, "{} pieces", drawn.len());
        for p in drawn.iter().map(|[a, b]| a.midpoint(*b)) {
            let seen: Vec<_> = points_on_circle(p, 1.5).map(truth).collect();
            assert!(seen.iter().any(|own| *own != seen[0]), "a line at {p}, where nothing changes");
        }
        let ink = SegmentGrid::new(drawn, 4.0);
        for k in 0..200 * 100 {
            let p = Point::new(f64::from(k % 200) * 4.2, f64::from(k / 200) * 4.2);
            let q = p + kurbo::Vec2::new(1.0, 0.0);
            if truth(p).is_some() && truth(q).is_some() && truth(p) != truth(q) {
                assert!(ink.distance(p) < 2.0, "no line at {p}");
            }
        }
    }
    // Along the shared side, colours differ at some points and are white on both sides at others.
    let along = |y: f64| [0.999, 1.001].map(|x| truth(eye.project(DVec3::new(x, y, 0.0))));
    let parted = (1..100)
        .filter(|k| {
            let [a, b] = along(f64::from(*k) / 100.0);
            a != b
        })
        .count();
    assert!((10..90).contains(&parted), "{parted}");
}
