//! Lines traced from depth and normal maps: edge tests against their papers pixel by pixel, traced lines
//! against closed forms and exact lines, and polygon soups against the closed model.

use glam::DVec3;
use kurbo::Point;
use ligne::drawing::{Drawing, LayerKind, Unit};
use ligne::light::ShadingNormals;
use ligne::lines::ImageOptions;
use ligne::lines::image::{Dilation, EdgeTest, edges, ink_dilation};
use ligne::lines::{LineOptions, Surface};
use ligne::mesh::Mesh;
use ligne::pipeline::{Renderer, render};
use ligne::scene::{Camera, Geometry, Scene};
use ligne::style::Style;
use ligne::view::View;
use ligne::view::raster::{NO_FRONT, NormalDepthMaps};

use crate::library::support::measures::line_picture::{SegmentGrid, flatten_path, sample_segments};
use crate::library::support::measures::segment_sets::total_length;
use crate::library::support::pipeline::{self, REFINEMENT_TOLERANCE_PX, orthographic, perspective};
use crate::library::support::readers::shared_folder;
use crate::library::support::scenes::random_dice::Dice;
use crate::library::support::scenes::solids::{Solid, cuboid, sphere, torus};

fn maps(scene: &Scene, camera: &Camera, per_unit: f64) -> NormalDepthMaps {
    let surface = Surface::new(Mesh::build(scene.to_soup()), &LineOptions::default())
        .finer_for(camera, REFINEMENT_TOLERANCE_PX);
    let normals = ShadingNormals::new(&surface.mesh, &surface.hard, &surface.smooth);
    NormalDepthMaps::new(&surface.mesh, &View::new(&surface.mesh, camera), per_unit, |face| normals.of(face))
}

fn style(sets: &[&str]) -> Style {
    let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
    Style::load_with("ink", &sets).unwrap_or_else(|error| panic!("{error}"))
}

/// Returns the line segments of a drawing, or only those of one class.
fn lines(drawing: &Drawing, class: Option<&str>) -> Vec<[Point; 2]> {
    let marks = drawing.layers.iter().flat_map(|layer| &layer.marks);
    let of_class = |classes: &[&str]| class.is_none_or(|class| classes.contains(&class));
    marks.filter(|m| of_class(&m.provenance.classes)).flat_map(|m| flatten_path(&m.path, 0.01)).collect()
}

fn drawn(scene: &Scene, camera: &Camera, sets: &[&str]) -> Vec<[Point; 2]> {
    lines(&render(scene, camera, &style(sets)).unwrap(), None)
}

const IMAGE_SOURCE: &str = "lines.source=image";

/// Returns the share of the length of `own` that lies within each distance (px) of `others`.
fn length_shares_within<const N: usize>(
    own: &[[Point; 2]],
    others: &[[Point; 2]],
    distances: [f64; N],
) -> [f64; N] {
    let ink = SegmentGrid::new(others.to_vec(), 4.0);
    let places = sample_segments(own, 0.5);
    let whole: f64 = places.iter().map(|(_, length)| length).sum();
    distances.map(|distance| {
        let near = places.iter().filter(|(p, _)| ink.distance(*p) <= distance);
        near.map(|(_, length)| length).sum::<f64>() / whole
    })
}

/// Example models with flat faces, rounded surfaces, several parts, cut-outs and a scan.
const SCENES: [&str; 5] = ["gear.obj", "pump.glb", "goose.obj", "bear.ply", "street.glb"];

fn example(name: &str, size: f64) -> (Scene, Camera) {
    let scene = Scene::open(format!("examples/models/{name}")).unwrap();
    let mut camera = Camera::three_quarter_of(scene.up);
    (camera.width, camera.height) = (size, size);
    let camera = camera.fit(&scene);
    (scene, camera)
}

/// Returns the value at a pixel; outside the image, the value of the nearest border pixel.
fn at<T: Copy>(values: &[T], maps: &NormalDepthMaps, x: i64, y: i64) -> T {
    let (x, y) = (x.clamp(0, maps.columns as i64 - 1), y.clamp(0, maps.rows as i64 - 1));
    values[y as usize * maps.columns + x as usize]
}

/// Edge test of Scheelk, sections 3.4.3 and 3.4.4, written out literally.
fn scheelk_edge_test(maps: &NormalDepthMaps, x: i64, y: i64) -> bool {
    let depth = |x, y| at(&maps.depths, maps, x, y);
    let gradient = |value: &dyn Fn(i64, i64) -> f32, x: i64, y: i64| {
        let own = value(x, y);
        let off = |dx: i64, dy: i64| (value(x + dx, y + dy) - own).abs();
        (off(-1, -1)
            + 2.0 * off(0, -1)
            + off(1, -1)
            + 2.0 * off(-1, 0)
            + 2.0 * off(1, 0)
            + off(-1, 1)
            + 2.0 * off(0, 1)
            + off(1, 1))
            / 8.0
    };
    let of_depth = |x: i64, y: i64| gradient(&depth, x, y);
    let of_normals = |x: i64, y: i64| {
        let axis = |i: usize| gradient(&move |x, y| at(&maps.normals, maps, x, y)[i], x, y);
        (axis(0) + axis(1) + axis(2)) / 3.0
    };
    let p = |g: &dyn Fn(i64, i64) -> f32, k: f32| {
        let around = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (dx, dy)));
        let inside = |(dx, dy): (i64, i64)| {
            g((x + dx).clamp(0, maps.columns as i64 - 1), (y + dy).clamp(0, maps.rows as i64 - 1))
        };
        let all: Vec<f32> = around.map(inside).collect();
        let most = all.iter().copied().fold(f32::MIN, f32::max);
        let least = all.iter().copied().fold(f32::MAX, f32::min);
        ((most - least) / k).powi(2).min(1.0)
    };
    p(&of_depth, 0.003) + p(&of_normals, 0.0125) >= 0.75
}

/// Edge test of Ishaya, listing 4, instruction by instruction. Registers hold equal r, g and b, and a.
fn ishaya_edge_test(maps: &NormalDepthMaps, x: i64, y: i64) -> bool {
    let texel = |dx: i64, dy: i64| {
        let n = at(&maps.normals, maps, x + dx, y + dy);
        let shown = at(&maps.faces, maps, x + dx, y + dy) != NO_FRONT;
        (n, shown, at(&maps.depths, maps, x + dx, y + dy))
    };
    let (t0, t1, t2, t3) = (texel(-1, 0), texel(0, -1), texel(1, 0), texel(0, 1));
    let saturated = |x: f32| x.clamp(0.0, 1.0);
    let dp3 = |a: ([f32; 3], bool, f32), b: ([f32; 3], bool, f32)| match (a.1, b.1) {
        (false, false) => 1.0,
        _ => a.0[0] * b.0[0] + a.0[1] * b.0[1] + a.0[2] * b.0[2],
    };
    let (mut r0, mut r0_a) = (dp3(t0, t2), t0.2 - t2.2);
    let (mut r1, mut r1_a) = (dp3(t1, t3), t1.2 - t3.2);
    let t0_a = 0.9 - 0.25 * t0.2;
    r0 = saturated(4.0 * (r0 - t0_a));
    r0_a = r0_a * r0_a + 0.25;
    r1 = saturated(4.0 * (r1 - t0_a));
    r1_a = r1_a * r1_a + 0.25;
    r0 = saturated(4.0 * r0 * r1);
    r0_a += r1_a;
    r0_a += 1.0 - r0;
    // With eight bits, a value less than half a step above one half does not count as above it.
    r0_a > 0.5 + 0.5 / 256.0
}

#[test]
fn raster_edges_match_the_papers_pixel_for_pixel() {
    for name in SCENES {
        let (scene, camera) = example(name, 160.0);
        let maps = maps(&scene, &camera, 2.0);
        for test in [EdgeTest::Gradient, EdgeTest::Opposite] {
            let found = edges(&maps, &ImageOptions { test, ..ImageOptions::default() });
            let mut count = 0;
            for (pixel, is_edge) in found.iter().enumerate() {
                let (x, y) = ((pixel % maps.columns) as i64, (pixel / maps.columns) as i64);
                let expected = match test {
                    EdgeTest::Gradient => scheelk_edge_test(&maps, x, y),
                    EdgeTest::Opposite => ishaya_edge_test(&maps, x, y),
                };
                assert_eq!(*is_edge, expected, "{name} {test:?} {x} {y}");
                count += usize::from(expected);
            }
            assert!(count > 500 && count < found.len() / 2, "{name} {test:?}: {count} of {}", found.len());
        }
    }
}

#[test]
fn normal_and_depth_maps_match_a_sphere() {
    // A sphere of radius 1 in an orthographic view of 4 units on 200 px.
    let scene = pipeline::scene([sphere(60, 1.0)]);
    let mut camera = orthographic(DVec3::new(0.0, -5.0, 0.0), DVec3::ZERO, 4.0);
    (camera.width, camera.height) = (200.0, 200.0);
    let maps = maps(&scene, &camera, 1.0);
    assert_eq!((maps.columns, maps.rows), (200, 200));
    for pixel in 0..maps.faces.len() {
        let (column, row) = (pixel % 200, pixel / 200);
        let (x, z) = ((column as f64 + 0.5) / 50.0 - 2.0, 2.0 - (row as f64 + 0.5) / 50.0);
        let r = (x * x + z * z).sqrt();
        assert!(r > 0.99 || maps.faces[pixel] != NO_FRONT, "{column} {row}");
        assert!(r < 1.0 || maps.faces[pixel] == NO_FRONT, "{column} {row}");
        if r < 0.9 {
            let y = -(1.0 - r * r).sqrt();
            let normal = DVec3::new(x, z, -y);
            let found = DVec3::from_array(maps.normals[pixel].map(f64::from));
            assert!(found.distance(normal) < 0.03, "{found} {normal}");
            assert!((maps.depth(pixel) - (5.0 + y)).abs() < 0.01, "{} {}", maps.depth(pixel), 5.0 + y);
        }
    }
}

#[test]
fn perspective_depth_is_linear_and_normals_face_the_camera() {
    // A floor seen at an angle, wound away from the camera.
    let corners = [[-4., -4., 0.], [4., -4., 0.], [4., 4., 0.], [-4., 4., 0.]].map(DVec3::from_array);
    let floor = Solid { positions: corners.to_vec(), triangles: vec![[0, 2, 1], [0, 3, 2]] };
    let scene = pipeline::scene([floor]);
    let (eye, target) = (DVec3::new(0.0, -12.0, 5.0), DVec3::ZERO);
    let camera = perspective(eye, target, 40.0);
    let maps = maps(&scene, &camera, 0.2);
    let frame = View::new(&Mesh::build(scene.to_soup()), &camera).frame;
    let mut count = 0;
    for pixel in (0..maps.faces.len()).filter(|pixel| maps.faces[*pixel] != NO_FRONT) {
        let place = [pixel % maps.columns, pixel / maps.columns].map(|i| (i as f64 + 0.5) / maps.scale);
        let along =
            frame.local_from_image(DVec3::new(place[0], place[1], frame.nearness_of(1.0))) - frame.eye;
        let hit = frame.eye - along * (frame.eye.z / along.z);
        assert!((maps.depth(pixel) - frame.depth(hit)).abs() < 1e-4 * frame.depth(hit));
        let up = DVec3::Z;
        let normal = DVec3::new(up.dot(frame.right), up.dot(frame.up), -up.dot(frame.forward));
        assert!(DVec3::from_array(maps.normals[pixel].map(f64::from)).distance(normal) < 1e-5);
        count += 1;
    }
    assert!(count > 1000);
}

#[test]
fn image_lines_trace_a_sphere_as_a_circle_and_a_box_as_its_edges() {
    let ball = pipeline::scene([sphere(100, 1.0)]);
    let camera = orthographic(DVec3::new(0.0, -5.0, 0.0), DVec3::ZERO, 4.0);
    for test in ["gradient", "opposite"] {
        let test = format!("lines.image.test={test}");
        let circle = drawn(&ball, &camera, &[IMAGE_SOURCE, &test]);
        let off = circle.iter().flatten().map(|p| ((*p - Point::new(500.0, 500.0)).hypot() - 250.0).abs());
        assert!(off.fold(0.0, f64::max) < 0.7);
        assert!((total_length(&circle) / (500.0 * std::f64::consts::PI) - 1.0).abs() < 0.01);
        let solid = pipeline::scene([cuboid(DVec3::splat(-1.0), DVec3::splat(1.0))]);
        let eye = DVec3::new(2.0, -5.0, 3.0);
        let camera = perspective(eye, DVec3::ZERO, 35.0);
        let (image, exact) = (drawn(&solid, &camera, &[IMAGE_SOURCE, &test]), drawn(&solid, &camera, &[]));
        assert_eq!(length_shares_within(&image, &exact, [0.7]), [1.0]);
        assert!(length_shares_within(&exact, &image, [1.0])[0] > 0.995);
        assert!((total_length(&image) / total_length(&exact) - 1.0).abs() < 0.005);
    }
}

/// Asserts that image lines agree with exact lines: nearby lines lie within 0.7 px of each other, exact
/// contours are found, and image curves have at most twice the number of nodes.
fn assert_image_lines_agree(name: &str, scene: &Scene, camera: &Camera) {
    let exact = render(scene, camera, &style(&[])).unwrap();
    let image = render(scene, camera, &style(&[IMAGE_SOURCE])).unwrap();
    let (all, found) = (lines(&exact, None), lines(&image, None));
    let [near, beside] = length_shares_within(&found, &all, [0.7, 3.0]);
    assert!(near / beside > 0.95, "{name}: of {beside} near lines of the surface {near} within 0.7 px");
    let contours = lines(&exact, Some("contour"));
    let recall = length_shares_within(&contours, &found, [1.5])[0];
    assert!(recall > 0.97, "{name}: {recall} of the contours");
    let ink = SegmentGrid::new(all, 4.0);
    let nodes = |drawing: &Drawing| {
        let marks = drawing.layers.iter().flat_map(|layer| &layer.marks);
        marks
            .flat_map(|mark| mark.path.segments())
            .filter(|segment| {
                use kurbo::ParamCurve;
                [0.1, 0.5, 0.9].iter().all(|t| ink.distance(segment.eval(*t)) < 1.5)
            })
            .count()
    };
    let (own, others) = (nodes(&image), nodes(&exact));
    assert!(own <= 2 * others, "{name}: {own} nodes against {others}");
}

#[test]
fn image_lines_agree_with_exact_lines() {
    for name in ["gear.obj", "pump.glb", "bear.ply", "castle.obj", "knot.ply"] {
        let (scene, camera) = example(name, 1000.0);
        assert_image_lines_agree(name, &scene, &camera);
    }
    let shared = ["organic/stanford-bunny.obj", "scene/castle/building_castle_blue.obj", "cad/drive.glb"];
    for path in shared.iter().chain(&["scene/retroufo.gltf"]).filter_map(|name| shared_folder::find(name)) {
        let scene = Scene::open(&path).unwrap();
        let camera = Camera::three_quarter_of(scene.up).fit(&scene);
        assert_image_lines_agree(&path.display().to_string(), &scene, &camera);
    }
}

/// Returns the quads of a solid as loose faces: each has its own randomly moved corners and a random winding.
fn loose_quads(solid: &Solid, by: f64) -> Geometry {
    let mut dice = Dice::new(5);
    let mut geometry = Geometry::default();
    for pair in solid.triangles.chunks(2) {
        let turned = dice.below(2) == 1;
        let mut moved: Vec<(u32, u32)> = Vec::new();
        for triangle in pair {
            let mut ids = triangle.map(|v| {
                if let Some((_, id)) = moved.iter().find(|(of, _)| *of == v) {
                    return *id;
                }
                geometry.positions.push(solid.positions[v as usize] + dice.point(by));
                moved.push((v, (geometry.positions.len() - 1) as u32));
                (geometry.positions.len() - 1) as u32
            });
            if turned {
                ids.swap(0, 1);
            }
            geometry.triangles.push(ids);
        }
    }
    geometry
}

#[test]
fn image_lines_of_a_quad_soup_match_the_closed_model() {
    let ring = torus(100, 100, 1.0, 0.4);
    let camera = perspective(DVec3::new(1.5, -4.0, 3.0), DVec3::ZERO, 35.0);
    let closed = drawn(&pipeline::scene([ring.clone()]), &camera, &[]);
    for by in [1e-5, 2e-4] {
        let loose = loose_quads(&ring, by);
        assert!(loose.triangles.len() == 20_000 && loose.positions.len() == 40_000);
        let soup = pipeline::scene_of_geometries(vec![loose]);
        let image = drawn(&soup, &camera, &[IMAGE_SOURCE]);
        assert!(
            length_shares_within(&image, &closed, [1.0])[0] > 0.98,
            "{by}: {:?}",
            length_shares_within(&image, &closed, [1.0])
        );
        assert!(
            length_shares_within(&closed, &image, [1.0])[0] > 0.98,
            "{by}: {:?}",
            length_shares_within(&closed, &image, [1.0])
        );
        // In the exact drawing, each quad has its own borders.
        assert!(total_length(&drawn(&soup, &camera, &[])) > 10.0 * total_length(&closed));
    }
}

#[test]
fn both_sources_draw_no_line_twice() {
    let (scene, camera) = example("goose.obj", 1000.0);
    let both = render(&scene, &camera, &style(&["lines.source=both"])).unwrap();
    let exact = render(&scene, &camera, &style(&[])).unwrap();
    let marks = |drawing: &Drawing| -> Vec<String> {
        let marks = drawing.layers.iter().flat_map(|layer| &layer.marks);
        let on_surface = marks.filter(|mark| !mark.provenance.classes.contains(&"image"));
        on_surface.map(|mark| mark.path.to_svg()).collect()
    };
    assert_eq!(marks(&both), marks(&exact));
    let added = lines(&both, Some("image"));
    assert!(added.len() > 20, "what the image alone has is added");
    assert!(length_shares_within(&added, &lines(&exact, None), [1.0])[0] < 0.02);
}

#[test]
fn fills_do_not_depend_on_the_line_source() {
    let (scene, camera) = example("gear.obj", 300.0);
    let fills = |sets: &[&str]| {
        let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
        let drawing = render(&scene, &camera, &Style::load_with("toon", &sets).unwrap()).unwrap();
        let layer = drawing.layers.iter().find(|layer| layer.kind == LayerKind::Fills).unwrap();
        layer.marks.iter().map(|mark| mark.path.to_svg()).collect::<Vec<_>>()
    };
    assert_eq!(fills(&[IMAGE_SOURCE]), fills(&["lines.enabled=false"]));
}

#[test]
fn dilation_passes_match_the_listing_of_the_paper() {
    let mut edges = vec![false; 49];
    edges[24] = true;
    let of = |passes: u8, dilation: Dilation| {
        let options = ImageOptions { passes, dilation, ..ImageOptions::default() };
        ink_dilation::dilate_ink(&edges, 7, &options)
    };
    for pixel in 0..49_i32 {
        let away = (pixel % 7 - 3).abs() + (pixel / 7 - 3).abs();
        assert_eq!(of(2, Dilation::Plain)[pixel as usize], f32::from(u8::from(away <= 2)));
        let smooth = match away {
            0 => 1.0,
            1 => 0.5,
            _ => 0.0,
        };
        assert_eq!(of(1, Dilation::Smooth)[pixel as usize], smooth);
    }
    assert_eq!(of(0, Dilation::Plain).iter().sum::<f32>(), 1.0);
}

#[test]
fn exported_maps_are_pngs_of_equal_size() {
    let (scene, camera) = example("pump.glb", 120.0);
    let style = style(&["lines.image.samples=3"]);
    let files = Renderer::new(&scene, &style).maps(&camera, Unit::Px).unwrap();
    for (name, bytes) in files.named() {
        let decoder = png::Decoder::new(std::io::Cursor::new(bytes));
        let mut reader = decoder.read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut pixels).unwrap();
        assert_eq!((info.width, info.height), (360, 360), "{name}");
        let deep = info.bit_depth == png::BitDepth::Sixteen;
        assert_eq!(deep, name == "depth.png", "{name}");
        let first = pixels.iter().all(|value| *value == pixels[0]);
        assert!(!first, "{name} shows something");
    }
}
