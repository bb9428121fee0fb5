//! Textures embedded in the drawing: each point shows the texel that projection gives, each picture is stored
//! once, and tones shade it.

use std::sync::Arc;

use glam::{DAffine3, DVec2, DVec3};
use kurbo::Point;
use ligne::colour::pixel_picture::Picture;
use ligne::colour::srgb::Colour;
use ligne::diff::{DiffOptions, Picture as Read, canonical_svg, compare};
use ligne::drawing::{Drawing, Mark, Paint, PieceContent};
use ligne::export::{Grouping, PngOptions, Resolution, SvgOptions};
use ligne::pipeline::render;
use ligne::scene::{Camera, Geometry, Material, Part, Projection, Scene, Wrap};
use ligne::style::Style;

use crate::library::support::references::textbook_camera::TextbookCamera;

const DARK: [u8; 3] = [40, 70, 120];
const LIGHT: [u8; 3] = [240, 220, 150];

/// Size of a texel of the checker, in cells.
const TEXEL_SIZE_CELLS: f64 = 1.0 / 16.0;

/// A style with embedded textures in one tone and without ink.
fn plain_style(changes: &[&str]) -> Style {
    let mut all = vec![
        "lines.enabled=false",
        "fills.thresholds=[]",
        "fills.tones=[1.0]",
        "light.from_model=false",
        "fills.texture='image'",
    ];
    all.extend(changes);
    Style::load_with("toon", &all.iter().map(|change| (*change).to_owned()).collect::<Vec<_>>()).unwrap()
}

fn png(side: u32, pixel: impl Fn(u32, u32) -> [u8; 3]) -> Arc<[u8]> {
    let samples: Vec<u8> = (0..side * side).flat_map(|k| pixel(k % side, k / side)).collect();
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, side, side);
    encoder.set_color(png::ColorType::Rgb);
    encoder.write_header().unwrap().write_image_data(&samples).unwrap();
    Arc::from(bytes)
}

/// Quads from (x0, y0) to (x1, y1) at height z, each with the texture coordinates of two opposite corners.
fn quads(quads: &[[f64; 5]], uvs: &[[f32; 4]], material: Material) -> Scene {
    let mut geometry = Geometry::default();
    for ([x0, y0, x1, y1, z], [u0, v0, u1, v1]) in quads.iter().zip(uvs) {
        let first = geometry.positions.len() as u32;
        geometry
            .positions
            .extend([[x0, y0], [x1, y0], [x1, y1], [x0, y1]].map(|[x, y]| DVec3::new(*x, *y, *z)));
        geometry.uvs.extend([[*u0, *v0], [*u1, *v0], [*u1, *v1], [*u0, *v1]]);
        for triangle in [[0, 1, 2], [0, 2, 3]] {
            geometry.triangles.push(triangle.map(|k| first + k));
            geometry.corner_uvs.push(triangle.map(|k| first + k));
        }
    }
    geometry.triangle_material = vec![0; geometry.triangles.len()];
    let part = Part { name: "plate".to_owned(), geometry: 0, world_from_part: DAffine3::IDENTITY };
    Scene {
        format: "glTF",
        materials: vec![material],
        geometries: vec![geometry],
        parts: vec![part],
        ..Scene::default()
    }
}

fn painted(picture: Arc<[u8]>) -> Material {
    Material {
        name: "paint".to_owned(),
        colour: Colour::WHITE,
        picture: Some(picture),
        ..Material::default()
    }
}

fn checker(cells: u32) -> Material {
    painted(png(16 * cells, |x, y| if (x / 16 + y / 16) % 2 == 0 { DARK } else { LIGHT }))
}

fn pixels(drawing: &Drawing, width: u32) -> Picture {
    let options = PngOptions::of_resolution(Resolution::Width(width));
    Picture::decode(&drawing.to_png(&options).unwrap()).unwrap()
}

fn images(drawing: &Drawing) -> Vec<&Mark> {
    let marks = drawing.layers.iter().flat_map(|layer| &layer.marks);
    marks.filter(|mark| matches!(mark.paint, Paint::Image(_))).collect()
}

fn colour_difference(colour: Colour, [r, g, b]: [u8; 3]) -> u8 {
    colour.r.abs_diff(r).max(colour.g.abs_diff(g)).max(colour.b.abs_diff(b))
}

#[test]
fn texels_of_a_checker_match_the_perspective_projection() {
    let scene = quads(&[[-4.0, -4.0, 4.0, 4.0, 0.0]], &[[0.0, 0.0, 1.0, 1.0]], checker(16));
    let camera = Camera {
        eye: DVec3::new(1.0, -6.0, 2.5),
        target: DVec3::new(0.0, -1.0, 0.0),
        up: DVec3::Z,
        projection: Projection::Perspective { fov_y_deg: 50.0 },
        width: 800.0,
        height: 600.0,
        ..Camera::three_quarter()
    };
    let eye = TextbookCamera::new(&camera);
    let drawing = render(&scene, &camera, &plain_style(&[])).unwrap();
    let cell = |p: Point| -> Option<DVec2> {
        let (near, far) = (eye.unproject(p, 0.0), eye.unproject(p, 1.0));
        let at = near - (far - near) * (near.z / (far - near).z);
        let is_ahead = eye.depth(at) > 0.0 && at.x.abs() < 4.0 && at.y.abs() < 4.0;
        is_ahead.then(|| DVec2::new((at.x + 4.0) * 2.0, (at.y + 4.0) * 2.0))
    };
    for scale in [1, 4] {
        let seen = pixels(&drawing, 800 * scale);
        let (mut asked, mut wrong) = (0, 0);
        for k in 0..4000_u32 {
            // A low-discrepancy sequence based on the plastic number.
            let spread = |step: f64| (f64::from(k) * step).fract();
            let p = Point::new(spread(0.754_877_666_246_693) * 800.0, spread(0.569_840_290_998_053) * 600.0);
            let p = Point::new(p.x.floor() + 0.5, p.y.floor() + 0.5);
            // Only points well inside a cell: the colour is constant within 1.2 px and one texel.
            let around = [(1.2, 0.0), (-1.2, 0.0), (0.0, 1.2), (0.0, -1.2)];
            let Some(here) = cell(p).map(DVec2::floor) else { continue };
            if around.iter().any(|d| cell(p + *d).map(DVec2::floor) != Some(here)) {
                continue;
            }
            let within = cell(p).map_or(DVec2::ZERO, DVec2::fract);
            if within.min_element() < TEXEL_SIZE_CELLS || within.max_element() > 1.0 - TEXEL_SIZE_CELLS {
                continue;
            }
            let is_dark = (here.x as i64 + here.y as i64).rem_euclid(2) == 0;
            let truth = if is_dark { DARK } else { LIGHT };
            let at = |x: f64| (x * f64::from(scale)) as usize;
            asked += 1;
            wrong += u32::from(colour_difference(seen.at(at(p.x), at(p.y)), truth) > 24);
        }
        assert!(asked > 1000, "{asked}");
        assert!(wrong * 200 <= asked, "{wrong} of {asked} points at {scale}x");
    }
    let Paint::Image(image) = &images(&drawing)[0].paint else { unreachable!() };
    assert!(image.pieces.len() < 2000, "{} pieces", image.pieces.len());
}

#[test]
fn textures_repeat_clamp_and_mirror_outside_0_to_1() {
    // Red grows to the right, green downwards.
    let picture = png(64, |x, y| [(x * 4) as u8, (y * 4) as u8, 0]);
    let at = |t: f64, wrap: Wrap| match wrap {
        Wrap::Repeat => t.rem_euclid(1.0),
        Wrap::Clamp => t.clamp(0.0, 1.0),
        _ => 1.0 - (t.rem_euclid(2.0) - 1.0).abs(),
    };
    for wrap in [[Wrap::Repeat, Wrap::Clamp], [Wrap::Mirror, Wrap::Repeat], [Wrap::Clamp, Wrap::Mirror]] {
        let material = Material { wrap, ..painted(Arc::clone(&picture)) };
        let scene = quads(&[[0.0, 0.0, 4.0, 4.0, 0.0]], &[[-1.25, -1.0, 2.5, 1.5]], material);
        let camera = Camera::azimuth_elevation(0.0, 90.0, ligne::scene::UpAxis::Z)
            .with_projection(Projection::Orthographic { height: 1.0 })
            .fit(&scene);
        let eye = TextbookCamera::new(&camera);
        let seen = pixels(&render(&scene, &camera, &plain_style(&[])).unwrap(), camera.width as u32);
        let mut wrong = 0;
        for k in 0..400 {
            let share = |k: u32| (f64::from(k) + 0.5) / 20.0;
            let world = DVec3::new(share(k % 20) * 4.0, share(k / 20) * 4.0, 0.0);
            let p = eye.project(world);
            let uv = [-1.25 + 3.75 * share(k % 20), -1.0 + 2.5 * share(k / 20)];
            let truth = [0, 1].map(|axis| (at(uv[axis], wrap[axis]) * 252.0) as u8);
            // Near the end of a period, both ends are blended.
            let near_end = uv.iter().any(|t| (t - t.round()).abs() < 0.03);
            let off = colour_difference(seen.at(p.x as usize, p.y as usize), [truth[0], truth[1], 0]);
            wrong += u32::from(off > 12 && !near_end);
        }
        assert_eq!(wrong, 0, "{wrap:?}");
    }
}

#[test]
fn the_nearer_texture_is_visible_and_tones_shade_it() {
    let material = painted(png(32, |x, _| if x < 16 { DARK } else { LIGHT }));
    // The small plate hangs over the large one and shows the other half of the picture.
    let scene = quads(
        &[[0.0, 0.0, 4.0, 4.0, 0.0], [1.0, 1.0, 3.0, 3.0, 1.0]],
        &[[0.55, 0.1, 0.95, 0.9], [0.05, 0.1, 0.45, 0.9]],
        material,
    );
    let camera = Camera::azimuth_elevation(20.0, 70.0, ligne::scene::UpAxis::Z).fit(&scene);
    let eye = TextbookCamera::new(&camera);
    let light = "light.sources=[{ kind = 'directional', direction = [0, 0, 1], space = 'world' }]";
    let style = plain_style(&[
        "fills.thresholds=[0.5]",
        "fills.tones=[0.0, 1.0]",
        "fills.cast_shadows=true",
        "fills.shadow=0.5",
        light,
    ]);
    let drawing = render(&scene, &camera, &style).unwrap();
    let seen = pixels(&drawing, camera.width as u32);
    let colour = |x: f64, y: f64, z: f64| {
        let p = eye.project(DVec3::new(x, y, z));
        seen.at(p.x as usize, p.y as usize)
    };
    assert!(colour_difference(colour(2.0, 2.0, 1.0), DARK) < 6);
    assert!(colour_difference(colour(0.4, 0.4, 0.0), LIGHT) < 6, "{:?}", colour(0.4, 0.4, 0.0));
    // The shadow of the small plate is visible below its edge.
    let shaded = (0..400)
        .map(|k| (f64::from(k % 20) * 0.2 + 0.1, f64::from(k / 20) * 0.2 + 0.1))
        .any(|(x, y)| colour_difference(colour(x, y, 0.0), LIGHT.map(|c| c / 2)) < 6);
    assert!(shaded, "no shadow");
    let classes: Vec<&str> = drawing
        .layers
        .iter()
        .flat_map(|layer| &layer.marks)
        .flat_map(|mark| mark.provenance.classes.clone())
        .collect();
    assert_eq!((classes.iter().filter(|c| **c == "picture").count(), classes.contains(&"shade")), (1, true));
}

#[test]
fn files_embed_each_picture_once() {
    let scene = Scene::open(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/picnic.obj")).unwrap();
    let camera = Camera::azimuth_elevation(30.0, 25.0, scene.up).fit(&scene);
    let style = Style::load_with("toon", &["fills.texture='image'".to_owned()]).unwrap();
    let drawing = render(&scene, &camera, &style).unwrap();
    assert_eq!(images(&drawing).len(), 2);
    let svg = drawing.to_svg(&SvgOptions::default());
    assert_eq!(svg.matches("<image ").count(), 2);
    assert!(svg.matches("<use ").count() > 20 && svg.len() < 200_000, "{}", svg.len());
    let pdf = drawing.to_pdf();
    let objects = pdf.windows(b"/Subtype /Image".len()).filter(|bytes| *bytes == b"/Subtype /Image").count();
    assert_eq!(objects, 2);
    // The SVG is canonical, and the drawing compares equal to itself with either grouping.
    assert_eq!(canonical_svg(&svg, None).unwrap(), svg);
    for options in [SvgOptions::default(), SvgOptions::default().grouped_by(Grouping::Part)] {
        let read = || Read::from_drawing(&drawing, &options).unwrap();
        assert!(compare(&read(), &read(), &DiffOptions::default()).is_same());
    }
    // Plain fills lie below the pictures, for viewers that show no pictures.
    let without =
        render(&scene, &camera, &Style::load_with("toon", &["fills.texture='mean'".to_owned()]).unwrap());
    let fills = |drawing: &Drawing| {
        let of = |mark: &&Mark| matches!(mark.paint, Paint::Fill(_)) && mark.provenance.classes.is_empty();
        drawing.layers.iter().flat_map(|layer| &layer.marks).filter(of).count()
    };
    assert_eq!(fills(&drawing), fills(&without.unwrap()));
}

#[test]
fn many_small_triangles_are_merged_into_few_pieces() {
    // A ball of 20,000 triangles, 300 px wide.
    let (columns, rows) = (200_u32, 50_u32);
    let mut geometry = Geometry::default();
    for row in 0..=rows {
        for column in 0..=columns {
            let (u, v) = (f64::from(column) / f64::from(columns), f64::from(row) / f64::from(rows));
            let (turn, down) = (u * std::f64::consts::TAU, v * std::f64::consts::PI);
            use ligne::geometry::numbers::portable_math::{cos, sin};
            geometry.positions.push(DVec3::new(sin(down) * cos(turn), sin(down) * sin(turn), cos(down)));
            geometry.uvs.push([u as f32, v as f32]);
        }
    }
    for row in 0..rows {
        for column in 0..columns {
            let at = |right: u32, below: u32| (row + below) * (columns + 1) + column + right;
            geometry.triangles.extend([[at(0, 0), at(0, 1), at(1, 1)], [at(0, 0), at(1, 1), at(1, 0)]]);
        }
    }
    geometry.corner_uvs = geometry.triangles.clone();
    geometry.triangle_material = vec![0; geometry.triangles.len()];
    let noise = png(256, |x, y| [(x * 7 + y * 13) as u8, (x * 31) as u8, (y * 17) as u8]);
    let mut scene = quads(&[], &[], painted(noise));
    scene.geometries = vec![geometry];
    let camera = Camera::three_quarter_of(ligne::scene::UpAxis::Z).with_frame(330.0, 330.0).fit(&scene);
    let drawing = render(&scene, &camera, &plain_style(&[])).unwrap();
    let Paint::Image(image) = &images(&drawing)[0].paint else { unreachable!() };
    assert!(image.pieces.len() < 2000, "{} pieces", image.pieces.len());
    let picture = &image.picture;
    // The picture is not much finer than its file: it adds at most the overlap where it repeats.
    assert!(picture.width < 512 && picture.height < 512, "{} x {}", picture.width, picture.height);
    assert!(image.pieces.iter().any(|piece| matches!(piece.shows, PieceContent::Pixels(_))));
}

#[test]
fn intersecting_faces_show_the_texture_of_the_front_face() {
    // Blades of one part around a common axis, each with a separate texel, and a plate across all of them.
    const BLADES: u32 = 4;
    use ligne::geometry::numbers::portable_math::{cos, sin};
    let mut geometry = Geometry::default();
    let mut add = |corners: [DVec3; 4], texel: u32| {
        let first = geometry.positions.len() as u32;
        geometry.positions.extend(corners);
        geometry.uvs.extend([[(texel as f32 + 0.5) / 8.0, 0.5]; 4]);
        for triangle in [[0, 1, 2], [0, 2, 3]] {
            geometry.triangles.push(triangle.map(|k| first + k));
            geometry.corner_uvs.push(triangle.map(|k| first + k));
        }
    };
    for blade in 0..BLADES {
        let turn = std::f64::consts::PI * (f64::from(blade) + 0.2) / f64::from(BLADES);
        let out = DVec3::new(cos(turn), sin(turn), 0.0) * (1.0 + 0.1 * f64::from(blade));
        add([out, -out, DVec3::Z * 2.0 - out, DVec3::Z * 2.0 + out], blade);
    }
    let across = [[-1.2, -1.2], [1.2, -1.2], [1.2, 1.2], [-1.2, 1.2]];
    add(across.map(|[x, y]| DVec3::new(x, y, 0.9 + 0.3 * x)), BLADES);
    geometry.triangle_material = vec![0; geometry.triangles.len()];
    let shade = |texel: u32| [30 + 30 * texel as u8, 220 - 30 * texel as u8, 90];
    // The texels are wide, so their middle has one colour under any sampling.
    let mut scene = quads(&[], &[], painted(png(64, |x, _| shade(x / 8))));
    let faces: Vec<([DVec3; 3], u32)> = geometry
        .triangles
        .iter()
        .enumerate()
        .map(|(k, t)| (t.map(|v| geometry.positions[v as usize]), k as u32 / 2))
        .collect();
    scene.geometries = vec![geometry];
    for azimuth in [20.0, 65.0, 130.0] {
        let camera = Camera::azimuth_elevation(azimuth, 25.0, ligne::scene::UpAxis::Z)
            .with_frame(400.0, 400.0)
            .fit(&scene);
        let eye = TextbookCamera::new(&camera);
        let seen = pixels(&render(&scene, &camera, &plain_style(&[])).unwrap(), 1600);
        let front = |p: Point| {
            let (near, far) = (eye.unproject(p, 0.0), eye.unproject(p, 1.0));
            let hit = |corners: &[DVec3; 3]| hit_parameter(near, far - near, *corners);
            let hits = faces.iter().filter_map(|(corners, texel)| Some((hit(corners)?, *texel)));
            hits.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, texel)| texel)
        };
        let (mut asked, mut wrong) = (0, 0);
        for k in 0..6000_u32 {
            let spread = |step: f64| (f64::from(k) * step).fract() * 400.0;
            let p = Point::new(spread(0.754_877_666_246_693), spread(0.569_840_290_998_053));
            // Pieces overlap by half a px, and by one px at corners.
            let around = [(1.1, 0.0), (-1.1, 0.0), (0.0, 1.1), (0.0, -1.1)];
            let Some(texel) = front(p) else { continue };
            if around.iter().any(|d| front(p + *d) != Some(texel)) {
                continue;
            }
            asked += 1;
            wrong += u32::from(
                colour_difference(seen.at((p.x * 4.0) as usize, (p.y * 4.0) as usize), shade(texel)) > 8,
            );
        }
        assert!(asked > 1000 && wrong == 0, "{wrong} of {asked} points from {azimuth} degrees");
    }
}

/// Returns the parameter along a ray where it hits a triangle.
fn hit_parameter(from: DVec3, way: DVec3, [a, b, c]: [DVec3; 3]) -> Option<f64> {
    let normal = (b - a).cross(c - a);
    let at = normal.dot(a - from) / normal.dot(way);
    let p = from + way * at;
    let inside =
        [(a, b), (b, c), (c, a)].iter().all(|(p0, p1)| normal.dot((*p1 - *p0).cross(p - *p0)) >= 0.0);
    (at.is_finite() && inside).then_some(at)
}
