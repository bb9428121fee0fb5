//! Colours that vary on a surface (vertex colours, textures, and both) become regions and lines; closed-form
//! interpolation is the reference.

use std::sync::Arc;

use glam::{DAffine3, DVec3};
use kurbo::{Point, Shape as _};
use ligne::colour::oklab::{self, Oklab};
use ligne::colour::srgb::Colour;
use ligne::drawing::Mark;
use ligne::lines::LineKind;
use ligne::pipeline::render;
use ligne::scene::{Camera, Filter, Geometry, Material, Part, Projection, Scene};
use ligne::style::Style;

use crate::support::measures::line_picture::SegmentGrid;
use crate::support::measures::plain_fills::{filled_marks, flat_fill_style};
use crate::support::references::drawing_judge::{centre_line, visible_line_marks};
use crate::support::references::textbook_camera::TextbookCamera;

const NONE: u32 = u32::MAX;

/// A scene of triangles with one material.
fn scene(geometry: Geometry, material: Material) -> Scene {
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

fn white() -> Material {
    Material { name: "sheet".to_owned(), colour: Colour::WHITE, ..Material::default() }
}

/// A square of side 1 with linear-light corner colours, as two triangles.
fn square(corners: [[f32; 3]; 4]) -> Geometry {
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
fn front(width: f64, height: f64) -> Camera {
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

fn top(fills: &[(&Mark, Colour)], p: Point) -> Option<Colour> {
    fills.iter().rev().find(|(mark, _)| mark.path.winding(p) != 0).map(|(_, colour)| *colour)
}

fn palette(fills: &[(&Mark, Colour)]) -> Vec<Colour> {
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
fn assert_colours(
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

const CORNER_COLOURS: [[f32; 3]; 4] =
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
        let drawing = render(&model, &camera, &Style::load(style, &changes).unwrap()).unwrap();
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

/// Encodes a picture as PNG.
fn png(width: u32, height: u32, of: impl Fn(u32, u32) -> [u8; 3]) -> Arc<[u8]> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    let pixels: Vec<u8> = (0..width * height).flat_map(|k| of(k % width, k / width)).collect();
    encoder.write_header().unwrap().write_image_data(&pixels).unwrap();
    Arc::from(bytes)
}

/// A square that repeats a picture `times` times.
fn pictured(times: f32) -> Geometry {
    Geometry {
        uvs: vec![[0.0, times], [times, times], [times, 0.0], [0.0, 0.0]],
        corner_uvs: vec![[0, 1, 2], [0, 2, 3]],
        colours: Vec::new(),
        ..square([[1.0; 3]; 4])
    }
}

#[test]
fn textures_and_vertex_colours_multiply() {
    let (red, blue) = ([210, 60, 50], [60, 90, 200]);
    let picture =
        png(64, 64, |x, y| if (x as i32 - 32).pow(2) + (y as i32 - 32).pow(2) < 400 { red } else { blue });
    let material = Material { picture: Some(picture), ..white() };
    let dark = 0.15_f32;
    let colours = [[1.0; 3], [dark; 3], [dark; 3], [1.0; 3]];
    let geometry = Geometry { colours: square(colours).colours, ..pictured(1.0) };
    let camera = front(1.0, 1.0);
    let eye = TextbookCamera::new(&camera);
    let drawing =
        render(&scene(geometry, material), &camera, &flat_fill_style(&["fills.texture_colours=2"])).unwrap();
    let fills = filled_marks(&drawing);
    assert_eq!(palette(&fills).len(), 4);
    let mut seen = [0; 2];
    for k in 0..80 * 80 {
        let p = Point::new((f64::from(k % 80) + 0.5) * 5.25, (f64::from(k / 80) + 0.5) * 5.25);
        let at = eye.unproject(p, 5.0);
        let Some(colour) = top(&fills, p).filter(|_| at.x.min(at.y) > 0.01 && at.x.max(at.y) < 0.99) else {
            continue;
        };
        let off = (at.truncate() - 0.5).length() - 20.0 / 64.0;
        if off.abs() > 0.02 {
            assert_eq!(colour.r > colour.b, off < 0.0, "at {p}");
            seen[usize::from(off < 0.0)] += 1;
        }
        // Both colours get darker to the right.
        let same_left = top(&fills, Point::new(60.0, p.y)).map(|left| left.luma());
        assert!(at.x < 0.9 || off < 0.0 || same_left.is_none_or(|left| colour.luma() < left), "at {p}");
    }
    assert!(seen.iter().all(|count| *count > 1000), "{seen:?}");
}

#[test]
fn nearest_filtered_texels_keep_their_corners() {
    let art = [
        0b0011_1100_u8,
        0b0100_0010,
        0b1010_0101,
        0b1000_0001,
        0b1010_0101,
        0b1001_1001,
        0b0100_0010,
        0b0011_1100,
    ];
    let is_set = |x: u32, y: u32| art[y as usize] >> x & 1 == 1;
    let picture = png(8, 8, |x, y| if is_set(x, y) { [30, 30, 40] } else { [250, 210, 60] });
    let material = Material { picture: Some(picture), filter: Filter::Blocks, ..white() };
    let camera = front(1.0, 1.0);
    let eye = TextbookCamera::new(&camera);
    let drawing = render(&scene(pictured(1.0), material), &camera, &flat_fill_style(&[])).unwrap();
    let fills = filled_marks(&drawing);
    let truth = |p: Point| {
        let at = eye.unproject(p, 5.0);
        let is_in = at.x.min(at.y) > 0.0 && at.x.max(at.y) < 1.0;
        let own = |x: f64, y: f64| is_set(((x * 8.0) as u32).min(7), (((1.0 - y) * 8.0) as u32).min(7));
        is_in.then(|| if own(at.x, at.y) { Colour::rgb(30, 30, 40) } else { Colour::rgb(250, 210, 60) })
    };
    assert!(assert_colours(&fills, &camera, 0.8, truth) > 20_000);
}

#[test]
fn a_checkered_floor_has_tiles_nearby_and_their_mean_far_away() {
    let (dark, pale) = (Colour::rgb(40, 60, 120), Colour::rgb(240, 230, 210));
    let of = |own: Colour| [own.r, own.g, own.b];
    let picture = png(32, 32, |x, y| of(if (x / 16 + y / 16) % 2 == 1 { dark } else { pale }));
    let material = Material { picture: Some(picture), ..white() };
    let mut floor = pictured(20.0);
    // 40 tiles wide and deep, starting at the camera.
    floor.positions = [[-20.0, 0.0], [20.0, 0.0], [20.0, -40.0], [-20.0, -40.0]]
        .map(|[x, z]| DVec3::new(x, 0.0, z))
        .to_vec();
    let camera = Camera {
        eye: DVec3::new(0.3, 1.2, 2.0),
        target: DVec3::new(0.0, 0.0, -5.0),
        up: DVec3::Y,
        projection: Projection::Perspective { fov_y_deg: 45.0 },
        width: 600.0,
        height: 400.0,
        ..Camera::three_quarter()
    };
    let eye = TextbookCamera::new(&camera);
    let drawing = render(&scene(floor, material), &camera, &flat_fill_style(&[])).unwrap();
    let fills = filled_marks(&drawing);
    assert_eq!(palette(&fills).len(), 3);
    assert!(fills.len() < 400, "{} regions", fills.len());
    let on_floor = |p: Point| {
        let (near, far) = (eye.unproject(p, 0.0), eye.unproject(p, 1.0));
        let way = far - near;
        let at = near - way * (near.y / way.y);
        (way.y < 0.0 && at.z > -40.0 && at.z < 0.0 && at.x.abs() < 20.0).then_some(at)
    };
    let tile = |at: DVec3| if (at.x.floor() + at.z.floor()).rem_euclid(2.0) == 1.0 { dark } else { pale };
    // Near the camera, every tile is drawn. Texel filtering rounds their corners.
    let near = |p: Point| on_floor(p).filter(|at| at.z > -9.0).map(tile);
    assert!(assert_colours(&fills, &camera, 4.0, near) > 5000);
    // Far away, the floor has the mean of both colours.
    let mean = *palette(&fills).iter().find(|own| ![dark, pale].contains(own)).unwrap();
    let far = |p: Point| on_floor(p).filter(|at| at.z < -32.0).map(|_| mean);
    assert!(assert_colours(&fills, &camera, 1.0, far) > 20);
}

#[test]
fn artist_textures_of_the_style_give_lines_and_no_fills() {
    let folder = std::env::temp_dir().join(format!("ligne-artist-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let disc = |x: u32, y: u32| (x as i32 - 32).pow(2) + (y as i32 - 32).pow(2) < 400;
    std::fs::write(folder.join("ink.png"), png(64, 64, |x, y| if disc(x, y) { [0; 3] } else { [255; 3] }))
        .unwrap();
    let sheet = |table: &str| {
        let text = format!("extends = \"toon\"\n[lines]\nkinds = [\"artist\"]\n{table}\n");
        std::fs::write(folder.join("sheet.toml"), text).unwrap();
        Style::load(folder.join("sheet.toml").to_str().unwrap(), &[]).unwrap()
    };
    // The painted texture has two halves, and no line is drawn between them.
    let halves = png(8, 8, |x, _| if x < 4 { [200, 0, 0] } else { [0, 0, 200] });
    let material = Material { picture: Some(halves), ..white() };
    let model = scene(pictured(1.0), material);
    let camera = front(1.0, 1.0);
    let eye = TextbookCamera::new(&camera);
    for (table, has_disc) in [
        ("artist_texture = \"ink.png\"", true),
        ("artist_texture = { \"sh*\" = \"ink.png\" }", true),
        ("artist_texture = { other = \"ink.png\" }", false),
        ("artist_texture = \"ink.png\"\nartist_smooth = 100.0", false),
    ] {
        let style = sheet(table);
        let drawing = render(&model, &camera, &style).unwrap();
        // If the smoothing removes the line of the disc, it also removes the fills.
        let is_smooth = table.contains("smooth");
        assert!(
            is_smooth || palette(&filled_marks(&drawing)).len().is_multiple_of(2),
            "both halves are painted"
        );
        let drawn: Vec<[Point; 2]> = visible_line_marks(&drawing).flat_map(centre_line).collect();
        // The centre of the disc is the centre of a texel.
        let middle = glam::DVec2::new(32.5, 31.5) / 64.0;
        let off = |p: Point| ((eye.unproject(p, 5.0).truncate() - middle).length() - 20.0 / 64.0).abs();
        let on_disc = drawn.iter().filter(|[a, b]| off(a.midpoint(*b)) < 0.012).count();
        assert_eq!(on_disc > 8, has_disc, "{table}: {on_disc} of {}", drawn.len());
        if has_disc {
            let beside: Vec<Point> =
                drawn.iter().map(|[a, b]| a.midpoint(*b)).filter(|p| off(*p) >= 0.012).collect();
            assert!(beside.is_empty(), "{table}: {beside:?}");
        }
    }
    let missing = "[lines]\nartist_texture = \"none.png\"\n";
    std::fs::write(folder.join("sheet.toml"), missing).unwrap();
    let error = Style::load(folder.join("sheet.toml").to_str().unwrap(), &[]).unwrap_err();
    assert!(error.to_string().contains("none.png"), "{error}");
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn non_finite_colours_and_texture_coordinates_are_painted() {
    let mut geometry = square(CORNER_COLOURS);
    geometry.colours[1] = [f32::NAN, f32::INFINITY, -3.0, 1.0];
    geometry.corner_uvs = vec![[0, NONE, 1], [NONE; 3]];
    geometry.uvs = vec![[f32::NAN, 0.0], [1e30, 0.0]];
    let material = Material { picture: Some(png(2, 2, |x, _| [x as u8 * 255; 3])), ..white() };
    for material in [white(), material] {
        let drawing =
            render(&scene(geometry.clone(), material), &front(1.0, 1.0), &flat_fill_style(&[])).unwrap();
        assert!(!filled_marks(&drawing).is_empty());
    }
}
