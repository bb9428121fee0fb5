//! Textures, alone and multiplied by vertex colours, become regions and lines.

use std::sync::Arc;

use glam::DVec3;
use kurbo::Point;
use ligne::colour::srgb::Colour;
use ligne::pipeline::render;
use ligne::scene::{Camera, Filter, Geometry, Material, Projection};
use ligne::style::Style;

use super::painted_surfaces::{CORNER_COLOURS, assert_colours, front, palette, scene, square, top, white};
use crate::library::support::measures::plain_fills::{filled_marks, flat_fill_style};
use crate::library::support::references::drawing_judge::{centre_line, visible_line_marks};
use crate::library::support::references::textbook_camera::TextbookCamera;

const NONE: u32 = u32::MAX;

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
        Style::load(folder.join("sheet.toml").to_str().unwrap()).unwrap()
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
    let error = Style::load(folder.join("sheet.toml").to_str().unwrap()).unwrap_err();
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
